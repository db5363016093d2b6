"""merge2d: 2D rigid bodies that touch and move as one are simulated as one.

Metres, kilograms, seconds, radians; x to the right, y up, counter-clockwise positive. Bodies are
numbered 0, 1, … in the order in which they are added, and go by their number or their name.

>>> import merge2d
>>> world = merge2d.World("books")
>>> world.step(200)
>>> round(world.time, 2), world.counts["collections"]
(2.0, 1)

One world may be used by one thread at a time; a second one gets a RuntimeError. Different worlds may
step at the same time, as `step` does not hold Python's lock.
"""

from ._merge2d import Error, InputError, IoError, SimulationError, Shape, version as _version
from .comparison import Comparison, compare
from .pages import Page, lesson
from .scenes import Scene, box, circle, polygon, scenes
from .worlds import CONTACT_STATES, EVENT_TYPES, JOINT_KINDS, MODES, REASONS, World

__version__ = _version()

__all__ = [
    "CONTACT_STATES", "Comparison", "EVENT_TYPES", "Error", "InputError", "IoError",
    "JOINT_KINDS", "MODES", "Page", "REASONS", "Scene", "Shape", "SimulationError", "World", "box", "circle", "compare",
    "lesson", "polygon", "scenes",
]
