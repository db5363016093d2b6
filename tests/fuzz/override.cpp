/// `--set key=value`, one in each line, on a scene with something of everything.

#include "tests/fuzz/harness.h"

namespace merge2d::fuzz {
namespace {

constexpr std::string_view kScene = R"(
[solver]
iterations = 8
[[body]]
name = "ground"
motion = "pinned"
box = [40, 1]
[[body]]
name = "a.b"
at = [0, 1.5]
shapes = [{ box = [1, 1] }, { circle = 0.5, at = [1, 0] }]
[[body]]
name = "ball"
at = [4, 3]
circle = 0.4
[[spring]]
body = "ball"
to = [4, 5]
stiffness = 20
[[joint]]
kind = "revolute"
bodies = ["a.b", "ball"]
at = [2, 2]
[[emitter]]
at = [-4, 5]
circle = 0.2
every = 0.3
count = 6
)";

}  // namespace

void tryInput(std::string_view bytes) {
  Overrides overrides;
  while (!bytes.empty()) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    overrides.emplace_back(line.substr(0, equals), line.substr(equals + 1));
  }
  try {
    requireSound(parseScene(kScene, "fuzz.toml", overrides));
  } catch (const InputError&) {
  }
}

}  // namespace merge2d::fuzz
