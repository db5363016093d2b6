#include "src2d/dynamics/hits.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "src2d/dynamics/hit_points.h"
#include "src2d/dynamics/hit_rows.h"
#include "src2d/dynamics/hit_solver.h"
#include "src2d/geometry/collide.h"

namespace merge2d {
namespace {

/// The bodies of an island on their straight ways from hit to hit.
class HitPath {
 public:
  explicit HitPath(const HitIsland& island)
      : island_(island), points_(hitPoints(island)), ways_(island.bodies().size()) {
    for (const ContactBlock& k : island.blocks()) ends_.push_back(endsOf(k));
    for (const JointBlock& k : island.joints()) joint_ends_.push_back(endsOf(k));
    for (HitPoint& p : points_) {
      if (p.round && !isSwept(p)) meetAnew(p);
    }
  }

  /// Where bounces have no end, those that are still to come are plastic. Where these have none
  /// either, the bodies go on with the approach that is left: if they waited, they would gain speed
  /// from their weight without falling.
  void follow() {
    if (reachesTheEnd()) return;
    for (HitPoint& p : points_) {
      p.e = 0.0;
      p.still = HitPoint::kSoft;
    }
    if (!reachesTheEnd()) advance(island_.state().h - time_);
  }

  void keepWays(std::vector<HitWay>& ways) const {
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      ways.push_back({RigidId{island_.bodies()[i]}, wayOf(i), ways_[i].omega});
    }
  }

 private:
  static constexpr std::size_t kFewHits = 32, kManyPoints = 200;
  static constexpr std::size_t kLooks = 30;  ///< at each hit, until the distance has closed

  /// The places of a block's bodies among those of the island.
  struct Ends {
    std::uint32_t a = HitIsland::kFixed, b = HitIsland::kFixed;
  };

  /// From hit to hit. False after too many.
  bool reachesTheEnd() {
    const double h = island_.state().h;
    HitSolver solver(island_);
    const std::size_t most = kFewHits + 2 * std::min(points_.size(), kManyPoints);
    std::size_t hits = 0;
    for (std::size_t looks = 0; hits < most && looks < kLooks * most; ++looks) {
      const double wait = timeToNext();
      if (time_ + wait >= (1.0 - kEndOfStep) * h) {
        advance(h - time_);
        return true;
      }
      advance(wait);
      if (someAreLater()) continue;
      ++hits;
      moveArms();
      for (HitPoint& p : points_) aim(p, HitPoint::kMet);
      for (std::size_t i = 1; i < points_.size(); ++i) meetTogether(points_[i - 1], points_[i]);
      solver.solve(points_);
    }
    return false;
  }

  static bool approaches(const HitPoint& p, double w) { return w < p.allowed - p.still; }

  /// True where a bat, which nothing holds up, turns so far in the step that the gap of its start
  /// tells little: the cast knows better when it meets something.
  bool isSwept(const HitPoint& p) const {
    constexpr double kTurn = 0.1;  // rad
    const State& state = island_.state();
    const Contact& contact = state.contacts.contactOf(island_.sourceOf(p.block).points[0]);
    const auto sweeps = [&](std::uint32_t rigid, std::uint32_t place, std::uint32_t shape) {
      const double turn = state.h * std::abs(island_.u(rigid).omega);
      return place == HitIsland::kFixed && turn > kTurn && !state.collider(shape).isCircle();
    };
    const ContactBlock& k = island_.blocks()[p.block];
    const Ends& ends = ends_[p.block];
    return sweeps(k.a, ends.a, contact.key.shape_a) || sweeps(k.b, ends.b, contact.key.shape_b);
  }

  double timeToNext() const {
    double least = 1e300;
    for (const HitPoint& p : points_) {
      const double w = island_.velocityOf(p);
      if (approaches(p, w)) least = std::min(least, p.gap <= HitPoint::kMet ? 0.0 : p.gap / -w);
    }
    for (const JointBlock& k : island_.joints()) {
      const double w = limitVelocity(k), h = island_.state().h;
      const double wait = std::abs(w) > HitPoint::kSoft ? -h * k.rows[kLimitRow].bias / w : 0.0;
      if (wait > 0.0) least = std::min(least, wait);
    }
    return least;
  }

  /// How fast a joint moves along its limit, if it has one.
  double limitVelocity(const JointBlock& k) const {
    return k.limit ? jointVelocity(k.rows[kLimitRow], {}, island_.u(k.a), island_.u(k.b)) : 0.0;
  }

  /// The gap along any normal is a lower bound of the distance. True when one that has closed along
  /// the normal of before is still open along that of now.
  bool someAreLater() {
    bool later = false;
    for (HitPoint& p : points_) {
      if (!p.round || p.gap > HitPoint::kMet || !approaches(p, island_.velocityOf(p))) continue;
      meetAnew(p);
      later |= p.gap > HitPoint::kMet;
    }
    return later;
  }

  /// The normal, the gap and the arms where the bodies are now.
  void meetAnew(HitPoint& p) {
    const State& state = island_.state();
    const Contact& contact = state.contacts.contactOf(island_.sourceOf(p.block).points[0]);
    const ContactKey& key = contact.key;
    ContactBlock& k = island_.blocks()[p.block];
    const Pose a = poseNow(k.a, ends_[p.block].a, key.a), b = poseNow(k.b, ends_[p.block].b, key.b);
    constexpr double kAnyGap = 1e9;
    const Manifold found =
        collide(state.collider(key.shape_a), state.collider(key.shape_b), a.toLocal(b), kAnyGap);
    if (found.count != 1) return;
    p.gap = found.points[0].gap;
    BlockGeometry g{.normal = a.rotation * found.normal, .count = 1};
    const Vec2 on_a = a.exactly(found.points[0].position) - 0.5 * p.gap * g.normal;
    g.arm_a[0] = on_a - centerNow(k.a, ends_[p.block].a);
    g.arm_b[0] = on_a - centerNow(k.b, ends_[p.block].b);
    setArms(k, g);
  }

