#pragma once
/// A run that a person changes while it goes on: what the page's engine and `merge2d step` do.

#include <map>
#include <string>
#include <string_view>

#include "render/palette.h"
#include "src2d/recorder.h"

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
  /// The colours of the collections that there are.
  const CollectionSlots& colors() const { return slots_; }

  /// Without looking inside.
  void skip();
  void skipTo(std::int64_t step);
  StepRecord step();

  /// The spring holds until it is let go. It is critically damped for the body's mass, and soft
  /// enough for the time step.
  void drag(BodyId body, const Drag& drag) { drags_[body] = drag; }
  /// Wakes it: a body that was held still may have fallen asleep in the air.
  void letGo(BodyId body);
  const std::map<BodyId, Drag>& drags() const { return drags_; }
  /// The force that the hand gives in the step to come [N].
  Vec2 force(BodyId body) const;

  /// All that influences the steps to come, settings and hands included.
  struct Saved {
    std::string bytes;
    Settings settings;
    Vec2 gravity = Vec2::Zero();
    double h = 0.01;  ///< [s]
    Mode mode = Mode::MergeSleep;
    std::map<BodyId, Drag> drags;
    CollectionColors chosen;
    CollectionSlots slots;
  };
  Saved save() const;
  /// Continues bit for bit from a saved state of the same scene.
  void restore(const Saved& saved);

 private:
  void pull();
  void choose(const Snapshot& seen) { slots_ = chosen_.update(seen); }

  Recorder recorder_;
  std::map<BodyId, Drag> drags_;
  CollectionColors chosen_;
  CollectionSlots slots_;
};

}  // namespace merge2d
