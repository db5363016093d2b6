"""One scene in the four modes."""

import math
from time import perf_counter

import numpy as np

from ._merge2d import InputError
from .scenes import Scene
from .worlds import MODES, World


class Comparison:
    """What each mode took and did: arrays by mode, with an element per time step.

    `time` [s]; and by mode `seconds` that a step took, `active_bodies`, `contacts`,
    `internal_contacts`, and `distance` [m], the largest one of a body's centre from where it is in
    the reference.
    """

    def __init__(self, time, seconds, counts, distance):
        self.time = time
        self.seconds = seconds
        self.active_bodies = {mode: counts[mode]["active_bodies"] for mode in counts}
        self.contacts = {mode: counts[mode]["contacts"] for mode in counts}
        self.internal_contacts = {mode: counts[mode]["internal_contacts"] for mode in counts}
        self.distance = distance

    def rows(self):
        """(mode, mean milliseconds a step, mean active bodies, mean contacts, largest distance)."""
        return [(mode, 1e3 * self.seconds[mode].mean(), self.active_bodies[mode].mean(),
                 self.contacts[mode].mean(), self.distance[mode].max()) for mode in self.seconds]

    def __repr__(self):
        lines = [f"{'mode':<12}{'ms/step':>9}{'bodies':>9}{'contacts':>10}{'distance':>10}"]
        lines += [f"{mode:<12}{ms:>9.3f}{bodies:>9.1f}{contacts:>10.1f}{far:>9.3f}m"
                  for mode, ms, bodies, contacts, far in self.rows()]
        return "\n".join(lines)

    def _repr_html_(self):
        head = "".join(f"<th>{h}</th>" for h in
                       ("mode", "ms a step", "active bodies", "contacts", "distance [m]"))
        rows = "".join(f"<tr><td>{m}</td><td>{t:.3f}</td><td>{b:.1f}</td><td>{c:.1f}</td>"
                       f"<td>{d:.3f}</td></tr>" for m, t, b, c, d in self.rows())
        return f"<table><tr>{head}</tr>{rows}</table>"


def compare(scene, seconds=None, *, modes=MODES, **settings):
    """Runs a scene in several modes, step by step side by side.

    `scene` is what World takes; `seconds` of simulated time, by default the scene's duration.

    >>> import merge2d
    >>> result = merge2d.compare("books", 0.5)
    >>> float(result.distance["reference"].max())
    0.0
    """
    if not isinstance(scene, Scene):
        scene = Scene(scene, **settings)
        settings = {}
    seconds = scene.get("duration") if seconds is None else seconds
    if not 0.0 < seconds < math.inf:
        raise InputError(f"'seconds' must be positive, but is {seconds}")
    if isinstance(modes, str):
        modes = [modes]
    modes = ["reference"] + [mode for mode in modes if mode != "reference"]
    worlds = {mode: World(scene, mode, **settings) for mode in modes}
    steps = max(1, round(seconds / worlds["reference"].time_step))
    fields = ("active_bodies", "contacts", "internal_contacts")
    took = {mode: np.empty(steps) for mode in modes}
    counts = {mode: {field: np.empty(steps, int) for field in fields} for mode in modes}
    distance = {mode: np.zeros(steps) for mode in modes}
    places = {mode: world.positions for mode, world in worlds.items()}
    for step in range(steps):
        for mode, world in worlds.items():
            begin = perf_counter()
            world.step()
            took[mode][step] = perf_counter() - begin
            now = world.counts
            for field in fields:
                counts[mode][field][step] = now[field]
            away = np.linalg.norm(places[mode] - places["reference"], axis=1)
            distance[mode][step] = np.nanmax(away, initial=0.0)
    time = worlds["reference"].time_step * np.arange(1, steps + 1)
    return Comparison(time, took, counts, distance)
