#pragma once
/// A run that a person changes while it goes on: what the page's engine and `merge2d step` do.

#include <map>
#include <string>
#include <string_view>

#include "src2d/trace/recorder.h"

namespace merge2d {

/// A spring from a point of a body to a place that a hand holds.
struct Drag {
  Vec2 grip = Vec2::Zero();    ///< in the frame at the centre of mass [m]
  Vec2 target = Vec2::Zero();  ///< in the world [m]
};

class Live {
 public:
  explicit Live(const Scene& scene, Mode mode = Mode::MergeSleep);

  World& world() { return recorder_.world(); }
  const World& world() const { return recorder_.world(); }

  /// Without looking inside.
  void skipTo(std::int64_t step);
  StepRecord step();

  /// The spring holds until it is let go. It is critically damped for the body's mass, and soft
  /// enough for the time step.
  void drag(BodyId body, const Drag& drag) { drags_[body] = drag; }
  void letGo(BodyId body) { drags_.erase(body); }
  void letAllGo() { drags_.clear(); }
  /// The force that the hand gives in the step to come [N].
  Vec2 force(BodyId body) const;

 private:
  void pull();

  Recorder recorder_;
  std::map<BodyId, Drag> drags_;
};

}  // namespace merge2d
