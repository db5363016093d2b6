#pragma once
/// One engine among those that are measured side by side.

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "src2d/scene/scene.h"

namespace merge2d::bench {

class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;
  /// Bodies, shapes and materials of the scene; a peer's own scene holds at most one.
  virtual void load(const Scene& scene) = 0;
  /// One more body between two steps, without a script.
  virtual void add(const BodyDesc& desc) = 0;
  virtual void step() = 0;
  /// Centres of mass, in the scene's order [m].
  virtual std::vector<Vec2> positions() const = 0;
  /// The memory that the engine itself reports; 0 when it reports none.
  virtual std::size_t ownBytes() const { return 0; }
};

struct ScriptedVelocity {
  Vec2 v = Vec2::Zero();  ///< [m/s]
  double omega = 0.0;     ///< [rad/s]
};

/// The velocity that takes a scripted body from where it is at `t` to where it should be at `t +
/// h`; of the scripts that the scenes of the comparison use.
inline ScriptedVelocity scriptedVelocity(const Script& script, double t, double h) {
  if (const auto* steady = std::get_if<SteadyMotion>(&script)) {
    return {steady->velocity, steady->spin};
  }
  const auto& swing = std::get<Sinusoid>(script);
  const double angular = 2.0 * std::numbers::pi / swing.period;
  const double way = swing.amplitude * (std::cos(angular * t) - std::cos(angular * (t + h)));
  return {swing.axis * way / h, 0.0};
}

}  // namespace merge2d::bench
