#include "src2d/recorder.h"

#include "src2d/dynamics/state.h"
#include "src2d/trace/capture.h"

namespace merge2d {
namespace {

/// Events and decisions from `first` on are what a stage added.
template <class T>
void copyNew(const std::vector<T>& all, std::size_t first, std::vector<T>& out) {
  out.assign(all.begin() + static_cast<std::ptrdiff_t>(std::min(first, all.size())), all.end());
}

/// Inside the sweep contacts outside collections have impulses of their own, which are in the
/// contact table only later.
void showSweptImpulses(const State& state, const Scratch& scratch, Snapshot& out) {
  for (const SweepContact& outer : scratch.sweep_contacts) {
    const Contact& contact = state.contacts.slots[outer.slot];
    for (int i = 0; i < outer.block.count; ++i) {
      const ContactPoint& p = contact.points[static_cast<std::size_t>(i)];
      for (ContactView& seen : out.contacts) {
        if (seen.a != contact.key.a || seen.b != contact.key.b || seen.feature != p.feature) {
          continue;
        }
        seen.lambda_n = outer.block.lambda_n(i);
        seen.lambda_t = outer.block.lambda_t(i);
      }
    }
  }
}

bool inSweep(Stage stage) {
  return stage == Stage::WarmStart || stage == Stage::SingleIterationPGS || stage == Stage::Unmerge;
}

/// Takes down the state after each stage.
class StageWatcher : public Observer {
 public:
  StageWatcher(const World& world, StepRecord& record) : world_(world), record_(record) {}

  void afterStage(Stage stage, const State& state, const Scratch& scratch) override {
    StageRecord& seen = record_.stages[static_cast<std::size_t>(stage)];
    world_.capture(seen.after);
    if (stage == Stage::SingleIterationPGS) showSweptImpulses(state, scratch, seen.after);
    copyNew(scratch.events, events_, seen.after.events);
    copyNew(scratch.notes->decisions, decisions_, seen.after.decisions);
    events_ = scratch.events.size();
    decisions_ = scratch.notes->decisions.size();
    if (inSweep(stage) && scratch.last_sweep == state.step) takeOwnVelocities(state, scratch, seen);
  }

 private:
  static void takeOwnVelocities(const State& state, const Scratch& scratch, StageRecord& out) {
    for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
      const SolverVelocity& u = scratch.sweep_u[i];
      if (!state[BodyId{i}].alive || u.inv_mass == 0.0) continue;
      out.own.push_back({BodyId{i}, {u.vx, u.vy}, u.omega});
    }
  }

  const World& world_;
  StepRecord& record_;
  std::size_t events_ = 0, decisions_ = 0;  ///< seen so far
};

}  // namespace

Recorder::Recorder(const Scene& scene, Mode mode)
    : world_(scene, {.mode = mode, .timings = false, .decisions = false}) {}

void Recorder::skip() {
  world_.takeNotes(false);
  world_.step();
}

void Recorder::skipTo(std::int64_t step) {
  while (world_.steps() < step) skip();
}

StepRecord Recorder::record() {
  StepRecord out;
  out.step = world_.steps() + 1;
  world_.capture(out.before);
  StageWatcher watcher(world_, out);
  world_.takeNotes(true);
  world_.observe(&watcher);
  try {
    world_.step();
  } catch (...) {
    world_.observe(nullptr);
    throw;
  }
  world_.observe(nullptr);
  world_.capture(out.after);
  out.notes = world_.notes();
  return out;
}

}  // namespace merge2d
