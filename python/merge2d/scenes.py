"""Scenes: the bodies, springs, joints and settings that a world begins with."""

import math
import numbers
import os

from . import _merge2d


def circle(radius, center=(0.0, 0.0)):
    """A disc in its body's frame [m]."""
    return _merge2d.circle(radius, center)


def box(width, height, center=(0.0, 0.0), angle=0.0):
    """A rectangle about `center` [m], turned by `angle` [rad]."""
    return _merge2d.box(width, height, center, angle)


def polygon(outline):
    """A polygon, convex or not, from its corners [m] or from a geometry of Shapely.

    `outline` is a sequence of (x, y) or an array of shape (n, 2), in either direction; a last corner
    that repeats the first is left out. A polygon with holes is an InputError: cut it first.

    >>> import merge2d
    >>> house = merge2d.polygon([(0, 0), (2, 0), (2, 1), (1, 2), (0, 1)])
    """
    if hasattr(outline, "exterior"):
        if len(outline.interiors) > 0:
            raise _merge2d.InputError("a polygon with holes cannot be a shape: cut it first")
        outline = outline.exterior.coords
    try:
        corners = [(float(p[0]), float(p[1])) for p in outline]
    except (TypeError, IndexError, ValueError):
        raise TypeError("a shape is a circle, a box, a polygon, corners [(x, y), …] or a geometry of "
                        f"Shapely, not {outline!r:.60}") from None
    if len(corners) > 1 and corners[0] == corners[-1]:
        corners.pop()
    return _merge2d.polygon(corners)


def _shapes(shapes):
    """What `add_body` takes as shapes, as a list of them."""
    if isinstance(shapes, _merge2d.Shape):
        return [shapes]
    if hasattr(shapes, "exterior"):
        return [polygon(shapes)]
    if hasattr(shapes, "geoms"):
        return [polygon(part) for part in shapes.geoms]
    if not hasattr(shapes, "__iter__"):
        return [polygon(shapes)]  # which refuses it
    shapes = list(shapes)
    if shapes and not isinstance(shapes[0], _merge2d.Shape) and not hasattr(shapes[0], "exterior"):
        return [polygon(shapes)]  # one outline
    return [s if isinstance(s, _merge2d.Shape) else polygon(s) for s in shapes]


def body_args(name, shapes, at, angle, motion, velocity, spin, mass, density, friction,
              restitution, rolling, surface_velocity, pinned_until, script):
    """The arguments of `add_body` as the module takes them."""
    return {
        "name": name, "shapes": _shapes(shapes), "at": at, "angle": angle,
        "motion": motion if script is None else "scripted", "velocity": velocity,
        "spin": spin, "mass": 0.0 if mass is None else _positive("mass", mass),
        "density": density, "friction": friction, "restitution": restitution, "rolling": rolling,
        "surface_velocity": surface_velocity, "pinned_until": pinned_until,
        "script": None if script is None else _script(script),
    }


def _positive(what, value):
    if not isinstance(value, numbers.Real):
        raise TypeError(f"'{what}' must be a number, not {value!r:.60}")
    if not value > 0.0:
        raise _merge2d.InputError(f"'{what}' must be positive, but is {value}")
    return value


def _key_frame(key):
    try:
        time, x, y, angle = (float(number) for number in key)
    except (TypeError, ValueError):
        raise TypeError(f"each of 'keyframes' is (time, x, y, angle), not {key!r:.60}") from None
    return time, x, y, angle


def _script(script):
    if not hasattr(script, "keys"):
        raise TypeError(f"'script' must be a dictionary, not {script!r:.60}")
    script = dict(script)
    kinds = {"amplitude": "sinusoid", "keyframes": "keyframes", "velocity": "steady",
             "spin": "steady"}
    kind = next((kinds[key] for key in kinds if key in script), None)
    known = {"sinusoid": {"axis", "amplitude", "period"}, "keyframes": {"keyframes"},
             "steady": {"velocity", "spin"}, None: set()}[kind]
    wrong = set(script) - known
    if kind is None or wrong:
        raise _merge2d.InputError(
            "a script has axis, amplitude and period; or keyframes = [(t, x, y, angle), …]; or "
            f"velocity and spin; but not {sorted(wrong or script)}")
    if kind == "keyframes":
        return {"kind": kind, "keyframes": [_key_frame(key) for key in script["keyframes"]]}
    if kind == "steady":
        return {"kind": kind, "velocity": script.get("velocity", (0.0, 0.0)),
                "spin": script.get("spin", 0.0)}
    return {"kind": kind, "axis": script.get("axis", (1.0, 0.0)),
            "amplitude": script["amplitude"], "period": script.get("period", 1.0)}


