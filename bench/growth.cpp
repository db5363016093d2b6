/// The cost of a step against the number of bodies (growth_situations.h), in milliseconds, and
/// times as long as without kicks. Fails where it grows faster than N^1.15; N^1.5 where caches
/// decide, N where only the surface of a heap may count, and N^0.3 where N may not count at all.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bench/growth_situations.h"

namespace merge2d::bench {
namespace {

constexpr int kRepeats = 3;  ///< of which the fastest counts

/// The slope of the best line through the logarithms.
double exponentOf(const std::vector<int>& sizes, const std::vector<double>& seconds) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto n = static_cast<double>(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double a = std::log(sizes[i]), b = std::log(seconds[i]);
    x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

double fastest(const std::function<double(int n)>& seconds, int n) {
  double least = 1e300;
  for (int i = 0; i < (n < kHuge ? kRepeats : 1); ++i) least = std::min(least, seconds(n));
  return least;
}

/// Prints a row; true when the cost grows as it may.
bool report(const Situation& situation) {
  std::vector<double> seconds;
  for (const int n : situation.sizes) seconds.push_back(fastest(situation.seconds, n));
  const double exponent = exponentOf(situation.sizes, seconds);
  fmt::print("| {} |", situation.name);
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    fmt::print(" {}: {:.3g}", situation.sizes[i], 1e3 * seconds[i]);
    if (situation.without) {
      fmt::print(" ({:.2f}×)", seconds[i] / fastest(situation.without, situation.sizes[i]));
    }
    fmt::print(" |");
  }
  fmt::print(" {:.2f} |\n", exponent);
  const bool grows = exponent > situation.limit;
  if (grows) fmt::print(stderr, "growth: {}: faster than N^{}\n", situation.name, situation.limit);
  return !grows;
}

}  // namespace
}  // namespace merge2d::bench

int main(int argc, char** argv) {
  using namespace merge2d::bench;
  CLI::App app("Prints what a step costs against the number of bodies");
  std::string only;
  app.add_option("--only", only, "Only the situations whose name contains this");
  CLI11_PARSE(app, argc, argv);
  bool linear = true;
  fmt::print("| situation | bodies: ms | | | | exponent |\n|---|--:|--:|--:|--:|--:|\n");
  for (const Situation& situation : situations()) {
    if (std::string(situation.name).find(only) == std::string::npos) continue;
    linear &= report(situation);
  }
  return linear ? 0 : 1;
}
