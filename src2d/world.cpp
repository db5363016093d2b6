#include "src2d/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <utility>

#include "src2d/begin_step.h"
#include "src2d/body_arrays.h"
#include "src2d/collections/collection.h"
#include "src2d/contact/detection.h"
#include "src2d/contact/parking.h"
#include "src2d/core/error.h"
#include "src2d/dynamics/finite.h"
#include "src2d/dynamics/integrate.h"
#include "src2d/dynamics/solver.h"
#include "src2d/dynamics/task_pool.h"
#include "src2d/edit.h"
#include "src2d/merging/disturbance.h"
#include "src2d/merging/merge.h"
#include "src2d/merging/relative_motion.h"
#include "src2d/merging/sleep_stage.h"
#include "src2d/merging/sweep.h"
#include "src2d/merging/unmerge.h"
#include "src2d/merging/warm_start.h"
#include "src2d/rest.h"
#include "src2d/scene/check.h"
#include "src2d/setup.h"
#include "src2d/state_file.h"
#include "src2d/time_step.h"
#include "src2d/trace/capture.h"

namespace merge2d {

struct World::Impl {
  using Clock = std::chrono::steady_clock;

  Impl(std::shared_ptr<const Scene> of, const WorldOptions& with)
      : scene(std::move(of)), options(with) {
    checkSimulated(*scene);
    setUp(*scene, options.mode, setup);
    if (options.threads > 1) tasks = std::make_unique<TaskPool>(options.threads);
    countBodies(setup.state, scratch);
  }

  std::shared_ptr<const Scene> scene;
  WorldOptions options;
  Setup setup;
  Scratch scratch;
  std::unique_ptr<TaskPool> tasks;
  Observer* observer = nullptr;
  Notes notes;
  std::vector<BodyInfo> bodies;  ///< described when somebody asks
  /// Names the bodies in errors. Kept, as each stage of a step passes it on.
  const std::function<std::string(BodyId)> naming = [this](BodyId b) { return nameOf(b); };
  Clock::time_point lap_began;
  Rest rest;

  void step();
  void runStages();

  /// For changes from outside.
  Setup& changing() {
    wholeState();
    rest.forget();
    return setup;
  }
  /// The same for those that concern a body and the ones that touch it.
  Setup& waking(BodyId body) {
    bringBackAround(setup.state, scratch, {body});
    rest.forget();
    return setup;
  }
  /// Lists everything again that is parked, for whoever looks at it.
  State& wholeState() {
    bringAllBack(setup.state, scratch);
    return setup.state;
  }

  const std::vector<BodyInfo>& describedBodies() {
    if (bodies.size() != setup.state.bodies.size()) bodies = describeBodies(*scene, setup);
    return bodies;
  }

  bool isThere(BodyId body) const {
    return index(body) < setup.state.bodies.size() && setup.state[body].alive;
  }
  const std::string& nameOf(BodyId body) { return describedBodies()[index(body)].name; }

  /// A body that the user may change; throws InputError for one that is not there.
  BodyId checked(BodyId body) {
    const std::size_t count = setup.state.bodies.size();
    if (index(body) >= count) {
      throw InputError(fmt::format("there is no body {}: the world has {}", index(body), count));
    }
    if (!setup.state[body].alive) {
      const std::string& name = nameOf(body);
      throw InputError(fmt::format("body {}{} is not in the world now", index(body),
                                   name.empty() ? name : " ('" + name + "')"));
    }
    return body;
  }
  BodyId checked(BodyIndex body) { return checked(BodyId{static_cast<std::uint32_t>(body)}); }
  /// The same for one whose motion no script determines.
  BodyId unscripted(BodyId body) {
    if (setup.state[checked(body)].motion != Motion::Scripted) return body;
    throw InputError(fmt::format("body '{}' moves by its script", nameOf(body)));
  }
  Vec2 centerOf(BodyId body) {
    return areaProperties(descriptionOf(*scene, setup, body).shapes).centroid;
  }

