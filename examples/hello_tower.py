"""A tower of ten boxes comes to rest and becomes one collection."""

import merge2d

scene = merge2d.Scene()
scene.add_body("ground", merge2d.box(20, 1), at=(0, -0.5), motion="pinned")
for i in range(10):
    scene.add_body(shapes=merge2d.box(1, 1), at=(0, 0.5 + i))

world = merge2d.World(scene)
positions = world.positions  # a view: it follows the world
for second in range(3):
    now = world.counts
    print(f"t = {world.time:.1f} s: {now['bodies']} bodies, {now['active_bodies']} simulated, "
          f"{now['collections']} collections; the top box is at y = {positions[10, 1]:.2f} m")
    world.step(100)

assert len(set(world.collection_ids[1:])) == 1
