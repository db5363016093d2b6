"""The Python module, used as a program outside of this project does."""

import ast
import gc
import pathlib
import threading
import time

import numpy as np
import pytest

import merge2d


def tower(boxes=3):
    scene = merge2d.Scene()
    scene.add_body("ground", merge2d.box(20, 1), at=(0, -0.5), motion="pinned")
    for i in range(boxes):
        scene.add_body(f"box {i}", merge2d.box(1, 1), at=(0, 0.5 + i))
    return scene


def test_views_follow_the_world_and_cannot_be_written():
    world = merge2d.World(tower())
    views = {name: getattr(world, name) for name in
             ("positions", "angles", "velocities", "spins", "collection_ids")}
    assert views["positions"].shape == (4, 2) and views["angles"].shape == (4,)
    world.step(100)
    for name, view in views.items():
        assert np.array_equal(view, getattr(world, name)), name
        assert np.shares_memory(view, getattr(world, name)), name
        with pytest.raises(ValueError, match="read-only"):
            view[...] = 0
    assert (views["collection_ids"][1:] >= 0).all()


def test_views_keep_their_world_alive():
    positions = merge2d.World(tower()).positions
    gc.collect()
    assert positions[1, 1] == pytest.approx(0.5)


def test_views_stay_valid_when_bodies_are_added():
    world = merge2d.World(tower())
    view = world.positions
    for i in range(2000):
        world.add_body(shapes=merge2d.circle(0.4), at=(20 + 2 * i, 0.5))
    world.step(10)
    assert len(world) == 2004 and view.shape == (4, 2)
    assert np.array_equal(view, world.positions[:4])


def test_settings_are_keyword_arguments():
    world = merge2d.World("books", "merge", merging_velocity=0.03, step=0.005)
    assert world.get("merging.velocity") == 0.03
    assert world.time_step == 0.005
    assert world.mode == "merge"
    with pytest.raises(merge2d.InputError, match="did you mean"):
        merge2d.World("books", merging_velocty=0.03)
    scene = tower()
    assert merge2d.World(scene, merging_velocity=0.03).get("merging.velocity") == 0.03
    assert scene.get("merging.velocity") == 0.01


def test_the_time_step_can_be_changed_between_two_steps():
    world = merge2d.World(tower())
    world.step(50)
    world.time_step = 0.002
    world.step(50)
    assert world.time == pytest.approx(0.6) and world.time_step == 0.002
    with pytest.raises(merge2d.InputError, match="between 1e-6 and 1 s"):
        world.time_step = 0
    assert world.time_step == 0.002


def test_a_text_is_a_scene_and_its_errors_have_their_place():
    world = merge2d.World("[[body]]\nname = 'ball'\ncircle = 0.5\n")
    assert world.names == ["ball"]
    with pytest.raises(merge2d.InputError, match="scene:2:1: unknown key 'crcle'"):
        merge2d.World("[[body]]\ncrcle = 0.5\n")


def test_errors_are_also_what_python_calls_them():
    assert issubclass(merge2d.InputError, ValueError)
    assert issubclass(merge2d.IoError, OSError)
    assert issubclass(merge2d.InputError, merge2d.Error)
    world = merge2d.World(tower())
    with pytest.raises(IndexError, match="no body 99"):
        world.apply_impulse(99, (0, 0), (1, 0))
    with pytest.raises(ValueError):
        world.step(-1)


