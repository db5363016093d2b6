#include "app/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "app/statistics.h"
#include "app/timed_run.h"
#include "src2d/core/assert.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

constexpr std::int64_t kTurn = 200;  // steps
constexpr double kTippingAngle = std::numbers::pi / 4.0;

/// Where the dynamic bodies are after a step.
struct Sample {
  struct Center {
    BodyId id{};
    Vec2 x = Vec2::Zero();  ///< [m]
  };
  double time = 0.0;
  std::vector<Center> centers;  ///< ascending ids
};

/// When each weld formed; tells how many broke soon after.
class WeldLog {
 public:
  int update(const Snapshot& now) {
    std::map<std::pair<BodyId, BodyId>, std::int64_t> next;
    for (const WeldView& weld : now.welds) {
      const std::pair pair(weld.a, weld.b);
      const auto before = formed_.find(pair);
      next.emplace(pair, before == formed_.end() ? now.step : before->second);
    }
    const auto shortLived = [&](const auto& weld) {
      return !next.contains(weld.first) && now.step - weld.second < kFlickerSteps;
    };
    const auto broken = std::ranges::count_if(formed_, shortLived);
    formed_ = std::move(next);
    return static_cast<int>(broken);
  }

 private:
  std::map<std::pair<BodyId, BodyId>, std::int64_t> formed_;
};

int count(const std::vector<Event>& events, EventType type) {
  return static_cast<int>(std::ranges::count(events, type, &Event::type));
}

int sum(const std::vector<StepRow>& steps, int StepRow::*number) {
  int all = 0;
  for (const StepRow& row : steps) all += row.*number;
  return all;
}

Distance between(const Sample& reference, const Sample& other) {
  Distance distance{.time = reference.time};
  int both = 0;
  auto there = other.centers.begin();
  for (const Sample::Center& here : reference.centers) {
    while (there != other.centers.end() && there->id < here.id) ++there;
    if (there == other.centers.end()) break;
    if (there->id != here.id) continue;
    const double d = (there->x - here.x).norm();
    distance.mean += d;
    distance.largest = std::max(distance.largest, d);
    ++both;
  }
  if (both > 0) distance.mean /= both;
  return distance;
}

/// Notes when bodies have turned from how they began.
class TippingLog {
 public:
  void update(const Snapshot& now, const std::vector<BodyInfo>& bodies,
              std::vector<double>& times) {
    angles_.resize(bodies.size(), kUnseen);
    for (const BodyState& body : now.bodies) {
      double& first = angles_[index(body.id)];
      if (first == kTipped || bodies[index(body.id)].motion != Motion::Dynamic) continue;
      if (first == kUnseen) first = body.angle;
      if (std::abs(body.angle - first) <= kTippingAngle) continue;
      first = kTipped;
      times.push_back(now.time);
    }
  }

 private:
  static constexpr double kUnseen = std::numeric_limits<double>::max();
  static constexpr double kTipped = std::numeric_limits<double>::lowest();

  std::vector<double> angles_;  ///< at first, or one of the two above [rad]
};

}  // namespace

double meanMs(std::span<const StepRow> steps) {
  double sum = 0.0;
  for (const StepRow& row : steps) sum += row.time.ms;
  return steps.empty() ? 0.0 : sum / static_cast<double>(steps.size());
}

double medianMs(std::span<const StepRow> steps) {
  std::vector<double> all;
  for (const StepRow& row : steps) all.push_back(row.time.ms);
  return median(std::move(all));
}

double mean(std::span<const StepRow> steps, int StepRow::*number) {
  double sum = 0.0;
  for (const StepRow& row : steps) sum += row.*number;
  return steps.empty() ? 0.0 : sum / static_cast<double>(steps.size());
}

double meanMs(std::span<const StepRow> steps, Stage stage) {
  double sum = 0.0;
  for (const StepRow& row : steps) sum += row.time.stage_ms[static_cast<std::size_t>(stage)];
  return steps.empty() ? 0.0 : sum / static_cast<double>(steps.size());
}

std::span<const StepRow> ModeRun::within(const Window& window, double h) const {
  const auto step = [&](double time) {
    const auto k = static_cast<std::size_t>(std::llround(time / h));
    return std::min(k, steps.size());
  };
  const std::size_t first = step(window.from);
  return std::span(steps).subspan(first, step(window.to) - first);
}

int ModeRun::merges() const { return sum(steps, &StepRow::merges); }
int ModeRun::unmerges() const { return sum(steps, &StepRow::unmerges); }
int ModeRun::brokenJoints() const { return sum(steps, &StepRow::broken_joints); }

int ModeRun::lateEvents() const {
  int sum = 0;
  for (std::size_t i = steps.size() - steps.size() / 4; i < steps.size(); ++i) {
    sum += steps[i].merges + steps[i].unmerges;
  }
  return sum;
}

double ModeRun::largestDistance() const {
  double largest = 0.0;
  for (const Distance& d : distances) largest = std::max(largest, d.largest);
  return largest;
}

