#pragma once
/// Records what happens inside time steps, stage by stage, so that it can be shown, explained and
/// gone back to later.

#include <array>
#include <cstdint>
#include <vector>

#include "src2d/core/notes.h"
#include "src2d/world.h"

namespace merge2d {

/// A body's velocity after a stage of the single sweep: its own, as if it were not merged. The
/// sweep throws it away; the unmerge criteria look at it.
struct OwnVelocity {
  BodyId body{};
  Vec2 v = Vec2::Zero();  ///< [m/s]
  double omega = 0.0;     ///< [rad/s]
};

/// The state after one stage.
struct StageRecord {
  /// The state after the stage. Contacts carry their impulses as they are then: of the last step
  /// up to WarmStart, of the sweep inside collections after it, of the full solve after SolveLCP.
  /// Its events and decisions are those of this stage alone.
  Snapshot after;
  /// WarmStart, SingleIterationPGS and Unmerge, when something was swept: ascending bodies.
  std::vector<OwnVelocity> own;
};

/// One time step from the inside.
struct StepRecord {
  std::int64_t step = 0;  ///< k: from the state after step k − 1 to that after step k
  Snapshot before;        ///< the state after step k − 1
  Snapshot after;         ///< the state after step k, with all its events and decisions
  Notes notes;
  std::array<StageRecord, kStages> stages;

  const StageRecord& operator[](Stage stage) const {
    return stages[static_cast<std::size_t>(stage)];
  }
  /// The state right before a stage.
  const Snapshot& before_stage(Stage stage) const {
    const auto i = static_cast<std::size_t>(stage);
    return i == 0 ? before : stages[i - 1].after;
  }
};

/// A world that can be asked to look inside its steps. Steps that nobody looks into cost what they
/// cost without a recorder.
class Recorder {
 public:
  explicit Recorder(const Scene& scene, Mode mode = Mode::MergeSleep);

  World& world() { return world_; }
  const World& world() const { return world_; }

  /// Takes a step without looking into it. Throws SimulationError.
  void skip();
  /// Takes steps until `step` steps are done.
  void skipTo(std::int64_t step);
  /// Takes a step and records it. Throws SimulationError.
  StepRecord record();

 private:
  World world_;
};

}  // namespace merge2d