@pytest.mark.parametrize("mistake, says", [
    (lambda s, w: s.add_body(merge2d.box(1, 1)), r"'name' must be a text, not <merge2d.Shape: box>"),
    (lambda s, w: s.add_body("b", 3), "a shape is .* not 3"),
    (lambda s, w: s.add_body("b", [1, 2]), r"a shape is .* not \[1, 2\]"),
    (lambda s, w: s.add_body("b", merge2d.box(1, 1), at=3), "'at' must be a pair of numbers, not 3"),
    (lambda s, w: s.add_body("b", merge2d.box(1, 1), at="xy"), "'at' must be a pair .* not 'xy'"),
    (lambda s, w: s.add_body("b", merge2d.box(1, 1), angle="x"), "'angle' must be a number, not 'x'"),
    (lambda s, w: s.add_body("b", merge2d.box(1, 1), mass="x"), "'mass' must be a number, not 'x'"),
    (lambda s, w: s.add_body("b", merge2d.box(1, 1), script=3), "'script' must be a dictionary"),
    (lambda s, w: s.add_body("b", merge2d.box(1, 1), script={"keyframes": [(0, 1)]}), "'keyframes'"),
    (lambda s, w: s.add_joint("revolute", 1.5), "by its number or its name, not by 1.5"),
    (lambda s, w: s.add_joint("revolute", 0, limits=1), "'limits' must be a pair"),
    (lambda s, w: s.add_joint("revolute", 0, collide="x"), "'collide' must be True or False"),
    (lambda s, w: w.apply_impulse(0, (0, 0), (1,)), r"must be a pair of numbers, not \(1,\)"),
    (lambda s, w: w.apply_impulse(None, (0, 0), (1, 0)), "not by None"),
    (lambda s, w: w.at(0), "must be a pair of numbers, not 0"),
    (lambda s, w: setattr(w, "gravity", 3), "must be a pair of numbers, not 3"),
])
def test_a_wrong_type_is_refused_in_words(mistake, says):
    scene = tower(1)
    with pytest.raises(TypeError, match=says):
        mistake(scene, merge2d.World(scene))


@pytest.mark.parametrize("mistake, says", [
    (lambda: merge2d.Scene().add_body("b", merge2d.box(1, 1), motion="scripted"), "needs a script"),
    (lambda: merge2d.World("books", gravity=3), "^gravity=3: "),
    (lambda: merge2d.Scene("x = = 3"), "^scene:1:"),
    (lambda: merge2d.compare("books", seconds=-1), "'seconds' must be positive"),
    (lambda: merge2d.World("books").render(-3, 3), "16 to 16384 pixels"),
    (lambda: merge2d.World("books").render(10**5, 10**5), "16 to 16384 pixels"),
])
def test_a_value_without_meaning_is_an_input_error(mistake, says):
    with pytest.raises(merge2d.InputError, match=says):
        mistake()


def test_a_misspelled_attribute_is_an_error():
    world = merge2d.World(tower(1))
    with pytest.raises(AttributeError, match="timestep"):
        world.timestep = 0.1
    with pytest.raises(AttributeError, match="gravty"):
        world.scene = merge2d.Scene().gravty


def test_one_mode_is_compared_with_the_reference():
    assert list(merge2d.compare("books", 0.1, modes="merge").seconds) == ["reference", "merge"]


def test_bodies_of_a_scene_go_by_number_or_name():
    scene = tower(2)
    scene.add_joint("weld", "box 0", "box 1", at=(0, 1))
    scene.add_spring("box 1", (0, 0), (0, 9), to_body=None, stiffness=1.0)
    scene.add_impulse("box 1", (0, 1.5), (0.1, 0), 0.05)
    scene.add_force("box 0", (0, 0), (0, 1))
    scene.add_magnet("box 0")
    scene.follow("box 1")
    assert scene.body("box 1") == 2
    joint, = merge2d.World(scene).joints
    assert (joint["a"], joint["b"]) == (1, 2)
    with pytest.raises(merge2d.InputError, match="did you mean 'box 1'"):
        scene.add_joint("weld", "bxo 1")
    with pytest.raises(IndexError, match="no body 7: the scene has 3"):
        scene.add_impulse(7, (0, 0), (1, 0), 0)


def test_bodies_go_by_number_or_name():
    world = merge2d.World(tower())
    world.set_velocity("box 2", (1.0, 0.0), 0.5)
    assert world.velocities[3].tolist() == [1.0, 0.0] and world.spins[3] == 0.5
    assert world.body("box 2") == 3 and world.name(3) == "box 2"
    assert world.info("ground")["motion"] == "pinned"


def test_records_are_structured_arrays():
    world = merge2d.World(tower(), decisions=True)
    kinds, reasons, sources = set(), set(), set()
    for _ in range(100):
        world.step()
        kinds |= set(world.events["type"])
        reasons |= set(world.decisions["criterion"])
        sources |= set(world.decisions["equation"])
    assert "merge" in kinds
    assert {"relative-motion", "count"} <= reasons
    assert {"(17)", "docs/decisions/cures.md#when-to-merge"} <= sources
    contacts = world.contacts
    assert set(contacts["internal"]) == {1}
    assert contacts["ny"] == pytest.approx(np.ones(len(contacts)))
    assert "box 0 and box 1" in world.why("box 0", "box 1")


