#include "src2d/contact/cast.h"

#include <algorithm>

#include "src2d/contact/approach.h"
#include "src2d/contact/internal_edges.h"
#include "src2d/geometry/distance.h"

namespace merge2d {
namespace {

/// A body that moves through the step as it would without contacts. Places are seen from `origin`,
/// so that a scene may lie anywhere.
struct Flight {
  Pose start;   ///< of the body
  Vec2 center;  ///< of mass, of the rigid thing that it belongs to, at the start
  StartMotion motion;

  Flight(const State& state, const Scratch& scratch, BodyId body, const Vec2& origin)
      : start(state.pose(body)), motion(freeMotion(state, scratch, state[body].rigid)) {
    const Rigid& r = state.rigid(body);
    start.position -= origin;
    // The frame of the world may lie anywhere; it does not turn.
    center = r.anchor == kWorldFrame ? start.position : Vec2(r.x - origin);
  }
  Vec2 centerAt(double t) const { return center + t * motion.v; }
  Pose at(double t) const {
    const Rotation turn = Rotation::of(t * motion.omega);
    return {centerAt(t) + turn * (start.position - center), turn * start.rotation};
  }
  Vec2 velocityAt(const Vec2& arm) const { return motion.v + cross(motion.omega, arm); }
};

struct Flights {
  Flight a, b;
  const Collider &shape_a, &shape_b;

  Pose relativeAt(double t) const { return a.at(t).toLocal(b.at(t)); }
};

/// When two flights meet in this step, or else are nearest.
struct Encounter {
  double time = 0.0;  ///< from the start of the step [s]
  bool hit = false;
};

/// Two flights at one time of the step, and bounds of how they go on.
class Approaching {
 public:
  Approaching(const Flights& f, double t, double left, const Vec2& n)
      : f_(f), n_(n), left_(left), way_(f.b.centerAt(t) - f.a.centerAt(t)) {
    list(f.a, f.shape_a, t, a_);
    list(f.b, f.shape_b, t, b_);
  }

  /// A time from now on in which the two do not meet. The plane with the normal `n` that bounds the
  /// one, seen from there, stands still: the other has to come through it with a vertex.
  double clear() const {
    const double front_a = highest(a_, 1.0) + radiusOf(f_.shape_a);
    const double front_b = highest(b_, -1.0) + radiusOf(f_.shape_b);
    const double of_a = clearOf(a_, f_.shape_a, 1.0, front_b, f_.a, f_.b);
    const double of_b = clearOf(b_, f_.shape_b, -1.0, front_a, f_.b, f_.a);
    return std::max(of_a, of_b);
  }

 private:
  struct Corners {
    std::array<Vec2, Polygon::kMaxVertices> arms;  ///< from the centre of mass
    std::size_t count = 0;
  };

  static void list(const Flight& flight, const Collider& shape, double t, Corners& corners) {
    const Pose pose = flight.at(t);
    const Vec2 center = flight.centerAt(t);
    corners.count = shape.isCircle() ? 1 : static_cast<std::size_t>(shape.count());
    for (std::size_t i = 0; i < corners.count; ++i) {
      const Vec2& p = shape.isCircle() ? shape.origin() : shape.vertex(static_cast<int>(i));
      corners.arms[i] = pose.exactly(p) - center;
    }
  }
  static double radiusOf(const Collider& shape) { return shape.isCircle() ? shape.radius() : 0.0; }

  /// Of corners along ±n, from their own centre of mass.
  double highest(const Corners& corners, double sign) const {
    double most = -1e300;
    for (std::size_t i = 0; i < corners.count; ++i) {
      most = std::max(most, sign * n_.dot(corners.arms[i]));
    }
    return most;
  }

  /// Until a corner can have come to the plane, which is `front` before the other's centre of mass.
  double clearOf(const Corners& corners, const Collider& shape, double sign, double front,
                 const Flight& own, const Flight& other) const {
    const Vec2 to_other = sign * way_, v = own.motion.v - other.motion.v;
    const Vec2 n = sign * n_;
    const double plane = n.dot(to_other) - front - radiusOf(shape);
    double least = 1e300;
    for (std::size_t i = 0; i < corners.count; ++i) {
      const Vec2& arm = corners.arms[i];
      const double way = plane - n.dot(arm);
      const double speed = n.dot(v + cross(own.motion.omega, arm) -
                                 cross(other.motion.omega, Vec2(arm - to_other))) +
                           0.5 * left_ * bending(arm, to_other, v, own, other);
      if (speed > 0.0) least = std::min(least, way / speed);
    }
    return least;
  }

