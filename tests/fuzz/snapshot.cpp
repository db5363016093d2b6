/// Snapshots with a checksum that fits: true ones, in which an input changes bytes, numbers and
/// lengths. So the inputs stay of use when a state gets other fields.

#include <array>
#include <cstring>
#include <vector>

#include "src2d/core/digest.h"
#include "src2d/state_file.h"
#include "tests/fuzz/harness.h"

namespace merge2d::fuzz {
namespace {

constexpr std::string_view kScene = R"(
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [20, 1]
[[body]]
name = "brick"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [2, 2], spacing = [1.01, 1.0] }
[[body]]
name = "tee"
at = [-4, 0.5]
shapes = [{ box = [0.2, 1] }, { box = [1, 0.2], at = [0, 0.6] }]
[[body]]
name = "ball"
at = [-2, 0.4]
circle = 0.4
velocity = [1, 0]
pinned_until = 0.1
[[spring]]
body = "tee"
to = [-4, 3]
stiffness = 2
[[joint]]
kind = "weld"
bodies = ["brick[0,1]", "brick[1,1]"]
at = [0.5, 1.5]
[[emitter]]
name = "rain"
at = [4, 3]
circle = 0.2
every = 0.2
count = 2
)";

const Scene& scene() {
  static const Scene loaded = parseScene(kScene, "fuzz.toml");
  return loaded;
}

World fresh() { return World(scene(), {.timings = false}); }

/// Early and late ones, with free bodies, collections and additions.
const std::vector<std::string>& bases() {
  static const std::vector<std::string> saved = [] {
    std::vector<std::string> all;
    World world = fresh();
    for (int step = 0; step <= 40; ++step) {
      if (step % 20 == 0) all.push_back(world.save());
      world.step();
    }
    BodyDesc extra;
    extra.name = "extra";
    extra.shapes = {makeBox(0.5, 0.5)};
    extra.at = {1, 4};
    world.addBody(extra);
    world.addSpring({.body = 2, .to = {0, 4}, .to_body = {}, .stiffness = 5});
    world.removeBody(BodyId{5});
    world.step();
    all.push_back(world.save());
    return all;
  }();
  return saved;
}

/// The numbers that an input consists of.
class Numbers {
 public:
  explicit Numbers(std::string_view bytes) : rest_(bytes) {}
  bool more() const { return !rest_.empty(); }
  template <class T>
  T next() {
    std::array<char, sizeof(T)> bytes{};
    const std::size_t there = std::min(bytes.size(), rest_.size());
    std::memcpy(bytes.data(), rest_.data(), there);
    rest_.remove_prefix(there);
    T number{};
    std::memcpy(&number, bytes.data(), sizeof number);
    return number;
  }

 private:
  std::string_view rest_;
};

template <class T>
void overwrite(std::string& bytes, std::size_t at, T number) {
  if (bytes.size() < sizeof number) return;
  std::memcpy(bytes.data() + at % (bytes.size() - sizeof number + 1), &number, sizeof number);
}

/// Each change: its kind, its place, and a number.
std::string changed(std::string bytes, Numbers input) {
  constexpr std::size_t kHeader = kStateStart.size() + 4 + 3 * 8 + sizeof(Mode);
  std::string body = bytes.substr(kHeader, bytes.size() - kHeader - sizeof(std::uint64_t));
  for (int changes = 0; input.more() && changes < 8; ++changes) {
    const auto what = input.next<std::uint8_t>();
    const std::size_t at = input.next<std::uint32_t>() % (body.size() + 1);
    switch (what % 5) {
      case 0:
        overwrite(body, at, input.next<std::uint8_t>());
        break;
      case 1:
        overwrite(body, at, input.next<std::uint32_t>());
        break;
      case 2:
        overwrite(body, at, input.next<std::uint64_t>());
        break;
      case 3:
        body.erase(at, input.next<std::uint8_t>());
        break;
      default:
        body.insert(at, input.next<std::uint8_t>(), '\0');
        break;
    }
  }
  bytes = bytes.substr(0, kHeader) + body;
  const std::uint64_t checksum = digestOf(bytes);
  bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  return bytes;
}

}  // namespace

void tryInput(std::string_view bytes) {
  Numbers input(bytes);
  const std::string& base = bases()[input.next<std::uint8_t>() % bases().size()];
  World world = fresh();
  try {
    world.restore(changed(base, input), "fuzz.state");
    world.capture();
    for (int i = 0; i < 3; ++i) world.step();
    world.capture();
  } catch (const InputError&) {
  } catch (const SimulationError&) {
  }
}

}  // namespace merge2d::fuzz
