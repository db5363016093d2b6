"""Wrong arguments are refused in words that a user of Python knows, in one line."""

import copy
import math
import pickle

import numpy as np
import pytest

import merge2d


def ball_on_ground():
    scene = merge2d.Scene()
    scene.add_body("ground", merge2d.box(20, 1), at=(0, -0.5), motion="pinned")
    scene.add_body("ball", merge2d.circle(0.5), at=(0, 0.5))
    return scene


WRONG_TYPES = {
    "a step and a half": (lambda s, w: w.step(1.5), "a whole number is needed, not 1.5"),
    "steps as a text": (lambda s, w: w.step("3"), "a whole number is needed, not '3'"),
    "no mode": (lambda s, w: merge2d.World(s, None), "a text is needed, not None"),
    "a text as time step": (lambda s, w: setattr(w, "time_step", "x"), "a number is needed, not 'x'"),
    "a text as state": (lambda s, w: w.restore("state"), "a saved state is bytes, not 'state'"),
    "half a pixel": (lambda s, w: w.render(100.5, 90), "a whole number is needed, not 100.5"),
    "a list of overlays": (lambda s, w: w.render(overlays=["forces"]), "a text is needed"),
    "a camera without height": (lambda s, w: w.render(camera=(0, 1)),
                                r"a camera is \(x, y, visible height\), not \(0, 1\)"),
    "a radius in words": (lambda s, w: merge2d.circle("wide"), "a number is needed, not 'wide'"),
    "a pull without a number": (lambda s, w: s.add_spring("ball", (0, 0), (0, 1), stiffness="stiff"),
                                "a number is needed, not 'stiff'"),
    "a spring's name": (lambda s, w: w.remove_spring("hand"), "a whole number is needed, not 'hand'"),
    "no value": (lambda s, w: s.set("merging.velocity", None), "not None"),
    "a short key frame": (lambda s, w: s.add_body("lift", merge2d.box(1, 1),
                                                  script={"keyframes": [(0, 0, 1)]}),
                          r"each of 'keyframes' is \(time, x, y, angle\), not \(0, 0, 1\)"),
}


@pytest.mark.parametrize("call, words", WRONG_TYPES.values(), ids=WRONG_TYPES)
def test_a_wrong_type_is_told_in_one_line(call, words):
    scene = ball_on_ground()
    world = merge2d.World(scene)
    with pytest.raises(TypeError, match=words) as refused:
        call(scene, world)
    assert "\n" not in str(refused.value)


WRONG_NUMBERS = {
    "too many steps": (lambda s, w: w.step(2**70), ValueError, "1180591620717411303424 is too large"),
    "fewer than no copies": (lambda s, w: s.add_emitter("drop", merge2d.circle(1), every=1, count=-3),
                             ValueError, "'count' must be 0 or more, not -3"),
    "a negative seed": (lambda s, w: s.add_emitter("drop", merge2d.circle(1), every=1, count=1,
                                                   seed=-1), ValueError, "'seed' must be 0 or more"),
    "a joint before the first": (lambda s, w: w.remove_joint(-1), IndexError, "there is no number -1"),
    "a picture too wide": (lambda s, w: w.render(10**12, 90), merge2d.InputError, "16 to 16384 pixels"),
    "a box upside down": (lambda s, w: w.in_box((5, 5), (0, 0)), merge2d.InputError,
                          "lower corner of a box"),
    "a setting of the scene": (lambda s, w: w.set("step", 0.1), merge2d.InputError,
                               "'step' is of the scene, not a setting of a world: set its time step"),
    "a misspelled setting": (lambda s, w: merge2d.World(s, mergin_velocity=1), merge2d.InputError,
                             "did you mean 'merging.velocity'"),
    "a misspelled setting of a scene by name": (lambda s, w: merge2d.World("books", mergin_steps=1),
                                                merge2d.InputError, "did you mean 'merging'"),
    "a name that is taken": (lambda s, w: w.add_body("ball", merge2d.circle(1), at=(5, 5)),
                             merge2d.InputError, "two bodies are called 'ball'"),
}