def test_decisions_that_were_not_noted_are_an_error_and_not_nothing():
    world = merge2d.World(tower())
    world.step()
    with pytest.raises(merge2d.InputError, match="did not note"):
        world.decisions
    world.noting = True
    world.step()
    assert len(world.decisions) > 0


def test_polygons_come_from_lists_arrays_and_geometries():
    class Ring:  # as Shapely has it
        coords = [(0, 0), (2, 0), (2, 1), (0, 1), (0, 0)]

    class Polygon:
        exterior, interiors = Ring, []

    class Holed:
        exterior, interiors = Ring, [Ring]

    class Several:
        geoms = [Polygon]

    outline = np.array(Ring.coords[:4], float)
    masses = []
    for shape in (merge2d.polygon(outline), outline, Ring.coords, Polygon, Several):
        scene = merge2d.Scene()
        scene.add_body("plate", shape)
        masses.append(merge2d.World(scene).info("plate")["mass"])
    assert masses == pytest.approx([2.0] * 5)
    with pytest.raises(merge2d.InputError, match="holes"):
        merge2d.polygon(Holed)


def test_scripts_move_bodies():
    scene = merge2d.Scene()
    scene.add_body("lift", merge2d.box(2, 1), script={"velocity": (0, 1), "spin": 0.0})
    scene.add_body("swing", merge2d.box(2, 1), at=(9, 0),
                   script={"axis": (1, 0), "amplitude": 1.0, "period": 2.0})
    scene.add_body("path", merge2d.box(2, 1), at=(20, 0),
                   script={"keyframes": [(0, 20, 0, 0), (1, 25, 0, 0)]})
    world = merge2d.World(scene)
    world.step(100)
    assert world.positions[0, 1] == pytest.approx(1.0)
    assert world.positions[1, 0] == pytest.approx(11.0, abs=1e-6)
    assert world.positions[2, 0] == pytest.approx(25.0, abs=1e-6)
    with pytest.raises(merge2d.InputError, match="script"):
        scene.add_body("odd", merge2d.box(1, 1), script={"speed": 3})


def test_joints_springs_and_drags_hold():
    scene = tower(1)
    scene.add_body("bob", merge2d.circle(0.2), at=(5, 3))
    scene.add_joint("distance", 2, at=(5, 3), to=(5, 5))
    world = merge2d.World(scene)
    world.apply_impulse("bob", (5, 3), (0.2, 0))
    world.step(100)
    assert np.hypot(*(world.positions[2] - (5, 5))) == pytest.approx(2.0, abs=0.01)
    hand = world.drag("box 0", (0.0, 0.5))
    world.move_spring(hand, (0, 4))
    world.step(200)
    assert world.positions[1, 1] > 3
    world.remove_spring(hand)
    world.step(300)
    assert world.positions[1, 1] == pytest.approx(0.5, abs=0.02)


def test_queries():
    world = merge2d.World(tower())
    assert world.at((0, 0.5)).tolist() == [1]
    assert world.in_box((-1, 0.2), (1, 1.2)).tolist() == [1, 2]
    assert world.touching(merge2d.circle(0.3), (0.7, 2.5), 0.0).tolist() == [3]
    hit = world.cast_ray((-5, 0.5), (5, 0.5))
    assert hit["body"] == 1 and hit["point"] == pytest.approx((-0.5, 0.5))
    assert world.cast_ray((-5, 50), (5, 50)) is None


def test_a_second_thread_is_refused_while_a_world_steps():
    world = merge2d.World("pile", "reference")
    refused, done = [], threading.Event()

    def run():
        while not done.is_set():
            world.step(20)

    thread = threading.Thread(target=run)
    thread.start()
    while not refused:
        try:
            assert world.time >= 0
        except RuntimeError as error:
            refused.append(str(error))
        time.sleep(0.001)
    done.set()
    thread.join()
    assert refused == ["this world is in use by another thread"]


def test_two_threads_step_two_worlds():
    worlds = [merge2d.World(tower(5)) for _ in range(2)]
    threads = [threading.Thread(target=w.step, args=(200,)) for w in worlds]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert np.array_equal(worlds[0].positions, worlds[1].positions)


