#include "src2d/world.h"

#include <chrono>
#include <utility>

#include "src2d/begin_step.h"
#include "src2d/contact/detection.h"
#include "src2d/dynamics/finite.h"
#include "src2d/dynamics/integrate.h"
#include "src2d/dynamics/setup.h"
#include "src2d/dynamics/solver.h"
#include "src2d/merging/collection.h"
#include "src2d/merging/disturbance.h"
#include "src2d/merging/merge.h"
#include "src2d/merging/sleep.h"
#include "src2d/merging/sweep.h"
#include "src2d/merging/unmerge.h"
#include "src2d/merging/warm_start.h"
#include "src2d/state_file.h"
#include "src2d/trace/capture.h"

namespace merge2d {

struct World::Impl {
  using Clock = std::chrono::steady_clock;

  Impl(std::shared_ptr<const Scene> of, const WorldOptions& with)
      : scene(std::move(of)), options(with) {
    setUp(*scene, options.mode, setup);
    countBodies(setup.state, scratch);
  }

  std::shared_ptr<const Scene> scene;
  WorldOptions options;
  Setup setup;
  Scratch scratch;
  Observer* observer = nullptr;
  Notes notes;
  std::vector<BodyInfo> bodies;  ///< described when somebody asks
  Clock::time_point lap_began;

  void step();

  const std::vector<BodyInfo>& describedBodies() {
    if (bodies.empty()) bodies = describeBodies(*scene, setup.state);
    return bodies;
  }

  /// The one place for timings, the observer and checks: nothing of these stands between the lines
  /// of the algorithm.
  template <class Work>
  void run(Stage stage, Work&& work) {
    work();
    checkFinite(setup.state, scratch, stage,
                [this](BodyId b) { return describedBodies()[index(b)].name; });
    if (options.timings) {
      scratch.stats.seconds[static_cast<std::size_t>(stage)] = lap();
    }
    if (!observer) return;
    layOutCollections(setup.state);  // which would be done later
    observer->afterStage(stage, setup.state, scratch);
    if (options.timings) lap();
  }

  /// The time since the last call [s]: a look at the clock takes as long as a short stage.
  double lap() {
    const Clock::time_point begin = std::exchange(lap_began, Clock::now());
    return std::chrono::duration<double>(lap_began - begin).count();
  }
};

/// Algorithm 1.
void World::Impl::step() {
  State& state = setup.state;
  Scratch& s = scratch;
  notes.clear();
  s.notes = options.decisions ? &notes : nullptr;
  if (options.timings) lap();
  beginStep(state, setup.actions, s);

  run(Stage::ContactDetection, [&] { detectContacts(state, s); });
  run(Stage::ContactOrdering, [&] { orderContacts(state, s); });
  run(Stage::SleepAndWake, [&] { sleepAndWake(state, s); });
  run(Stage::WarmStart, [&] { warmStartSweep(state, s); });
  run(Stage::SingleIterationPGS, [&] { sweepCollections(state, s); });
  run(Stage::Unmerge, [&] { unmerge(state, s); });
  run(Stage::SolveLCP, [&] { solveContacts(state, s); });
  run(Stage::AdvanceVelocities, [&] { advanceVelocities(state, s); });
  run(Stage::AccumulateRelativeMotion, [&] { accumulateRelativeMotion(state, s); });
  run(Stage::AdvancePositions, [&] { advancePositions(state, s); });
  run(Stage::Merge, [&] { merge(state, s); });

  state.step += 1;
  state.time = static_cast<double>(state.step) * state.h;
  countBodies(state, s);
}

World::World(const Scene& scene, const WorldOptions& options)
    : World(std::make_shared<const Scene>(scene), options) {}
World::World(std::shared_ptr<const Scene> scene, const WorldOptions& options)
    : impl_(std::make_unique<Impl>(std::move(scene), options)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::step() { impl_->step(); }
std::int64_t World::steps() const { return impl_->setup.state.step; }
double World::time() const { return impl_->setup.state.time; }
const Scene& World::scene() const { return *impl_->scene; }
Mode World::mode() const { return impl_->options.mode; }
const std::vector<BodyInfo>& World::bodies() const { return impl_->describedBodies(); }
const Stats& World::stats() const { return impl_->scratch.stats; }
const std::vector<Event>& World::events() const { return impl_->scratch.events; }
void World::takeNotes(bool on) { impl_->options.decisions = on; }
const Notes& World::notes() const { return impl_->notes; }
void World::observe(Observer* observer) { impl_->observer = observer; }

std::string World::save() const { return saveState(*impl_->scene, impl_->setup); }

void World::restore(std::string_view bytes, const std::string& source) {
  restoreState(bytes, source, *impl_->scene, impl_->setup);
  impl_->scratch.events.clear();
  countBodies(impl_->setup.state, impl_->scratch);
}

std::size_t World::memoryBytes() const {
  return merge2d::memoryBytes(impl_->setup.state, impl_->scratch);
}

void World::capture(Snapshot& out) const {
  captureState(impl_->setup.state, impl_->setup.actions, impl_->scratch, out);
  out.decisions = impl_->notes.decisions;
  out.groups = impl_->notes.groups;
}

Snapshot World::capture() const {
  Snapshot snapshot;
  capture(snapshot);
  return snapshot;
}

void World::applyImpulse(BodyId body, const Vec2& at, const Vec2& impulse) {
  impl_->setup.actions.user_kicks.push_back({body, placedOnGrid(at), impulse});
}

}  // namespace merge2d