def joint_args(kind, a, b, at, to, axis, length, stiffness, damping, limits, motor, compliance,
               break_force, break_torque, collide):
    """The arguments of `add_joint` as the module takes them."""
    return {
        "kind": kind, "a": a, "b": b, "at": at, "to": to, "axis": axis,
        "length": 0.0 if length is None else _positive("length", length), "stiffness": stiffness,
        "damping": damping, "limits": limits, "motor": motor, "compliance": compliance,
        "break_force": break_force, "break_torque": break_torque, "collide": collide,
    }


def key_of(name):
    """merging_velocity is merging.velocity: names of tables have no underscore."""
    table, _, key = name.partition("_")
    return f"{table}.{key}" if key and "." not in name else name


def text_of(value):
    """A value as a scene file has it."""
    if hasattr(value, "tolist"):  # a number or an array of NumPy
        value = value.tolist()
    if value is None:
        raise TypeError("a value is a number, True or False, a text or a list, not None")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (tuple, list)):
        return "[" + ", ".join(text_of(v) for v in value) + "]"
    return repr(float(value)) if isinstance(value, float) else str(value)


def number_of(text):
    """The value of a text of a scene file."""
    if text in ("true", "false"):
        return text == "true"
    if text.startswith("["):
        return tuple(float(part) for part in text[1:-1].split(","))
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def _is_text(source):
    """Whether a word is a scene itself, not its name or its path."""
    return "\n" in source or ("=" in source or "[" in source) and not os.path.exists(source)