def test_springs_pull_by_hooke():
    scene = merge2d.Scene(gravity=(0, 0))
    ball = scene.add_body(shapes=merge2d.circle(0.5), at=(0, 0))
    scene.add_spring(ball, anchor=(0, 0), to=(3, 4), stiffness=2, rest_length=1)
    world = merge2d.World(scene)
    assert len(world.springs) == 0
    world.step()
    spring, = world.springs
    assert spring["number"] == 0 and spring["a"] == ball and spring["b"] == 2**32 - 1
    assert (spring["ax"], spring["ay"], spring["bx"], spring["by"]) == (0, 0, 3, 4)
    assert spring["force"] == pytest.approx(2 * (5 - 1))


def test_collections_are_a_structured_array():
    world = merge2d.World(tower(), "merge")
    world.step(100)
    collection, = world.collections
    assert collection["id"] == 1 and collection["count"] == 3
    first = collection["first"]
    bodies = world.members[first:first + collection["count"]]
    assert bodies.tolist() == [i for i, c in enumerate(world.collection_ids) if c == 1]
    assert collection["anchor"] == world.body("ground")


def test_a_camera_follows_a_body():
    scene = merge2d.Scene("ship-crane").copy()
    scene.follow(0)
    assert "follow" in scene.to_toml()
    scene.follow(None)
    assert "follow" not in scene.to_toml()
    with pytest.raises(IndexError, match="there is no body 999"):
        scene.follow(999)


def test_pictures():
    world = merge2d.World(tower())
    picture = world.render(320, 180)
    assert picture.shape == (180, 320, 4) and picture.dtype == np.uint8
    assert len(np.unique(picture.reshape(-1, 4), axis=0)) > 3
    assert (world.render(320, 180, camera=(0, 0, 100)) != picture).any()
    assert world._repr_png_().startswith(b"\x89PNG")
    with pytest.raises(merge2d.InputError, match="did you mean 'contacts'"):
        world.render(320, 180, overlays="contcts")


def test_pages_carry_themselves(tmp_path):
    page = merge2d.lesson("one-step", live=False)
    page.save(tmp_path / "lesson.html")
    assert (tmp_path / "lesson.html").read_text() == page.html
    assert page._repr_html_().startswith("<iframe srcdoc=")
    with pytest.raises(merge2d.InputError, match="did you mean"):
        merge2d.lesson("one-stpe")


def test_modes_are_compared():
    result = merge2d.compare(tower(), 1.0)
    assert list(result.seconds) == list(merge2d.MODES)
    assert result.active_bodies["reference"][-1] == 3
    assert result.active_bodies["merge"][-1] < 3
    assert max(d.max() for d in result.distance.values()) < 0.01
    assert "ms/step" in repr(result) and "<table>" in result._repr_html_()


def test_a_run_is_the_same_every_time():
    one, other = merge2d.World("books"), merge2d.World("books")
    one.step(50)
    for _ in range(50):
        other.step()
    assert one.save() == other.save()


def test_the_type_stubs_name_what_there_is():
    stubs = ast.parse(pathlib.Path(merge2d.__file__).with_suffix(".pyi").read_text())
    public = {n for n in merge2d.__all__}
    top = {node.name for node in stubs.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    constants = {node.target.id for node in stubs.body if isinstance(node, ast.AnnAssign)}
    assert (top | constants) - {"__version__"} == public
    for node in stubs.body:
        if not isinstance(node, ast.ClassDef) or node.name in ("Shape", "Comparison", "Page"):
            continue
        names = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
        names |= {n.target.id for n in node.body if isinstance(n, ast.AnnAssign)}
        there = {n for n in dir(getattr(merge2d, node.name)) if not n.startswith("_")}
        of_exceptions = {"args", "with_traceback", "add_note", "errno", "filename", "filename2",
                         "strerror", "characters_written"}
        assert there - names <= of_exceptions, (node.name, there - names)
        assert {n for n in names if not n.startswith("_")} <= there, node.name


def test_methods_take_their_arguments_by_name():
    world = merge2d.World(tower())
    world.apply_impulse(body="box 0", at=(0, 0.5), impulse=(0, 0.1))
    world.set_pose(body=3, center=(4, 0.5), angle=0.0)
    assert world.at(point=(4, 0.5)).tolist() == [3]
    assert world.touching(merge2d.circle(0.1), at=(4, 0.5)).tolist() == [3]
    assert world.cast_ray(start=(4, 9), end=(4, 0))["body"] == 3
    assert world.pin.__doc__ and world.step.__doc__
