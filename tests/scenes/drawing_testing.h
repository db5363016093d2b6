#pragma once
/// Drawn scenes that run: what is asked of each, whoever drew it.

#include <fmt/format.h>

#include <map>
#include <utility>

#include "tests/scenes/scene_testing.h"

namespace merge2d {

inline constexpr int kDrawnSteps = 2000;

inline SceneRun runDrawn(const Scene& scene, Mode mode) {
  SceneRun run(scene, mode);
  run.steps(kDrawnSteps);
  return run;
}

/// Nothing is faster than a free fall since the start, and nothing sinks into another by a pixel.
inline void expectNoBlowUp(const Scene& scene) {
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    SceneRun run(scene, mode);
    while (run.world().steps() < kDrawnSteps) {
      run.steps(100);
      const double fall = 9.81 * run.world().time();  // [m/s]; some fall off the picture
      const std::string when =
          fmt::format("{} in mode {} after {} steps", scene.name, name(mode), run.world().steps());
      for (const BodyState& body : run.now().bodies) {
        EXPECT_TRUE(body.x.allFinite() && body.v.norm() < 1.05 * fall)
            << when << ": " << run.nameOf(body.id) << " has " << body.v.norm() << " m/s";
      }
      EXPECT_LT(run.now().stats.max_penetration, 0.1) << when;
    }
  }
}

/// Pairs with two loaded contacts are rigid by themselves: at rest they are to be one, unless both
/// are about to slide.
inline void expectMergesWhatRests(const Scene& scene) {
  const SceneRun sleeping = runDrawn(scene, Mode::Sleep), merged = runDrawn(scene, Mode::Merge);
  std::map<std::pair<BodyId, BodyId>, int> apart;
  for (const ContactView& contact : merged.now().contacts) {
    const double limit = contact.mu * contact.lambda_n;
    if (contact.internal || contact.lambda_n <= 0.0) continue;
    if (std::abs(contact.lambda_t) > (1.0 - 1e-6) * limit) continue;
    ++apart[{contact.a, contact.b}];
  }
  for (const auto& [pair, contacts] : apart) {
    const auto rests = [&](BodyId id) {
      return !sleeping.dynamic(id) || sleeping.body(sleeping.nameOf(id)).asleep;
    };
    if (contacts < 2 || !rests(pair.first) || !rests(pair.second)) continue;
    ADD_FAILURE() << scene.name << ": " << merged.nameOf(pair.first) << " and "
                  << merged.nameOf(pair.second) << " rest on each other and are not merged";
  }
}

}  // namespace merge2d