class Scene(_merge2d.Scene):
    """Bodies, springs, joints and settings.

    `source` is nothing (an empty scene), the name of a built-in scene, a path of a `.toml` or a
    drawn `.png` scene, or the text of a scene. Settings are those of scene files, with "_" for ".":
    `Scene("books", merging_velocity=0.02, step=0.005)`. Raises InputError with file, line and column.

    >>> import merge2d
    >>> scene = merge2d.Scene(gravity=(0, -1.6))
    >>> ground = scene.add_body("ground", merge2d.box(10, 1), at=(0, -0.5), motion="pinned")
    >>> scene.add_body("ball", merge2d.circle(0.5), at=(0, 3))
    1
    >>> scene
    <merge2d.Scene of 2 bodies>
    """

    __slots__ = ()  # a misspelled name of an attribute is an AttributeError

    def __init__(self, source=None, **settings):
        changes = [f"{key_of(name)}={text_of(value)}" for name, value in settings.items()]
        if source is None:
            super().__init__()
            for name, value in settings.items():
                self.set(key_of(name), value)
        elif isinstance(source, str) and _is_text(source):
            super().__init__(_merge2d.Scene._parse(source, "scene", changes))
        else:
            super().__init__(_merge2d.Scene._load(os.fspath(source), changes))

    def set(self, key, value):
        """Sets a value by its name in scene files: `scene.set("merging.velocity", 0.02)`."""
        super().set(key, text_of(value))

    def get(self, key):
        """The value of that name.

        >>> import merge2d
        >>> merge2d.Scene().get("gravity")
        (0.0, -9.81)
        """
        text = super().get(key)
        return text if key == "title" else number_of(text)

    def add_body(self, name="", shapes=(), at=(0.0, 0.0), *, angle=0.0, motion="dynamic",
                 velocity=(0.0, 0.0), spin=0.0, mass=None, density=1.0, friction=0.6,
                 restitution=0.0, rolling=0.0, surface_velocity=0.0, pinned_until=0.0,
                 script=None):
        """Adds a body and returns its number.

        `shapes`: one of `circle`, `box`, `polygon`, several of them, a list of corners, or a
        geometry of Shapely, in the body's frame, which is at `at` [m], turned by `angle` [rad].
        `motion`: "dynamic", "pinned", or "scripted" by a `script`:
        {"axis", "amplitude", "period"}, {"keyframes": [(t, x, y, angle), …]} or {"velocity", "spin"}.
        `velocity` [m/s] is that of the centre of mass. Without `mass` [kg] it is area × `density`.
        """
        return super().add_body(body_args(name, shapes, at, angle, motion, velocity, spin, mass,
                                          density, friction, restitution, rolling,
                                          surface_velocity, pinned_until, script))

    def add_spring(self, body, anchor, to, *, to_body=None, stiffness, damping=0.0,
                   rest_length=0.0):
        """Adds a spring from `anchor` in a body's frame to `to` in the world, or in `to_body`'s
        frame [m]; `stiffness` [N/m], `damping` [N s/m]. Returns its number."""
        return super().add_spring(body, anchor, to, to_body, stiffness, damping, rest_length)

    def add_joint(self, kind, a, b=None, at=(0.0, 0.0), *, to=(0.0, 0.0), axis=(1.0, 0.0),
                  length=None, stiffness=0.0, damping=0.0, limits=None, motor=None,
                  compliance=0.0, break_force=math.inf, break_torque=math.inf, collide=False):
        """Joins two bodies, or `a` to the world, as they stand: "revolute", "weld", "distance" or
        "prismatic". `limits` = (lower, upper) [rad or m], `motor` = (speed, strength). Returns its
        number."""
        return super().add_joint(joint_args(kind, a, b, at, to, axis, length, stiffness, damping,
                                            limits, motor, compliance, break_force, break_torque,
                                            collide))

    def add_impulse(self, body, at, impulse, time):
        """An impulse [N s] at a world point [m], in the step that covers `time` [s]."""
        super().add_impulse(body, at, impulse, time)

    def add_force(self, body, at, force, start=0.0, until=math.inf):
        """A force [N] at a point of the body's frame [m], from `start` until `until` [s]."""
        super().add_force(body, at, force, start, until)

    def add_magnet(self, body, start=0.0, until=math.inf):
        """Makes a body a magnet from `start` until `until` [s]."""
        super().add_magnet(body, start, until)

    def add_emitter(self, name="", shapes=(), at=(0.0, 0.0), *, every, count, start=0.0,
                    spread=(0.0, 0.0), seed=1, **body):
        """Adds `count` copies of a body while the world runs, one `every` so many seconds from
        `start` on, each off `at` by at most `spread` [m]. `body`: what else add_body takes. They are
        numbered behind all other bodies, and named "name[k]"."""
        given = {"angle": 0.0, "motion": "dynamic", "velocity": (0.0, 0.0), "spin": 0.0,
                 "mass": None, "density": 1.0, "friction": 0.6, "restitution": 0.0,
                 "rolling": 0.0, "surface_velocity": 0.0, "pinned_until": 0.0, "script": None}
        unknown = set(body) - set(given)
        if unknown:
            raise TypeError(f"add_emitter has no argument {sorted(unknown)}")
        super().add_emitter(body_args(name, shapes, at, **{**given, **body}), every, count, start,
                            spread, seed)

    def copy(self):
        """A scene of its own; copy.copy(), copy.deepcopy() and pickle work as well."""
        other = Scene.__new__(Scene)
        _merge2d.Scene.__init__(other, self)
        return other

    __copy__ = copy

    def __deepcopy__(self, memo):
        return self.copy()

    def __reduce__(self):
        return _from_toml, (self.to_toml(),)

    def page(self, mode="merge+sleep", *, live=True):
        """The scene, run for its duration in this mode and as reference, as a page for a browser."""
        from .pages import Page
        return Page(super().page(mode, live))

    @property
    def warnings(self):
        """Warnings of loading, and of settings that do not go together: a list of sentences."""
        return super().warnings().splitlines()

    def __len__(self):
        return super()._body_count()

    def __bool__(self):
        return True

    def __repr__(self):
        try:
            return f"<merge2d.Scene of {len(self)} bodies>"
        except _merge2d.InputError:
            return "<merge2d.Scene that was not made>"


def _from_toml(text):
    """The inverse of Scene.to_toml, for pickle."""
    return Scene(text)


def scenes():
    """The built-in scenes: a dictionary from names to titles.

    >>> import merge2d
    >>> "books" in merge2d.scenes()
    True
    """
    return dict(line.split("\t", 1) for line in _merge2d.scene_list().splitlines())
