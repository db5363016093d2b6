#include "bench/random_pile.h"

#include <fmt/format.h>

#include <random>
#include <string>

#include "src2d/scene/load.h"

namespace merge2d {

Scene randomPile(std::uint64_t seed, int bodies, int columns) {
  std::mt19937_64 random(seed);
  const auto unit = [&] { return static_cast<double>(random() >> 11u) * 0x1p-53; };
  const double width = columns * 1.1;
  std::string toml = fmt::format(
      "format = 1\n[[body]]\nmotion = \"pinned\"\nat = [0, -0.5]\nbox = [{0}, 1]\n"
      "[[body]]\nmotion = \"pinned\"\nat = [{1}, 10]\nbox = [1, 30]\n"
      "[[body]]\nmotion = \"pinned\"\nat = [-{1}, 10]\nbox = [1, 30]\n",
      width + 4.0, 0.5 * width + 0.5);
  for (int i = 0; i < bodies; ++i) {
    const double size = 0.5 + 0.4 * unit();
    const double x = (i % columns + 0.5) * 1.1 - 0.5 * width + 0.05 * (unit() - 0.5);
    toml += fmt::format("[[body]]\nat = [{}, {}]\nangle = {}\n", x, 0.7 + i / columns * 1.1,
                        360.0 * unit());
    switch (random() % 3) {
      case 0:
        toml += fmt::format("circle = {}\n", 0.5 * size);
        break;
      case 1:
        toml += fmt::format("box = [{}, {}]\n", 0.8 * size, 0.6 * size);
        break;
      default:
        toml += fmt::format("polygon = [[-{0}, -{1}], [{0}, -{1}], [0, {0}]]\n", 0.5 * size,
                            0.3 * size);
    }
  }
  return parseScene(toml, fmt::format("pile-{}.toml", seed));
}

}  // namespace merge2d
