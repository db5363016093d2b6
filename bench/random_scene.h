#pragma once
/// The parts of random scenes.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstddef>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "src2d/scene/names.h"
#include "src2d/scene/scene.h"

namespace merge2d::bench {

inline constexpr double kDegree = std::numbers::pi / 180.0;

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

/// On the first body; its other end is on the world.
inline void addSpring(Scene& scene, const Vec2& anchor, const Vec2& to, double stiffness,
                      double damping) {
  SpringDesc spring;
  spring.body = 0;
  spring.anchor = anchor;
  spring.to = to;
  spring.stiffness = stiffness;
  spring.damping = damping;
  scene.springs.push_back(spring);
}

template <class T, std::size_t n>
T oneOf(Random& random, const std::array<T, n>& values) {
  return values[random.below(n)];
}

/// The same scene with contacts ten times as hard, of which a reference converges.
inline Scene hardened(Scene scene) {
  scene.settings.solver.iterations = 100;
  scene.settings.solver.compliance *= 0.1;
  return scene;
}

inline constexpr double kNever = 1e9;  ///< the time of what does not happen [s]

inline std::string shown(double time) {
  return time == kNever ? "never" : fmt::format("{:5.2f}", time);
}

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
