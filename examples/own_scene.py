"""A scene of one's own: an arch of wedges from their corners, on two pillars."""

import math

import merge2d

scene = merge2d.Scene(step=0.005)
scene.add_body("ground", merge2d.box(12, 1), at=(0, -0.5), motion="pinned")
STONES, INNER, OUTER = 9, 2.0, 2.8
for side in (-1, 1):
    scene.add_body(f"pillar {side}", merge2d.box(1.0, 1.0), at=(side * 2.4, 0.5), motion="pinned")
for i in range(STONES):
    a, b = (math.pi * (i + k) / STONES for k in (0, 1))
    scene.add_body(f"stone {i}", [(r * math.cos(t), 1.0 + r * math.sin(t))
                                  for r, t in ((INNER, a), (OUTER, a), (OUTER, b), (INNER, b))])

world = merge2d.World(scene)
start = world.positions.copy()
world.step(600)
moved = abs(world.positions - start).max()
print(f"after {world.time:.1f} s the arch has moved by {1000 * moved:.1f} mm; "
      f"{world.counts['active_bodies']} bodies are simulated")
world.write_png("arch.png", 480, 270)
assert moved < 0.05, "the arch has fallen"
