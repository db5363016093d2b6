#include "app/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "app/statistics.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

constexpr std::int64_t kTurn = 50;      // steps
constexpr std::int64_t kSamples = 500;  // of the distance, about
constexpr double kTipped = std::numbers::pi / 4.0;

/// Where the bodies are at one time.
struct Sample {
  double time = 0.0;
  std::vector<BodyState> bodies;  ///< ascending ids
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

Distance between(const Sample& reference, const Sample& other,
                 const std::vector<BodyInfo>& bodies) {
  Distance distance{.time = reference.time};
  int dynamic = 0;
  auto there = other.bodies.begin();
  for (const BodyState& body : reference.bodies) {
    while (there != other.bodies.end() && there->id < body.id) ++there;
    if (there == other.bodies.end()) break;
    if (there->id != body.id || bodies[index(body.id)].motion != Motion::Dynamic) continue;
    const double d = (there->x - body.x).norm();
    distance.mean += d;
    distance.largest = std::max(distance.largest, d);
    ++dynamic;
  }
  if (dynamic > 0) distance.mean /= dynamic;
  return distance;
}

}  // namespace

double meanMs(std::span<const StepRow> steps) {
  double sum = 0.0;
  for (const StepRow& row : steps) sum += row.ms;
  return steps.empty() ? 0.0 : sum / static_cast<double>(steps.size());
}

double medianMs(std::span<const StepRow> steps) {
  std::vector<double> all;
  for (const StepRow& row : steps) all.push_back(row.ms);
  return median(std::move(all));
}

double mean(std::span<const StepRow> steps, int StepRow::*number) {
  double sum = 0.0;
  for (const StepRow& row : steps) sum += row.*number;
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

int ModeRun::merges() const {
  int sum = 0;
  for (const StepRow& row : steps) sum += row.merges;
  return sum;
}

int ModeRun::unmerges() const {
  int sum = 0;
  for (const StepRow& row : steps) sum += row.unmerges;
  return sum;
}

int ModeRun::lateEvents() const {
  int sum = 0;
  for (std::size_t i = steps.size() - steps.size() / 4; i < steps.size(); ++i) {
    sum += steps[i].merges + steps[i].unmerges;
  }
  return sum;
}

/// One mode: its world, and what is noted of it.
class Comparison::Lane {
 public:
  Lane(const std::shared_ptr<const Scene>& scene, Mode mode, bool timings, ModeRun& run)
      : simulation_(scene, {.mode = mode, .timings = timings}), run_(run) {
    run_.mode = mode;
    simulation_.world().capture(now_);
    for (const BodyState& body : now_.bodies) first_angles_.emplace(body.id, body.angle);
  }

  const World& world() const { return simulation_.world(); }
  bool done() const { return simulation_.done(); }
  /// Of the turn that just ended.
  const std::vector<Sample>& samples() const { return samples_; }

  void takeTurn(std::int64_t stride, bool timings) {
    samples_.clear();
    for (std::int64_t i = 0; i < kTurn && !done(); ++i) {
      simulation_.step();
      note(timings);
      if (world().steps() % stride == 0 || done()) takeSample();
    }
    run_.last = world().stats();
  }

 private:
  void note(bool timings) {
    const Stats& stats = world().stats();
    const std::vector<Event>& events = world().events();
    StepRow row{.ms = timings ? simulation_.milliseconds().back() : 0.0,
                .active_bodies = stats.active_bodies,
                .contacts = stats.contacts,
                .internal_contacts = stats.internal_contacts,
                .merges = count(events, EventType::Merge),
                .unmerges = count(events, EventType::Unmerge)};
    for (std::size_t s = 0; s < kStages; ++s) {
      row.stage_ms[s] = timings ? static_cast<float>(1e3 * stats.seconds[s]) : 0.0F;
    }
    run_.steps.push_back(row);
    if (row.merges + row.unmerges == 0) return;
    world().capture(now_);  // welds change in steps with events alone
    run_.flicker += welds_.update(now_);
  }

  void takeSample() {
    world().capture(now_);
    run_.max_penetration = std::max(run_.max_penetration, now_.stats.max_penetration);
    for (const BodyState& body : now_.bodies) {
      if (world().bodies()[index(body.id)].motion != Motion::Dynamic) continue;
      const double first = first_angles_.try_emplace(body.id, body.angle).first->second;
      if (std::abs(body.angle - first) > kTipped && tipped_.insert(body.id).second) {
        run_.tipping_times.push_back(now_.time);
      }
    }
    samples_.push_back({now_.time, now_.bodies});
  }

  Simulation simulation_;
  ModeRun& run_;
  Snapshot now_;
  WeldLog welds_;
  std::map<BodyId, double> first_angles_;  ///< [rad]
  std::set<BodyId> tipped_;
  std::vector<Sample> samples_;
};

Comparison::Comparison(std::shared_ptr<const Scene> scene, bool timings)
    : scene_(std::move(scene)),
      timings_(timings),
      steps_(stepCount(*scene_)),
      stride_(std::max<std::int64_t>(1, steps_ / kSamples)) {
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    lanes_[i] = std::make_unique<Lane>(scene_, kModes[i], timings, runs_[i]);
  }
}

Comparison::~Comparison() = default;

void Comparison::advance() {
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    try {
      lanes_[i]->takeTurn(stride_, timings_);
    } catch (const SimulationError& error) {
      throw SimulationError(fmt::format("in mode {}: {}", name(kModes[i]), error.what()));
    }
  }
  measureDistances();
}

void Comparison::measureDistances() {
  const std::vector<Sample>& reference = lanes_.front()->samples();
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    const std::vector<Sample>& samples = lanes_[i]->samples();
    for (std::size_t k = 0; k < samples.size(); ++k) {
      runs_[i].distances.push_back(between(reference[k], samples[k], lanes_[i]->world().bodies()));
    }
  }
}

bool Comparison::done() const { return lanes_.back()->done(); }

std::int64_t Comparison::stepsDone() const { return lanes_.back()->world().steps(); }

}  // namespace merge2d
