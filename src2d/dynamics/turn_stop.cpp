#include "src2d/dynamics/turn_stop.h"

#include <algorithm>
#include <cmath>

#include "src2d/dynamics/hits.h"
#include "src2d/geometry/collide.h"
#include "src2d/geometry/distance.h"

namespace merge2d {
namespace {

constexpr double kFarTurn = 0.1;     ///< a turn beyond which rows may miss something [rad]
constexpr double kLeastTurn = 1e-3;  ///< moves no corner by as much as a shape is thick [rad]
constexpr double kFarWay = 0.5;      ///< of the thinner shape: likewise a way, for one that turns
constexpr double kDeeper = 0.1;      ///< of the thinner shape: an overlap that is let be

/// The motion of a thing in this step.
struct StepMotion {
  Vec2 way = Vec2::Zero();  ///< of its centre of mass [m]
  double turn = 0.0;        ///< [rad]
};

/// The step as it is known so far.
struct Step {
  const State& state;
  const Scratch& scratch;
  std::vector<StoppedTurn>& stopped;

  StepMotion motionOf(RigidId id) const {
    const HitWay whole = wayInStep(state, scratch, id);
    const StoppedTurn stop = stopOf(id);
    return {stop.part * whole.way + stop.along, stop.part * whole.turn};
  }
  StoppedTurn stopOf(RigidId id) const {
    const auto known = std::ranges::find(stopped, id, &StoppedTurn::id);
    return known == stopped.end() ? StoppedTurn{id} : *known;
  }
  /// After a part of the way that it would have gone; then it goes along with the other one, if
  /// nothing holds that up.
  void stop(RigidId id, double part, RigidId other) const {
    StoppedTurn now = stopOf(id);
    now.part *= part;
    now.along *= part;
    if (!state[other].floating()) {
      const StepMotion motion = motionOf(other);
      now.along += (1.0 - part) * (motion.way + cross(motion.turn, state[id].x - state[other].x));
    }
    const auto known = std::ranges::find(stopped, id, &StoppedTurn::id);
    if (known == stopped.end()) {
      stopped.push_back(now);
    } else {
      *known = now;
    }
  }
};

/// One body on its way, seen from `origin`.
struct Path {
  Pose start;
  Vec2 center;
  StepMotion motion;
  const Collider& shape;
  double reach = 0.0;

