"""The four modes side by side: time, bodies, and distance from the reference."""

import merge2d

result = merge2d.compare("books", 2.0)
print(result)
assert result.active_bodies["merge"].mean() < result.active_bodies["reference"].mean()