TippingDifference tippingDifference(const ModeRun& reference, const ModeRun& run) {
  const auto &there = reference.tipping_times, &here = run.tipping_times;
  TippingDifference out{.compared = std::min(there.size(), here.size())};
  for (std::size_t k = 0; k < out.compared; ++k) {
    const double difference = std::abs(here[k] - there[k]);
    out.mean += difference / static_cast<double>(out.compared);
    out.largest = std::max(out.largest, difference);
  }
  return out;
}

/// One mode: its world, what is noted of it, and a world that does the same for its time.
class Comparison::Lane {
 public:
  Lane(const std::shared_ptr<const Scene>& scene, Mode mode, bool timings, ModeRun& run)
      : simulation_(scene, {.mode = mode, .timings = false}), run_(run) {
    if (timings) timed_.emplace(scene, mode);
    run_.mode = mode;
    world().capture(now_);
    run_.last = now_.stats;
    tipping_.update(now_, world().bodies(), run_.tipping_times);
  }

  const World& world() const { return simulation_.world(); }
  bool done() const { return simulation_.done(); }
  /// Of the turn that just ended.
  const std::vector<Sample>& samples() const { return samples_; }

  /// Takes the time of the next turn.
  void time() {
    if (timed_) timed_->advance(kTurn);
  }

  void takeTurn() {
    samples_.clear();
    for (std::int64_t i = 0; i < kTurn && !done(); ++i) {
      simulation_.step();
      std::swap(before_, now_);
      world().capture(now_);
      noteCosts();
      noteMotion();
    }
    run_.last = now_.stats;
    if (timed_) noteTimes();
  }

 private:
  void noteTimes() {
    const Stats &timed = timed_->stats(), &seen = now_.stats;
    MERGE2D_ASSERT(timed.active_bodies == seen.active_bodies && timed.contacts == seen.contacts,
                   "the run whose time is taken has {} bodies and {} contacts, not {} and {}",
                   timed.active_bodies, timed.contacts, seen.active_bodies, seen.contacts);
    auto row = run_.steps.end() - std::ssize(timed_->times());
    for (const StepTime& time : timed_->times()) (row++)->time = time;
  }

  void noteCosts() {
    const Stats& stats = now_.stats;
    StepRow row{.time = {},  // see noteTimes()
                .active_bodies = stats.active_bodies,
                .contacts = stats.contacts,
                .internal_contacts = stats.internal_contacts,
                .collections = stats.collections,
                .asleep = stats.asleep,
                .merges = count(now_.events, EventType::Merge),
                .unmerges = count(now_.events, EventType::Unmerge),
                .broken_joints = count(now_.events, EventType::Break),
                .max_penetration = stats.max_penetration};
    run_.steps.push_back(row);
    // Welds change in steps with events alone.
    if (row.merges + row.unmerges > 0) run_.flicker += welds_.update(now_);
  }

  void noteMotion() {
    const std::vector<BodyInfo>& bodies = world().bodies();
    run_.max_penetration = std::max(run_.max_penetration, now_.stats.max_penetration);
    tipping_.update(now_, bodies, run_.tipping_times);
    appendHits(before_, now_, bodies, run_.hits);
    noteCreep();
    Sample& sample = samples_.emplace_back(Sample{now_.time, {}});
    for (const BodyState& body : now_.bodies) {
      if (bodies[index(body.id)].motion != Motion::Dynamic) continue;
      sample.centers.push_back({body.id, body.x});
    }
  }

  void noteCreep() {
    const std::int64_t steps = simulation_.steps(), start = steps - steps / 4;
    if (now_.step == start) creep_.begin(now_, world().bodies());
    if (now_.step > start) creep_.update(now_);
    if (now_.step == steps) run_.creep = creep_.result(now_);
  }

  Simulation simulation_;
  std::optional<TimedRun> timed_;
  ModeRun& run_;
  Snapshot before_, now_;
  WeldLog welds_;
  TippingLog tipping_;
  CreepMeter creep_;
  std::vector<Sample> samples_;
};

Comparison::Comparison(std::shared_ptr<const Scene> scene, bool timings)
    : scene_(std::move(scene)), timings_(timings), steps_(stepCount(*scene_)) {
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    lanes_[i] = std::make_unique<Lane>(scene_, kModes[i], timings, runs_[i]);
  }
}

Comparison::~Comparison() = default;

template <class Do>
void Comparison::inEachMode(Do&& what) {
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    try {
      what(*lanes_[i]);
    } catch (const SimulationError& error) {
      throw SimulationError(fmt::format("in mode {}: {}", name(kModes[i]), error.what()));
    }
  }
}

void Comparison::advance() {
  inEachMode([](Lane& lane) { lane.time(); });
  inEachMode([](Lane& lane) { lane.takeTurn(); });
  measureDistances();
}

void Comparison::measureDistances() {
  const std::vector<Sample>& reference = lanes_.front()->samples();
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    const std::vector<Sample>& samples = lanes_[i]->samples();
    for (std::size_t k = 0; k < samples.size(); ++k) {
      runs_[i].distances.push_back(between(reference[k], samples[k]));
    }
  }
}

bool Comparison::done() const { return lanes_.back()->done(); }

const std::string& Comparison::nameOf(BodyId body) const {
  return lanes_.front()->world().bodies()[index(body)].name;
}

std::int64_t Comparison::stepsDone() const { return lanes_.back()->world().steps(); }

}  // namespace merge2d