  void advance(double dt) {
    if (dt == 0.0) return;
    for (HitPoint& p : points_) p.gap += dt * island_.velocityOf(p);
    for (JointBlock& k : island_.joints()) {  // the bias of a limit is its gap per step
      k.rows[kLimitRow].bias += dt / island_.state().h * limitVelocity(k);
    }
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      const SolverVelocity& v = island_.u(island_.bodies()[i]);
      ways_[i] = {ways_[i].vx + dt * v.vx, ways_[i].vy + dt * v.vy, ways_[i].omega + dt * v.omega};
    }
    time_ += dt;
  }

  /// The velocities by Newton's law of the points that have met.
  void aim(HitPoint& p, double met) const {
    const double w = island_.velocityOf(p), extra = p.alpha * (time_ - 0.5 * island_.state().h);
    p.meets = approaches(p, w) && p.gap <= met;
    p.target = island_.blocks()[p.block].bilateral ? w : p.allowed;
    p.extra = 0.0;
    if (!p.meets || p.e == 0.0 || -w + extra <= p.least) return;
    p.target = std::max(0.0, p.e * (-w + extra) + extra);
    p.extra = std::max(0.0, p.target + p.e * w);
  }

  /// Two faces meet at both ends of where they overlap, also if one of them is a hair behind.
  void meetTogether(HitPoint& p, HitPoint& q) const {
    if (p.block != q.block || p.meets == q.meets) return;
    HitPoint& behind = p.meets ? q : p;
    aim(behind, behind.touching);
  }

  Vec2 wayOf(std::size_t place) const { return {ways_[place].vx, ways_[place].vy}; }

  template <class Block>
  Ends endsOf(const Block& k) const {
    return {island_.placeOf(k.a), island_.placeOf(k.b)};
  }

  /// From the centre of a block's first body to that of the second; none where one is fixed.
  template <class Block>
  std::optional<Vec2> apartNow(const Block& k, const Ends& ends) const {
    if (ends.a == HitIsland::kFixed || ends.b == HitIsland::kFixed) return std::nullopt;
    const auto& rigids = island_.state().rigids;
    return rigids[k.b].x - rigids[k.a].x + wayOf(ends.b) - wayOf(ends.a);
  }

  /// Lever arms where the bodies are now: both are pushed at one place, that on the first, or the
  /// impulse would change their angular momentum.
  void moveArms() {
    for (std::size_t block = 0; block < ends_.size(); ++block) {
      ContactBlock& k = island_.blocks()[block];
      const auto apart = apartNow(k, ends_[block]);
      if (!apart) continue;
      const double across = k.nx * apart->y() - k.ny * apart->x();
      const double along = k.nx * apart->x() + k.ny * apart->y();
      for (int i = 0; i < k.count; ++i) {
        k.arm_bn[i] = k.arm_an[i] + across;
        k.arm_bt[i] = k.arm_at[i] - along;
      }
    }
    for (std::size_t joint = 0; joint < joint_ends_.size(); ++joint) {
      JointBlock& k = island_.joints()[joint];
      const auto apart = apartNow(k, joint_ends_[joint]);
      if (!apart) continue;
      k.forEachRow([&](std::size_t i) {
        JointRow& row = k.rows[i];
        if (!row.turns()) row.arm_b = row.arm_a + row.dx * apart->y() - row.dy * apart->x();
      });
      fillInverse(k, island_.u(k.a), island_.u(k.b));
    }
  }

  /// The way so far of a body at a place of the island, or of one that does not respond.
  Twist wayOf(std::uint32_t rigid, std::uint32_t place) const {
    if (place != HitIsland::kFixed) return ways_[place];
    const SolverVelocity& v = island_.u(rigid);
    return {time_ * v.vx, time_ * v.vy, time_ * v.omega};
  }
  Vec2 centerNow(std::uint32_t rigid, std::uint32_t place) const {
    const Twist way = wayOf(rigid, place);
    return island_.state().rigids[rigid].x + Vec2(way.vx, way.vy);
  }
  Pose poseNow(std::uint32_t rigid, std::uint32_t place, BodyId body) const {
    const Pose start = island_.state().pose(body);
    const Rotation turn = Rotation::of(wayOf(rigid, place).omega);
    const Vec2 arm = start.position - island_.state().rigids[rigid].x;
    return {centerNow(rigid, place) + turn * arm, turn * start.rotation};
  }

  const HitIsland& island_;
  double time_ = 0.0;  ///< since the step began [s]
  std::vector<HitPoint> points_;
  std::vector<Ends> ends_;  ///< per block
  std::vector<Ends> joint_ends_;
  std::vector<Twist> ways_;  ///< so far, per body [m, rad]
};

}  // namespace

void resolveHits(State& state, Scratch& scratch, const Island& island) {
  const HitIsland of(state, scratch, island);
  HitPath path(of);
  path.follow();
  path.keepWays(scratch.hit_ways);
}

HitWay wayInStep(const State& state, const Scratch& scratch, RigidId id) {
  const auto hit = std::ranges::lower_bound(scratch.hit_ways, id, {}, &HitWay::id);
  if (hit != scratch.hit_ways.end() && hit->id == id) return *hit;
  return {id, state.h * state[id].v, state.h * state[id].omega};
}

}  // namespace merge2d
