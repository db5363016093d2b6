#pragma once
/// The common part of the fuzz harnesses. Each defines `tryInput`, which must return for any bytes
/// at all: libFuzzer calls it with bytes that it makes up (clang, `./check --long`), and the tests
/// with the files of corpus/ (any compiler).

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "src2d/core/error.h"
#include "src2d/scene/check.h"
#include "src2d/scene/load.h"
#include "src2d/world.h"

namespace merge2d::fuzz {

/// Tries one input. An error of the user's is fine; anything else is a finding.
void tryInput(std::string_view bytes);

/// Ends the process, so that the fuzzer keeps the input.
inline void require(bool holds, const char* promise, std::string_view what = {}) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n%s\n", promise, std::string(what).c_str());
  std::abort();
}

/// A few steps of a scene that is small enough for many of them in a second.
inline void simulate(const Scene& scene) {
  constexpr std::size_t kBodies = 60, kShapes = 300;
  std::size_t bodies = scene.bodies.size(), shapes = 0;
  for (const BodyDesc& body : scene.bodies) shapes += body.shapes.size();
  for (const EmitterDesc& emitter : scene.emitters) {
    bodies += static_cast<std::size_t>(emitter.count);
  }
  const Settings& s = scene.settings;
  const bool quick = s.solver.iterations <= 50 && s.unmerging.sweeps <= 20;
  if (bodies > kBodies || shapes > kShapes || !quick) return;
  try {
    World world(scene, {.timings = false});
    for (int i = 0; i < 5; ++i) world.step();
    world.capture();
  } catch (const SimulationError&) {
  }
}

/// The written text of a scene loads again, to a scene of the same text; a scene that loads can be
/// checked and simulated.
inline void requireSound(const Scene& scene) {
  constexpr std::size_t kMany = 1000;  // of which more tell nothing new, slowly
  if (scene.bodies.size() > kMany) return;
  const std::string text = toToml(scene);
  try {
    check(scene);
    require(toToml(parseScene(text, "again.toml")) == text, "what loads again is written the same",
            text);
  } catch (const InputError& error) {
    require(false, error.what(), text);
  }
  simulate(scene);
}

}  // namespace merge2d::fuzz