@pytest.mark.parametrize("call, error, words", WRONG_NUMBERS.values(), ids=WRONG_NUMBERS)
def test_a_wrong_value_is_told_in_words(call, error, words):
    scene = ball_on_ground()
    world = merge2d.World(scene)
    with pytest.raises(error, match=words):
        call(scene, world)


NOT_FINITE = {
    "a force": (lambda s: s.add_force("ball", (0, 0), (math.nan, 0)), r"'force\[0\]' in force\[0\]"),
    "its end": (lambda s: s.add_force("ball", (0, 0), (1, 0), until=math.nan), "'until' in force"),
    "an impulse": (lambda s: s.add_impulse("ball", (0, math.inf), (1, 0), 0), r"'at\[1\]' in impulse"),
    "a magnet": (lambda s: s.add_magnet("ground", start=-math.inf), "'on' in magnet"),
    "a key frame": (lambda s: s.add_body("lift", merge2d.box(1, 1), motion="scripted", script={
        "keyframes": [(0, 9, math.nan, 0)]}), "'keyframes' in body 'lift'"),
    "a motor": (lambda s: s.add_joint("revolute", "ball", at=(0, 0), motor=(math.nan, 1)),
                "'speed' in the joint"),
}


@pytest.mark.parametrize("call, words", NOT_FINITE.values(), ids=NOT_FINITE)
def test_a_number_of_a_scene_is_finite(call, words):
    scene = ball_on_ground()
    with pytest.raises(merge2d.InputError, match=words + ".* must be a finite number") as refused:
        call(scene)
        merge2d.World(scene)
    assert "\n" not in str(refused.value)


def test_objects_that_were_not_made_refuse_calls():
    """A debugger shows them: those of a constructor that raised."""
    scene = merge2d.Scene.__new__(merge2d.Scene)
    world = merge2d.World.__new__(merge2d.World)
    for call in (scene.copy, scene.to_toml, lambda: scene.body("ball"), lambda: merge2d.World(scene),
                 world.step, world.save, lambda: world.name(0), lambda: world.contacts):
        with pytest.raises((merge2d.Error, IndexError)):
            call()
    assert repr(scene).startswith("<merge2d.Scene") and repr(world).startswith("<merge2d.World")


def test_values_of_numpy_are_values():
    scene = ball_on_ground()
    scene.set("gravity", np.array([0.0, -1.0]))
    scene.set("unmerging.ordering", np.bool_(False))
    scene.set("merging.steps", np.int64(5))
    world = merge2d.World(scene, merging_velocity=np.float64(0.02))
    world.step(np.int32(2))
    assert world.gravity == (0.0, -1.0) and world.get("unmerging.ordering") is False
    assert world.get("merging.steps") == 5 and world.get("merging.velocity") == 0.02
    assert world.steps == 2


@pytest.mark.parametrize("title", ['a "b"', "3", "[list", "back\\slash", "true", "Füße = 2"])
def test_any_line_is_a_title(title):
    scene = merge2d.Scene(title=title)
    assert scene.get("title") == title
    assert merge2d.Scene("[[body]]\ncircle = 1\n", title=title).get("title") == title


def copies_of(scene):
    return {"copy": copy.copy(scene), "deepcopy": copy.deepcopy(scene),
            "pickle": pickle.loads(pickle.dumps(scene)), "its own": scene.copy()}


def test_scenes_can_be_copied_and_pickled():
    scene = ball_on_ground()
    scene.add_emitter("drop", merge2d.circle(0.1), at=(3, 3), every=0.1, count=2)
    scene.add_force("ball", (0, 0), (1, 0), until=math.inf)
    for way, other in copies_of(scene).items():
        assert other.to_toml() == scene.to_toml(), way
        other.add_body("more", merge2d.circle(1), at=(9, 9))
        assert len(scene) == 2 and len(other) == 3, way


def test_a_scene_in_code_becomes_a_page():
    scene = ball_on_ground()
    scene.set("duration", 0.2)
    page = scene.page("merge", live=False)
    assert isinstance(page, merge2d.Page) and "ball" in page.html
    assert merge2d.World(scene, "merge").page(live=False).html == page.html