  /// The acceleration of a corner seen from the other, which turns, at most: its own, Coriolis' and
  /// the centrifugal one.
  double bending(const Vec2& arm, const Vec2& to_other, const Vec2& v, const Flight& own,
                 const Flight& other) const {
    const double w = std::abs(own.motion.omega), turn = std::abs(other.motion.omega);
    if (w == 0.0 && turn == 0.0) return 0.0;
    const double r = arm.norm(), speed = v.norm();
    const double far = to_other.norm() + left_ * speed + r;
    return w * w * r + 2.0 * turn * (speed + w * r + turn * far) + turn * turn * far;
  }

  const Flights& f_;
  Vec2 n_;       ///< from a to b
  double left_;  ///< of the step [s]
  Vec2 way_;     ///< between the centres of mass
  Corners a_, b_;
};

/// From the distance and the normal of now on.
Encounter advance(const Flights& f, double h, double touching, Nearest now) {
  constexpr int kRounds = 40;
  const auto turning = [](const Flight& flight, const Collider& shape) {
    const Vec2 center = flight.start.toLocal(flight.center);
    return std::abs(flight.motion.omega) * reachFrom(shape, center);
  };
  const double turning_both = turning(f.a, f.shape_a) + turning(f.b, f.shape_b);
  const Vec2 v = f.b.motion.v - f.a.motion.v;
  Encounter nearest_yet;
  double least = 1e300, t = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const Pose pose_a = f.a.at(t);
    if (round > 0) now = nearest(f.shape_a, f.shape_b, pose_a.toLocal(f.b.at(t)));
    if (now.distance <= touching) return {t, true};
    if (now.distance < least) {
      least = now.distance;
      nearest_yet.time = t;
    }
    if (t >= h) return nearest_yet;
    const Vec2 n = pose_a.rotation * now.normal;
    const double closing = turning_both - n.dot(v);
    if (closing <= 0.0) return nearest_yet;
    const double clear = Approaching(f, t, h - t, n).clear();
    t = std::min(h, t + std::max((now.distance - 0.5 * touching) / closing,
                                 clear * (1.0 - 0.5 * touching / now.distance)));
  }
  return {t, true};  // after so many rounds they all but touch
}

/// True when some shape turns so far in the step that the motion of now says little.
bool turnsFar(const Flights& f, double h) {
  constexpr double kTurn = 0.1;  // rad
  const auto turns = [&](const Flight& flight, const Collider& shape) {
    return !shape.isCircle() && std::abs(flight.motion.omega) * h > kTurn;
  };
  return turns(f.a, f.shape_a) || turns(f.b, f.shape_b);
}

/// Whether the contact, taken where it is now, could close in this step.
bool couldClose(const State& state, const Flights& f, const Contact& contact) {
  const Vec2 n = f.a.start.rotation * contact.normal;
  for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
    const Vec2 p = f.a.start.exactly(contact.points[k].position);
    const Vec2 w = f.b.velocityAt(p - f.b.center) - f.a.velocityAt(p - f.a.center);
    if (contact.points[k].gap + state.h * n.dot(w) < 0.0) return true;
  }
  return false;
}

/// How far two things come in a step without a change of their nearest features, in touching gaps:
/// bodies that hardly move meet at the features that are nearest now. The normal of a round thing
/// turns on any way, and with it the direction of a bounce.
double shortWay(const State& state, const ContactKey& key) {
  constexpr double kShort = 20.0;
  const auto isRound = [&](std::uint32_t shape) { return state.collider(shape).isCircle(); };
  const bool bounces = restitutionOf(state, key.a, key.b) > 0.0;
  return bounces && (isRound(key.shape_a) || isRound(key.shape_b)) ? 1.0 : kShort;
}

/// True when the two come so near in this step, on a way so long, that their nearest features may
/// change.
bool isPredicted(const State& state, const Contact& contact, double ahead) {
  const double gap = smallestGap(contact);
  if (gap <= 0.0) return false;
  const double gravity =
      2.0 * state.gravity.norm() * state.h * state.h;  // twice the fall from rest
  if (gap >= ahead + gravity || ahead <= gravity) return false;
  const double touching = touchingGap(state, contact.key);
  return gap > touching && ahead > shortWay(state, contact.key) * touching + gravity;
}