  Path(const Step& step, BodyId body, std::uint32_t of, const Vec2& origin)
      : start(step.state.pose(body)),
        center(step.state.rigid(body).x - origin),
        motion(step.motionOf(step.state[body].rigid)),
        shape(step.state.collider(of)) {
    reach = reachFrom(shape, start.toLocal(step.state.rigid(body).x));
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

/// A body on its own, and awake.
bool isFree(const State& state, RigidId id) {
  const Rigid& r = state[id];
  return r.floating() && !r.asleep && !state.isCollection(id);
}

bool goesFar(const State& state, RigidId id) {
  const Rigid& r = state[id];
  const double turn = std::abs(state.h * r.omega);
  if (turn < kLeastTurn || !isFree(state, id)) return false;
  if (turn > kFarTurn) return true;
  const double thin = state.extent(r).bounds.extent().minCoeff();
  return state.h * r.v.norm() > 0.5 * kFarWay * thin;
}

/// Something holds a free body.
bool isJoined(const State& state, RigidId id) {
  bool any = false;
  state.joint_lists.of_body.forEach(BodyId{static_cast<std::uint32_t>(id)},
                                    [&](std::uint32_t i) { any |= !state.joints[i].broken; });
  return any;
}

/// True when corners may end elsewhere than along straight ways from where they were seen.
bool bendsFar(const Path& p, double thin) {
  const double turn = std::abs(p.motion.turn);
  if (p.shape.isCircle() || turn * p.reach <= kDeeper * thin) return false;
  return 0.5 * turn * turn * p.reach > kDeeper * thin || p.motion.way.norm() > kFarWay * thin;
}

/// A blow gave it a way in this step that could lead through something: nobody has looked there for
/// contacts.
bool isLaunched(const State& state, const Scratch& scratch, RigidId id) {
  if (!isFree(state, id)) return false;
  const Rigid& r = state[id];
  const auto& gained = scratch.u[index(id)].gained;
  const Vec2 more = state.h * Vec2(gained[0], gained[1]);
  const double most = kFarWay * state.extent(r).bounds.extent().minCoeff();
  return more.squaredNorm() > most * most;
}

/// Calls `visit(body, shape)` for the shapes of a rigid thing.
template <class Visit>
void forEachShape(const State& state, RigidId id, Visit&& visit) {
  const auto ofBody = [&](BodyId b) {
    for (std::uint32_t s = 0; s < state[b].shape_count; ++s) visit(b, state[b].first_shape + s);
  };
  if (!state.isCollection(id)) return ofBody(BodyId{static_cast<std::uint32_t>(id)});
  for (const BodyId b : state.collection(id).members) ofBody(b);
}

/// The part of the step after which the first overlaps with the second.
double partUntil(const Step& step, RigidId id, RigidId other) {
  const State& state = step.state;
  double part = 1.0;
  const Vec2 origin = state[id].x;
  forEachShape(state, id, [&](BodyId a, std::uint32_t shape_a) {
    forEachShape(state, other, [&](BodyId b, std::uint32_t shape_b) {
      const Path path_a(step, a, shape_a, origin), path_b(step, b, shape_b, origin);
      const double thin = state.thickness(shape_a, shape_b);
      part = std::min(part, Passage(path_a, path_b, thin).end());
    });
  });
  return part;
}

/// The things whose way is followed.
struct FarMovers {
  std::vector<RigidId> launched;
  bool turns = false;  ///< some go far by turning, too
};

FarMovers findFarMovers(const State& state, const Scratch& scratch) {
  FarMovers found;
  for (const RigidId id : state.present) {
    if (isLaunched(state, scratch, id) && !isJoined(state, id)) found.launched.push_back(id);
    found.turns = found.turns || goesFar(state, id);
  }
  return found;
}

/// True when some body has to stop, or to stop earlier.
bool stopLaunched(const Step& step, const std::vector<RigidId>& launched) {
  const State& state = step.state;
  bool any = false;
  for (const RigidId id : launched) {
    const Rigid& r = state[id];
    const Vec2 end = r.x + step.motionOf(id).way;
    const Vec2 around = Vec2::Constant(state.extent(r).bounds.extent().norm());
    const Aabb swept{r.x.cwiseMin(end) - around, r.x.cwiseMax(end) + around};
    double part = 1.0;
    RigidId met = id;
    state.broadphase.tree.query(swept, [&](std::uint32_t other) {
      const RigidId o{other};
      const double until = o == id ? 1.0 : partUntil(step, id, o);
      if (until == 1.0) return;
      if (until < part) part = until, met = o;
      // It may be the other that runs into the one that a blow has slowed down.
      if (isFree(state, o) && !isJoined(state, o)) step.stop(o, until, id);
    });
    if (part == 1.0) continue;
    step.stop(id, part, met);
    any = true;
  }
  return any;
}

/// The two bodies of a contact.
void stopTurning(const Step& step, const ContactKey& key) {
  const State& state = step.state;
  const RigidId rigid_a = state[key.a].rigid, rigid_b = state[key.b].rigid;
  const bool far_a = goesFar(state, rigid_a), far_b = goesFar(state, rigid_b);
  if (!far_a && !far_b) return;
  const Vec2 origin = state.pose(key.a).position;
  const Path a(step, key.a, key.shape_a, origin), b(step, key.b, key.shape_b, origin);
  const double thin = state.thickness(key.shape_a, key.shape_b);
  const bool stops_a = far_a && bendsFar(a, thin) && !isJoined(state, rigid_a);
  const bool stops_b = far_b && bendsFar(b, thin) && !isJoined(state, rigid_b);
  if (!stops_a && !stops_b) return;
  const double part = Passage(a, b, thin).end();
  if (part == 1.0) return;
  if (stops_a) step.stop(rigid_a, part, rigid_b);
  if (stops_b) step.stop(rigid_b, part, rigid_a);
}

}  // namespace

void findStoppedTurns(const State& state, const Scratch& scratch,
                      std::vector<StoppedTurn>& stopped) {
  constexpr int kRounds = 4;  // one that stops may stand in another's way
  stopped.clear();
  const Step step{state, scratch, stopped};
  const FarMovers movers = findFarMovers(state, scratch);
  for (int i = 0; i < kRounds && stopLaunched(step, movers.launched); ++i) continue;
  if (!movers.turns) return;
  for (const ContactTable::Slot slot : state.contacts.order) {
    stopTurning(step, state.contacts[slot].key);
  }
}

}  // namespace merge2d
