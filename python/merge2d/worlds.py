"""Worlds: scenes that move on by time steps."""

import io
import math
import os
import struct
import zlib

import numpy as np

from . import _merge2d
from .scenes import Scene, body_args, joint_args, key_of, number_of, text_of

MODES = ("reference", "sleep", "merge", "merge+sleep")
CONTACT_STATES = ("broken", "sticking", "sliding")
JOINT_KINDS = ("revolute", "weld", "distance", "prismatic")
EVENT_TYPES = ("merge", "unmerge", "sleep", "wake", "impact", "emit", "break")
REASONS = ("none", "broken", "sliding", "relative-motion", "user")

_EVENT = np.dtype([("type", "U8"), ("reason", "U16"), ("a", "u4"), ("b", "u4"),
                   ("collection", "i4")])
_DECISION = np.dtype([("a", "u4"), ("b", "u4"), ("value", "f8"), ("threshold", "f8"),
                      ("count", "i4"), ("needed", "i4"), ("before", "i4"), ("stage", "U32"),
                      ("criterion", "U24"), ("equation", "U48"), ("verdict", "U16")])


class World(_merge2d.World):
    """A simulation.

    `scene` is a Scene or what Scene takes: a name, a path, or a text. `mode`: "reference", "sleep",
    "merge" or "merge+sleep". With `decisions`, each step notes why bodies merged or not, for
    `decisions` and `why`. Settings are those of scene files, with "_" for ".".

    >>> import merge2d
    >>> world = merge2d.World("books", merging_velocity=0.02)
    >>> heights = world.positions[:, 1]      # a view: it follows the world
    >>> before = heights.copy()
    >>> world.step(50)
    >>> bool((heights != before).any())
    True
    """

    __slots__ = ("_scene", "_noting")  # a misspelled name of an attribute is an AttributeError

    def __init__(self, scene, mode="merge+sleep", *, decisions=False, **settings):
        if not isinstance(scene, Scene):
            scene = Scene(scene, **settings)
        elif settings:
            scene = scene.copy()
            for name, value in settings.items():
                scene.set(key_of(name), value)
        super().__init__(scene, mode)
        self._scene = scene.copy()
        self.noting = decisions

    # Time

    @property
    def time(self):
        """Simulated time [s]."""
        return super().time()

    @property
    def steps(self):
        """Time steps taken so far."""
        return super().steps()

    @property
    def time_step(self):
        """h [s]; it can be set between two steps, which wakes all bodies.

        >>> import merge2d
        >>> world = merge2d.World("books")
        >>> world.step(10)
        >>> world.time_step /= 2
        >>> world.step(10)
        >>> round(world.time, 9)
        0.15
        """
        return super().time_step()

    @time_step.setter
    def time_step(self, h):
        super()._set_time_step(h)

    @property
    def mode(self):
        """Of MODES; it can be set between two steps."""
        return super().mode()

    @mode.setter
    def mode(self, mode):
        super()._set_mode(mode)

    @property
    def gravity(self):
        """(x, y) [m/s²]; it can be set between two steps."""
        return super().gravity()

    @gravity.setter
    def gravity(self, gravity):
        super()._set_gravity(gravity)

    def set(self, key, value):
        """Changes a setting: `world.set("merging.velocity", 0.02)`."""
        super().set(key, text_of(value))

    def get(self, key):
        """A setting in force."""
        return number_of(super().get(key))

    def save(self):
        """Everything that influences the steps to come, as bytes.

        >>> import merge2d
        >>> world = merge2d.World("books")
        >>> state = world.save()
        >>> world.step(10); there = world.positions.copy()
        >>> world.restore(state); world.step(10)
        >>> bool((world.positions == there).all())
        True
        """
        return super().save()

    def restore(self, state, *, other_settings=False):
        """Goes on from bytes that a world of the same scene saved; with `other_settings`, also from
        one with other settings or in another mode. This world keeps its own."""
        super().restore(state, other_settings)

    # Bodies. Views are read-only and follow the world; a body that is not there has NaN, or -1.

    @property
    def positions(self):
        """Centres of mass [m]: a view of shape (bodies, 2)."""
        return super().positions()

    @property
    def angles(self):
        """[rad]: a view of shape (bodies,)."""
        return super().angles()

    @property
    def velocities(self):
        """Of the centres of mass [m/s]: a view of shape (bodies, 2)."""
        return super().velocities()

    @property
    def spins(self):
        """Angular velocities [rad/s]: a view of shape (bodies,)."""
        return super().spins()

    @property
    def collection_ids(self):
        """The collection of each body, or -1: a view of shape (bodies,)."""
        return super().collection_ids()

    def __len__(self):
        return super()._body_count()

    def __bool__(self):
        return True

    @property
    def names(self):
        """The names of all bodies."""
        return [super(World, self).name(i) for i in range(len(self))]

    def add_body(self, name="", shapes=(), at=(0.0, 0.0), *, angle=0.0, motion="dynamic",
                 velocity=(0.0, 0.0), spin=0.0, mass=None, density=1.0, friction=0.6,
                 restitution=0.0, rolling=0.0, surface_velocity=0.0, pinned_until=0.0):
        """Adds a dynamic or pinned body, as Scene.add_body does. Views that were taken before do not
        see it: take them anew."""
        return super().add_body(body_args(name, shapes, at, angle, motion, velocity, spin, mass,
                                          density, friction, restitution, rolling,
                                          surface_velocity, pinned_until, None))

    def add_spring(self, body, anchor, to, *, to_body=None, stiffness, damping=0.0,
                   rest_length=0.0):
        """As Scene.add_spring."""
        return super().add_spring(body, anchor, to, to_body, stiffness, damping, rest_length)

    def add_joint(self, kind, a, b=None, at=(0.0, 0.0), *, to=(0.0, 0.0), axis=(1.0, 0.0),
                  length=None, stiffness=0.0, damping=0.0, limits=None, motor=None,
                  compliance=0.0, break_force=math.inf, break_torque=math.inf, collide=False):
        """As Scene.add_joint."""
        return super().add_joint(joint_args(kind, a, b, at, to, axis, length, stiffness, damping,
                                            limits, motor, compliance, break_force, break_torque,
                                            collide))

    # Records of the last step

    @property
    def counts(self):
        """How much the last step had to do: bodies, active_bodies, collections, asleep, contacts,
        internal_contacts."""
        return super().counts()

    @property
    def sums(self):
        """Energies [J], momenta [N s, N m s], residual and deepest overlap [m]."""
        return super().sums()

    @property
    def contacts(self):
        """Contact points: a, b, feature, state (of CONTACT_STATES), internal, fresh, x, y, nx, ny,
        gap [m], lambda_n, lambda_t [N s], w_n, w_t [m/s]; Eqs. (4) to (7) of the paper hold.

        >>> import merge2d
        >>> world = merge2d.World("books")
        >>> world.step(100)
        >>> contacts = world.contacts
        >>> bool((contacts["lambda_n"][contacts["state"] > 0] > 0).all())
        True
        """
        return super().contacts()

    @property
    def joints(self):
        """By number: kind (of JOINT_KINDS), a, b (4294967295: the world), broken, internal, the ends
        ax, ay, bx, by [m], fx, fy [N] and torque [N m] on b."""
        return super().joints()

    @property
    def springs(self):
        """Those that acted in the last step: number, a, b (4294967295: the world), the ends ax, ay,
        bx, by [m], force [N] along it, above 0 where it pulls."""
        return super().springs()

    @property
    def events(self):
        """Of the last step: type, reason, a, b, collection (Sections 5 to 7 of the paper)."""
        raw = super().events()
        out = np.empty(raw.shape, _EVENT)
        out["type"] = np.take(EVENT_TYPES, raw["type"])
        out["reason"] = np.take(REASONS, raw["reason"])
        for field in ("a", "b", "collection"):
            out[field] = raw[field]
        return out

    @property
    def noting(self):
        """Whether the steps to come note their decisions."""
        return self._noting

    @noting.setter
    def noting(self, on):
        super()._note_decisions(bool(on))
        self._noting = bool(on)

    @property
    def decisions(self):
        """Each test of a criterion in the last step: a, b, value, threshold, count, needed, before,
        stage, criterion, equation (of the paper, "(17)" or "Section 5.1", or the page of a
        criterion of our own), verdict. A record about a collection has its first body as `a`
        and `b`. docs/records.md tells which criteria count something else than steps.
        InputError when the step did not note them."""
        return super().decisions().astype(_DECISION)

    def why(self, a, b):
        """Why two bodies are one or not, after the last step, in words.

        >>> import merge2d
        >>> world = merge2d.World("books", decisions=True)
        >>> world.step(3)
        >>> "cookbook and diary" in world.why("cookbook", "diary")
        True
        """
        return super().why(a, b)

    @property
    def collections(self):
        """Bodies that are simulated as one, by id (1, 2 …; never used again): id, first, count,
        anchor (4294967295: none), asleep, mass [kg], inertia [kg m²], x, y [m], vx, vy [m/s], omega
        [rad/s]. `members` has their bodies.

        >>> import merge2d
        >>> world = merge2d.World("books")
        >>> world.step(200)
        >>> int(world.collections["count"].sum()) == len(world.members)
        True
        """
        return super()._collection_array()[0]

    @property
    def members(self):
        """The bodies of all collections, ascending in each: those of `c` are
        `members[c["first"]:c["first"] + c["count"]]`."""
        return super()._collection_array()[1]

    # Pictures

    def render(self, width=960, height=540, *, overlays="", theme="light", transparent=False,
               camera=None):
        """The world as an array of shape (height, width, 4): RGBA, rows from the top.

        `overlays`: "contacts,forces", "none", …; `theme`: "light", "dark" or "print"; `camera`:
        (x, y, visible height) [m], else that of the scene.
        """
        return super().render(width, height, overlays, theme, transparent, camera)

    def write_png(self, path, width=960, height=540, *, overlays="", theme="light",
                  transparent=False, camera=None):
        """The same as a file, which appears complete or not at all."""
        super().write_png(os.fspath(path), width, height, overlays, theme, transparent, camera)

    def _repr_png_(self):
        return png_of(self.render(720, 405))

    def page(self, live=True):
        """The scene as it was at first, run for its duration, as a page for a browser."""
        return self._scene.page(self.mode, live=live)

    def __repr__(self):
        if not hasattr(self, "_scene"):
            return "<merge2d.World that was not made>"
        return f"<merge2d.World of {len(self)} bodies, {self.mode}, t = {self.time:g} s>"


def png_of(rgba):
    """An array of `World.render` as the bytes of a PNG file."""
    height, width, _ = rgba.shape
    rows = np.zeros((height, 1 + 4 * width), np.uint8)  # each begins with "no filter"
    rows[:, 1:] = rgba.reshape(height, 4 * width)
    out = io.BytesIO()
    out.write(b"\x89PNG\r\n\x1a\n")
    for kind, data in ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)),
                       (b"IDAT", zlib.compress(rows.tobytes(), 6)), (b"IEND", b"")):
        out.write(struct.pack(">I", len(data)) + kind + data)
        out.write(struct.pack(">I", zlib.crc32(kind + data)))
    return out.getvalue()
