"""A small study: how the merging threshold changes the work and the error, on two threads."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np

import merge2d

STEPS = 150


def run(velocity):
    """Mean number of simulated bodies, and the largest distance from the reference [m]."""
    merged = merge2d.World("books", merging_velocity=velocity)
    reference = merge2d.World("books", "reference")
    bodies, distance = [], 0.0
    for _ in range(STEPS):
        merged.step()
        reference.step()
        bodies.append(merged.counts["active_bodies"])
        away = np.linalg.norm(merged.positions - reference.positions, axis=1)
        distance = max(distance, np.nanmax(away))
    return velocity, np.mean(bodies), distance


# Worlds step side by side: step() does not hold Python's lock.
with ThreadPoolExecutor(2) as pool:
    for velocity, bodies, distance in pool.map(run, (0.001, 0.01, 0.1)):
        print(f"merging.velocity = {velocity:g} m/s: {bodies:.1f} bodies, {distance:.3f} m away")