/// The contact as it is at the encounter, in the frames of then. The memory of a point is kept
/// where the point is found again.
Contact contactAt(const State& state, const Flights& f, const Encounter& at, double margin,
                  const Contact& now) {
  const Pose b_in_a = f.relativeAt(at.time);
  const Manifold found = collide(f.shape_a, f.shape_b, b_in_a, margin);
  Contact then = now;
  then.normal = found.normal;
  then.count = static_cast<std::int16_t>(found.count);
  for (std::size_t k = 0; k < static_cast<std::size_t>(found.count); ++k) {
    ContactPoint& point = then.points[k] = {};
    point.fresh = true;
    for (std::size_t j = 0; j < static_cast<std::size_t>(now.count); ++j) {
      if (now.points[j].feature == found.points[k].feature) point = now.points[j];
    }
    point.position = found.points[k].position;
    point.gap = found.points[k].gap;
    point.feature = found.points[k].feature;
  }
  dropInternalEdges(state, b_in_a, then);
  return then;
}

/// Sees that contact from the start of the step, with its gaps carried back.
Cast carryBack(const State& state, const Flights& f, const Encounter& at, Contact& contact) {
  constexpr double kOpen = 1e-12;  // m: a predicted contact is no overlap
  constexpr double kFar = 10.0;    // touching gaps
  const Pose pose_a = f.a.at(at.time);
  const Vec2 n = pose_a.rotation * contact.normal;
  contact.normal = f.a.start.rotation.inverse() * n;
  Cast cast{.key = contact.key,
            .normal = contact.normal,
            .hit = at.hit,
            .displaced = turnsFar(f, state.h),
            .ends = {}};
  for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
    ContactPoint& point = contact.points[k];
    const Vec2 p = pose_a.exactly(point.position);
    const Vec2 arm_a = p - f.a.centerAt(at.time), arm_b = p - f.b.centerAt(at.time);
    const Vec2 on_a = f.a.center + arm_a, on_b = f.b.center + arm_b;
    const double w = n.dot(f.b.velocityAt(arm_b) - f.a.velocityAt(arm_a));
    const double w_now = n.dot(f.b.velocityAt(on_a - f.b.center) - f.a.velocityAt(arm_a));
    cast.ends[k] = {.feature = point.feature,
                    .gap = point.gap,
                    .carried = std::max(point.gap - at.time * w, kOpen),
                    .on_b = f.b.start.toLocal(on_b)};
    cast.displaced |= std::abs(cross(on_b - on_a, n)) > kFar * touchingGap(state, contact.key);
    const double open = at.hit ? 0.0 : -state.h * w_now;  // a miss does not act on free motion
    point.position = f.a.start.toLocal(on_a);
    point.gap = std::max({point.gap - at.time * w_now, open, kOpen});
  }
  return cast;
}

}  // namespace

void castContact(const State& state, Scratch& scratch, Contact& contact, double ahead,
                 std::vector<SoftHit>& soft) {
  const ContactKey& key = contact.key;
  if (!isPredicted(state, contact, ahead) || isHeld(state, contact)) return;
  if (scratch.load_order.size() != scratch.loads.size()) orderLoads(state, scratch);
  const Vec2 origin = state.pose(key.a).position;
  const Flights f{Flight(state, scratch, key.a, origin), Flight(state, scratch, key.b, origin),
                  state.collider(key.shape_a), state.collider(key.shape_b)};
  if (!turnsFar(f, state.h) && !couldClose(state, f, contact)) return;
  constexpr double kFine = 0.1;  // the normal of a round thing turns with the gap that is left
  const Encounter at =
      advance(f, state.h, kFine * touchingGap(state, key), {smallestGap(contact), contact.normal});
  const double margin = std::max(state.settings.solver.margin, ahead);
  Contact then = contactAt(state, f, at, margin, contact);
  if (then.count == 0) return contact.loseTouch();
  const Cast cast = carryBack(state, f, at, then);
  // Without restitution a hit that comes about where and as it seems now is as good as it is.
  if (at.hit && restitutionOf(state, key.a, key.b) == 0.0) {
    if (cast.displaced) soft.push_back({then, cast});
    return;
  }
  contact = then;
  scratch.casts.push_back(cast);
}

void sortCasts(Scratch& scratch) { std::ranges::sort(scratch.casts, {}, &Cast::key); }

}  // namespace merge2d
