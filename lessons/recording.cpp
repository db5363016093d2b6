#include "lessons/recording.h"

#include <algorithm>

#include "lessons/long_recording.h"
#include "lessons/snapshot_feed.h"
#include "src2d/dynamics/state.h"
#include "src2d/world.h"

namespace merge2d {
namespace {

/// Momentum and energy before and after the stages that join and part bodies.
class Ledger : public Observer {
 public:
  explicit Ledger(std::vector<LedgerEntry>& out) : out_(out) {}

  void afterStage(Stage stage, const State& state, const Scratch& scratch) override {
    if (stage != Stage::Unmerge && stage != Stage::Merge) {
      events_ = scratch.events.size();
      const bool needed = stage == Stage::SingleIterationPGS || stage == Stage::AdvancePositions;
      if (needed) before_ = sums(state);
      return;
    }
    const auto changes = [](const Event& e) {
      return e.type == EventType::Merge || e.type == EventType::Unmerge;
    };
    const auto first = scratch.events.begin() + static_cast<std::ptrdiff_t>(events_);
    if (std::any_of(first, scratch.events.end(), changes)) {
      LedgerEntry entry{
          .step = state.step + 1, .stage = stage, .before = before_, .after = sums(state)};
      for (const Collection& c : state.collections) {
        entry.anchored |= c.id != kNoCollection && !state[c.rigid].floating();
      }
      out_.push_back(entry);
    }
    events_ = scratch.events.size();
  }

 private:
  static LedgerEntry::Sums sums(const State& state) {
    LedgerEntry::Sums s;
    for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
      const BodyId id{i};
      const Body& body = state[id];
      const bool alone = body.rigid == rigidOf(id);
      if (!body.alive || (alone && !state[body.rigid].floating())) continue;
      const Vec2 x = state.pose(id).position, v = state.rigid(id).velocityAt(x);
      const double omega = state.rigid(id).omega;
      s.px += body.mass * v.x();
      s.py += body.mass * v.y();
      s.angular += body.inertia * omega + body.mass * cross(x, v);
      s.kinetic += 0.5 * (body.mass * v.squaredNorm() + body.inertia * omega * omega);
    }
    return s;
  }

  std::vector<LedgerEntry>& out_;
  LedgerEntry::Sums before_;
  std::size_t events_ = 0;
};

/// Runs the world of `out`, and keeps each step in full.
void recordInFull(Recording& out, const RecordOptions& options) {
  const bool full = options.detail == Detail::Full;
  World world(out.scene, {.mode = options.mode, .timings = false, .decisions = full});
  SnapshotFeed feed(out);
  Ledger ledger(out.ledger);
  world.observe(&ledger);
  Snapshot snapshot;
  world.capture(snapshot);
  feed.add(snapshot);
  while (out.steps < options.steps) {
    world.step();
    world.capture(snapshot);
    feed.add(snapshot);
    ++out.steps;
    if (full) keepOrder(world.notes(), out.steps, out);
    if (options.progress) options.progress(out.steps);
  }
}

}  // namespace

void BodyTrack::append(const BodyState& body) {
  x.push_back(body.x.x());
  y.push_back(body.x.y());
  angle.push_back(body.angle);
  vx.push_back(static_cast<float>(body.v.x()));
  vy.push_back(static_cast<float>(body.v.y()));
  omega.push_back(static_cast<float>(body.omega));
  collection.push_back(value(body.collection));
  asleep.push_back(body.asleep ? 1 : 0);
}

void keepOrder(const Notes& notes, std::int64_t step, Recording& out) {
  if (notes.seeds.empty() || out.orders.size() >= Recording::kMostOrders) return;
  SweepOrder order{.step = step, .visits = {}};
  for (const NotedVisit& visit : notes.order) {
    if (visit.depth > 0 && order.visits.size() < Recording::kMostVisits) {
      order.visits.push_back(visit);
    }
  }
  if (!order.visits.empty()) out.orders.push_back(std::move(order));
}

std::optional<std::size_t> Recording::sampleAt(const std::vector<Span>& spans,
                                               std::int64_t step) const {
  const std::int64_t sample = step / every;
  std::int64_t before = 0;
  for (const Span& span : spans) {
    if (sample >= span.first && sample < span.first + span.count) {
      return static_cast<std::size_t>(before + sample - span.first);
    }
    before += span.count;
  }
  return std::nullopt;
}

Recording record(const Scene& scene, const RecordOptions& options) {
  Recording out;
  out.scene = scene;
  out.mode = options.mode;
  out.detail = options.detail;
  out.bodies = World(scene, {.mode = options.mode}).bodies();
  const std::int64_t states = options.steps * static_cast<std::int64_t>(out.bodies.size());
  if (states <= options.most_in_full) {
    recordInFull(out, options);
  } else {
    out.every = std::max<std::int64_t>(2, states / options.most_with_contacts);
    recordInKeyframes(out, options.steps, options.progress);
  }
  return out;
}

}  // namespace merge2d
