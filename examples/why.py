"""Why two bodies are one, or not: in words and in numbers."""

import merge2d

world = merge2d.World("books", decisions=True)
a, b = 1, 2
last = None
for _ in range(100):
    world.step()
    words = world.why(a, b)
    if words.split(":")[0] != last:
        last = words.split(":")[0]
        print(f"step {world.steps}: {words}")

tests = world.decisions
for test in tests[:3]:
    print(f"{test['stage']}: {test['criterion']} {test['value']:.3g} against "
          f"{test['threshold']:.3g}, {test['verdict']}")
assert last is not None
