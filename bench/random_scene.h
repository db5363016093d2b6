#pragma once
/// The parts of random scenes.

#include <CLI/CLI.hpp>
#include <cstddef>
#include <map>
#include <random>
#include <string>

#include "src2d/scene/names.h"
#include "src2d/scene/scene.h"

namespace merge2d::bench {

inline BodyDesc box(const std::string& name, double width, double height, const Vec2& at) {
  BodyDesc body;
  body.name = name;
  body.at = at;
  body.shapes = {makeBox(width, height)};
  return body;
}

/// The same on every machine: distributions of the library are not.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  std::size_t below(std::size_t n) { return engine_() % n; }

 private:
  std::mt19937 engine_;
};

/// Which random scenes to make, and how much to say of them.
struct Cases {
  int count = 0;
  unsigned seed = 1;
  bool quiet = false;
  UnmergingRule rule = UnmergingRule::Default;

  void addTo(CLI::App& app) {
    app.add_option("--cases", count, "How many");
    app.add_option("--seed", seed, "Of the first one");
    app.add_flag("--quiet", quiet, "Only the sum");
    const std::map<std::string, UnmergingRule> rules(kNames<UnmergingRule>.begin(),
                                                     kNames<UnmergingRule>.end());
    app.add_option("--rule", rule, "Of unmerging")->transform(CLI::CheckedTransformer(rules));
  }
  Random random(int number) const { return Random(seed + static_cast<unsigned>(number)); }
};

}  // namespace merge2d::bench
