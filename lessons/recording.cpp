#include "lessons/recording.h"

#include <algorithm>

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

void keepOrder(const Notes& notes, Recording& out) {
  if (notes.seeds.empty() || out.orders.size() >= Recording::kMostOrders) return;
  SweepOrder order{.step = out.steps, .visits = {}};
  for (const NotedVisit& visit : notes.order) {
    if (visit.depth > 0 && order.visits.size() < Recording::kMostVisits) {
      order.visits.push_back(visit);
    }
  }
  if (!order.visits.empty()) out.orders.push_back(std::move(order));
}

}  // namespace

Recording record(const Scene& scene, const RecordOptions& options) {
  const bool full = options.detail == Detail::Full;
  World world(scene, {.mode = options.mode, .timings = false, .decisions = full});
  Recording out;
  out.scene = scene;
  out.mode = options.mode;
  out.detail = options.detail;
  out.bodies = world.bodies();
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
    if (full) keepOrder(world.notes(), out);
    if (options.progress) options.progress(out.steps);
  }
  return out;
}

}  // namespace merge2d
