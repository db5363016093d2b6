#include "src2d/dynamics/turn_stop.h"

#include <algorithm>
#include <cmath>

#include "src2d/geometry/collide.h"
#include "src2d/geometry/distance.h"

namespace merge2d {
namespace {

constexpr double kFarTurn = 0.1;     ///< a turn beyond which rows may miss something [rad]
constexpr double kLeastTurn = 1e-3;  ///< moves no corner by as much as a shape is thick [rad]
constexpr double kFarWay = 0.5;      ///< of the thinner shape: likewise a way, for one that turns
constexpr double kDeeper = 0.1;      ///< of the thinner shape: an overlap that is let be

/// What a thing does in this step.
struct StepMotion {
  Vec2 way = Vec2::Zero();  ///< of its centre of mass [m]
  double turn = 0.0;        ///< [rad]
};

StepMotion motionOf(const State& state, const Scratch& scratch, RigidId id) {
  const Rigid& r = state[id];
  const auto hit = std::ranges::find(scratch.hit_ways, id, &HitWay::id);
  if (hit != scratch.hit_ways.end()) return {hit->way, hit->turn};
  return {state.h * r.v, state.h * r.omega};
}

/// One body on its way, seen from `origin`.
struct Path {
  Pose start;
  Vec2 center;
  StepMotion motion;
  const Collider& shape;
  double reach = 0.0;

  Path(const State& state, const Scratch& scratch, BodyId body, std::uint32_t of,
       const Vec2& origin)
      : start(state.pose(body)),
        center(state.rigid(body).x - origin),
        motion(motionOf(state, scratch, state[body].rigid)),
        shape(state.collider(of)) {
    reach = reachFrom(shape, start.toLocal(state.rigid(body).x));
    start.position -= origin;
  }
  Pose at(double part) const {
    const Rotation turn = Rotation::of(part * motion.turn);
    return {center + part * motion.way + turn * (start.position - center), turn * start.rotation};
  }
};

/// Two bodies on their ways through the step.
class Passage {
 public:
  Passage(const Path& a, const Path& b, double thin)
      : a_(a), b_(b), thin_(thin), allowed_(depthAt(0.0) + kDeeper * thin) {}

  /// The part of the step after which they overlap by more than at its start, or 1.
  double end() const {
    constexpr int kRounds = 4000;
    constexpr double kFine = 0.25;  // of the thinner shape, in one go
    const double most = (b_.motion.way - a_.motion.way).norm() + turningOf(a_) + turningOf(b_);
    double good = 0.0;
    for (int round = 0; round < kRounds && good < 1.0; ++round) {
      const double distance = nearest(a_.shape, b_.shape, relativeAt(good)).distance;
      const double next = std::min(1.0, good + std::max(distance, kFine * thin_) / most);
      if (depthAt(next) > allowed_) return good;
      good = next;
    }
    return good;
  }

 private:
  Pose relativeAt(double part) const { return a_.at(part).toLocal(b_.at(part)); }

  double turningOf(const Path& p) const { return std::abs(p.motion.turn) * p.reach; }

  double depthAt(double part) const {
    const Manifold found = collide(a_.shape, b_.shape, relativeAt(part), 0.0);
    double depth = 0.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(found.count); ++k) {
      depth = std::max(depth, -found.points[k].gap);
    }
    return depth;
  }

  const Path &a_, &b_;
  double thin_, allowed_;
};

bool goesFar(const State& state, RigidId id) {
  const Rigid& r = state[id];
  const double turn = std::abs(state.h * r.omega);
  if (turn < kLeastTurn || !r.floating() || r.asleep || state.isCollection(id)) return false;
  if (turn > kFarTurn) return true;
  const double thin = state.extent(r).bounds.extent().minCoeff();
  return state.h * r.v.norm() > 0.5 * kFarWay * thin;
}

bool isJoined(const State& state, RigidId id) {
  return std::ranges::any_of(state.joints, [&](const Joint& joint) {
    return state[joint.a].rigid == id || (!joint.to_world && state[joint.b].rigid == id);
  });
}

double thicknessOf(const State& state, const ContactKey& key) {
  return std::min(state.bounds(key.shape_a).extent().minCoeff(),
                  state.bounds(key.shape_b).extent().minCoeff());
}

/// True when corners may end elsewhere than along straight ways from where they were seen.
bool bendsFar(const Path& p, double thin) {
  const double turn = std::abs(p.motion.turn);
  if (p.shape.isCircle() || turn * p.reach <= kDeeper * thin) return false;
  return 0.5 * turn * turn * p.reach > kDeeper * thin || p.motion.way.norm() > kFarWay * thin;
}

void stop(RigidId id, double part, std::vector<StoppedTurn>& stopped) {
  const auto known = std::ranges::find(stopped, id, &StoppedTurn::id);
  if (known == stopped.end()) {
    stopped.push_back({id, part});
  } else {
    known->part = std::min(known->part, part);
  }
}

}  // namespace

void findStoppedTurns(const State& state, const Scratch& scratch,
                      std::vector<StoppedTurn>& stopped) {
  stopped.clear();
  const auto& present = state.present.ids();
  if (std::ranges::none_of(present, [&](RigidId id) { return goesFar(state, id); })) return;
  for (const ContactTable::Slot slot : state.contacts.order) {
    const ContactKey& key = state.contacts[slot].key;
    const RigidId rigid_a = state[key.a].rigid, rigid_b = state[key.b].rigid;
    const bool far_a = goesFar(state, rigid_a), far_b = goesFar(state, rigid_b);
    if (!far_a && !far_b) continue;
    const Vec2 origin = state.pose(key.a).position;
    const Path a(state, scratch, key.a, key.shape_a, origin);
    const Path b(state, scratch, key.b, key.shape_b, origin);
    const double thin = thicknessOf(state, key);
    const bool stops_a = far_a && bendsFar(a, thin) && !isJoined(state, rigid_a);
    const bool stops_b = far_b && bendsFar(b, thin) && !isJoined(state, rigid_b);
    if (!stops_a && !stops_b) continue;
    const double part = Passage(a, b, thin).end();
    if (part >= 1.0) continue;
    if (stops_a) stop(rigid_a, part, stopped);
    if (stops_b) stop(rigid_b, part, stopped);
  }
}

}  // namespace merge2d