  /// The one place for timings, the observer and checks: nothing of these stands between the lines
  /// of the algorithm.
  template <class Work>
  void run(Stage stage, Work&& work) {
    work();
    checkFinite(setup.state, scratch, stage, naming);
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

void World::Impl::step() {
  State& state = setup.state;
  notes.clear();
  scratch.notes = options.decisions ? &notes : nullptr;
  scratch.tasks = tasks.get();
  scratch.sweep_path = options.sweep_path;
  if (options.timings) lap();
  const bool watched = observer || options.decisions;
  if (watched) wholeState();
  beginStep(state, setup.actions, scratch);
  const bool rests = !watched && rest.holdsFor(setup, scratch);
  if (rests) {
    scratch.stats.seconds = {};  // the first stage is given the time of the look at what acts
    if (options.timings) scratch.stats.seconds.front() = lap();
  } else {
    runStages();
  }
  state.step += 1;
  state.time = timeOf(state);
  if (rests) return;
  countBodies(state, scratch);
  if (watched) return;
  rest.lookAt(setup, scratch);
  parkSleepers(state, scratch);
}

/// Algorithm 1.
void World::Impl::runStages() {
  State& state = setup.state;
  Scratch& s = scratch;
  run(Stage::ContactDetection, [&] { detectContacts(state, s); });
  run(Stage::ContactOrdering, [&] { orderContacts(state, s); });
  run(Stage::SleepAndWake, [&] { sleepAndWake(state, s); });
  run(Stage::WarmStart, [&] { warmStart(state, s); });
  run(Stage::SingleIterationPGS, [&] { sweepCollections(state, s); });
  run(Stage::Unmerge, [&] { unmerge(state, s); });
  run(Stage::SolveLCP, [&] { solveContacts(state, s); });
  run(Stage::AdvanceVelocities, [&] { advanceVelocities(state, s); });
  run(Stage::AccumulateRelativeMotion, [&] { accumulateRelativeMotion(state, s); });
  run(Stage::AdvancePositions, [&] { advancePositions(state, s); });
  run(Stage::Merge, [&] { merge(state, s); });
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
Mode World::mode() const { return impl_->setup.state.mode; }
const std::vector<BodyInfo>& World::bodies() const { return impl_->describedBodies(); }
const Stats& World::stats() const { return impl_->scratch.stats; }
const std::vector<Event>& World::events() const { return impl_->scratch.events; }
double World::deepestOverlap() const {
  return merge2d::deepestOverlap(impl_->setup.state, impl_->scratch.events);
}
void World::takeNotes(bool on) { impl_->options.decisions = on; }
const Notes& World::notes() const { return impl_->notes; }
void World::observe(Observer* observer) { impl_->observer = observer; }

std::string World::save() const {
  settleContacts(impl_->wholeState(), impl_->scratch);
  return saveState(*impl_->scene, impl_->setup);
}

void World::restore(std::string_view bytes, const std::string& source, SavedUnder under) {
  Setup& setup = impl_->changing();
  const Mode mode = setup.state.mode;
  const double h = setup.state.h;
  setup.state.mode = restoreState(bytes, source, *impl_->scene, setup, under);
  impl_->scratch = {};
  impl_->bodies.clear();
  merge2d::setMode(setup, impl_->scratch, mode);
  merge2d::setTimeStep(setup, h);
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

void World::captureMotion(Snapshot& out) const {
  merge2d::captureMotion(impl_->setup.state, impl_->setup.actions, impl_->scratch, out);
  out.decisions.clear();
  out.groups.clear();
}

Snapshot World::capture() const {
  Snapshot snapshot;
  capture(snapshot);
  return snapshot;
}

// Changes between two steps

namespace {

/// Throws InputError unless all numbers are finite.
void checkNumbers(const char* what, std::initializer_list<double> numbers) {
  for (const double number : numbers) {
    if (!std::isfinite(number)) throw InputError(fmt::format("{} must be finite", what));
  }
}

}  // namespace

void World::applyImpulse(BodyId body, const Vec2& at, const Vec2& impulse) {
  checkNumbers("an impulse and its place", {at.x(), at.y(), impulse.x(), impulse.y()});
  impl_->setup.actions.user_kicks.push_back({impl_->checked(body), placedOnGrid(at), impulse});
}

void World::applyForce(BodyId body, const Vec2& at, const Vec2& force) {
  checkNumbers("a force and its place", {at.x(), at.y(), force.x(), force.y()});
  const Vec2 arm = at - impl_->setup.state.pose(impl_->checked(body)).position;
  impl_->setup.actions.user_loads.push_back({body, force, cross(arm, force)});
}

void World::setPose(BodyId body, const Vec2& x, double angle) {
  checkNumbers("a pose", {x.x(), x.y(), angle});
  merge2d::setPose(impl_->waking(impl_->unscripted(body)), impl_->scratch, body, x, angle);
}

void World::setVelocity(BodyId body, const Vec2& v, double omega) {
  checkNumbers("a velocity", {v.x(), v.y(), omega});
  if (!impl_->setup.state.responds(impl_->unscripted(body))) {
    throw InputError(fmt::format("body '{}' is pinned: it has no velocity", impl_->nameOf(body)));
  }
  merge2d::setVelocity(impl_->waking(body), impl_->scratch, body, v, omega);
}

void World::pin(BodyId body) {
  merge2d::pin(impl_->waking(impl_->unscripted(body)), impl_->scratch, body);
}
void World::unpin(BodyId body) {
  merge2d::unpin(impl_->waking(impl_->unscripted(body)), impl_->scratch, body);
}
void World::release(BodyId body) {
  merge2d::release(impl_->waking(impl_->checked(body)), impl_->scratch, body);
}
void World::setFriction(BodyId body, double friction) {
  checkNumbers("friction", {friction});
  if (friction < 0.0) throw InputError("friction must be 0 or more");
  merge2d::setFriction(impl_->waking(impl_->checked(body)), body, friction);
}
void World::wake(BodyId body) { merge2d::wake(impl_->waking(impl_->checked(body)), body); }

BodyId World::addBody(const BodyDesc& desc) {
  checkBody(desc);
  const BodyId body = merge2d::addBody(impl_->changing(), desc);
  // Events and notes of the last step are numbered as the bodies were.
  std::vector<Event> events = std::move(impl_->scratch.events);
  impl_->scratch = {};
  impl_->scratch.events = std::move(events);
  countBodies(impl_->setup.state, impl_->scratch);
  return body;
}

void World::removeBody(BodyId body) {
  merge2d::removeBody(impl_->waking(impl_->checked(body)), impl_->scratch, body);
  countBodies(impl_->setup.state, impl_->scratch);
}

std::uint32_t World::addSpring(const SpringDesc& desc) {
  const Vec2 center = impl_->centerOf(impl_->checked(desc.body));
  const Vec2 other = desc.to_body ? impl_->centerOf(impl_->checked(*desc.to_body)) : Vec2::Zero();
  merge2d::checkSpring(desc);
  return merge2d::addSpring(impl_->changing(), desc, center, other);
}

void World::moveSpring(std::uint32_t spring, const Vec2& to) {
  checkNumbers("a place", {to.x(), to.y()});
  checkSpring(spring);
  if (impl_->setup.actions.springs[spring].to_body >= 0) {
    throw InputError(fmt::format("spring {} holds to a body: its end cannot be moved", spring));
  }
  const BodyId body{static_cast<std::uint32_t>(impl_->setup.actions.springs[spring].body)};
  merge2d::moveSpring(impl_->waking(body), spring, to);
}

void World::removeSpring(std::uint32_t spring) {
  checkSpring(spring);
  merge2d::removeSpring(impl_->changing(), spring);
}

void World::checkSpring(std::uint32_t spring) const {
  const auto& springs = impl_->setup.actions.springs;
  if (spring < springs.size() && !springs[spring].removed) return;
  throw InputError(fmt::format("there is no spring {}", spring));
}

std::uint32_t World::addJoint(const JointDesc& desc) {
  impl_->checked(desc.a);
  if (desc.b) impl_->checked(*desc.b);
  checkJoint(desc);
  return merge2d::addJoint(impl_->changing(), impl_->scratch, desc);
}

void World::removeJoint(std::uint32_t joint) {
  if (joint >= impl_->setup.state.joints.size()) {
    throw InputError(fmt::format("there is no joint {}", joint));
  }
  merge2d::removeJoint(impl_->changing(), impl_->scratch, joint);
}

const Settings& World::settings() const { return impl_->setup.state.settings; }
void World::setSettings(const Settings& settings) {
  checkSettings(settings);
  merge2d::setSettings(impl_->changing().state, settings);
}
Vec2 World::gravity() const { return impl_->setup.state.gravity; }

void World::setGravity(const Vec2& gravity) {
  checkNumbers("gravity", {gravity.x(), gravity.y()});
  if (gravity == impl_->setup.state.gravity) return;
  impl_->changing().state.gravity = gravity;
  wakeAll(impl_->setup);
}

double World::timeStep() const { return impl_->setup.state.h; }
void World::setTimeStep(double h) {
  checkTimeStep(h);
  merge2d::setTimeStep(impl_->changing(), h);
}

void World::setMode(Mode mode) { merge2d::setMode(impl_->changing(), impl_->scratch, mode); }

Vec2 World::toBodyFrame(BodyId body, const Vec2& at) const {
  const Pose pose = impl_->setup.state.pose(impl_->checked(body));
  return pose.toLocal(at) + impl_->centerOf(body);
}

// Arrays

void World::poses(std::span<double> out) const { writePoses(impl_->setup.state, out); }

void World::velocities(std::span<double> out) const { writeVelocities(impl_->setup.state, out); }

void World::collections(std::span<std::int32_t> out) const {
  writeCollections(impl_->setup.state, out);
}

}  // namespace merge2d
