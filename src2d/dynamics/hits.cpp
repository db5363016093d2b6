#include "src2d/dynamics/hits.h"

#include <algorithm>
#include <span>

#include "src2d/contact/approach.h"
#include "src2d/contact/cast.h"
#include "src2d/contact/detection.h"
#include "src2d/contact/table.h"
#include "src2d/dynamics/nncg.h"

namespace merge2d {
namespace {

constexpr double kStill = 1e-9;  ///< slower is no approach, where a point bounces [m/s]
constexpr double kSoft = 1e-5;   ///< the same without restitution: 0.1 µm in a step [m/s]
constexpr double kMet = 1e-9;    ///< nearer than this two points have met [m]

/// A contact point while hits go on.
struct HitPoint {
  std::uint32_t block = 0;  ///< of the island
  int row = 0;              ///< in the block
  double gap = 0.0;         ///< now [m]
  double touching = 0.0;    ///< a gap up to this is a touch [m]
  double e = 0.0;           ///< restitution
  double least = 0.0;       ///< slower approaches do not bounce [m/s]
  double alpha = 0.0;       ///< how much faster the approach becomes by loads [m/s²]
  double allowed = 0.0;     ///< slower approaches may sink in [m/s]
  double still = kStill;    ///< slower is no approach [m/s]
  bool holds = false;       ///< touches and does not bounce: bears at any hit
  bool meets = false;       ///< takes part in the hit at hand
  std::int32_t rows = -1;   ///< of that hit, or −1
  double target = 0.0;      ///< of w after it [m/s]
  double extra = 0.0;       ///< part of the target that comes from loads [m/s]
};

class HitSolver {
 public:
  HitSolver(State& state, Scratch& scratch, const Island& island)
      : state_(state),
        scratch_(scratch),
        blocks_(scratch.blocks.data() + island.first, island.last - island.first),
        joints_(scratch.joint_blocks.data() + island.first_joint,
                island.last_joint - island.first_joint),
        bodies_(scratch.island_bodies.data() + island.first_body,
                island.last_body - island.first_body),
        first_(island.first) {}

  void run() {
    listPoints();
    ways_.assign(bodies_.size(), Twist{});
    const std::size_t most = kFewHits + 2 * std::min(points_.size(), kManyPoints);
    for (std::size_t hits = 0; hits < most; ++hits) {
      const double wait = timeToNext();
      if (time_ + wait >= state_.h) return finish();
      advance(wait);
      hit();
    }
    keepWays();  // so many hits that the bodies had better wait where they are
  }

 private:
  static constexpr std::size_t kFewHits = 32, kManyPoints = 200;
  static constexpr std::uint32_t kFixed = ~0U;

  /// The places of a block's bodies among those of the island.
  struct Ends {
    std::uint32_t a = kFixed, b = kFixed;
  };

  SolverVelocity& u(std::uint32_t rigid) { return scratch_.u[rigid]; }
  double velocityOf(const HitPoint& p) {
    const ContactBlock& k = blocks_[p.block];
    return contactVelocity(k, p.row, k.nx, k.ny, u(k.a), u(k.b)).n;
  }
  ContactPoint& pointOf(const HitPoint& p) {
    const RowSource& source = scratch_.row_sources[scratch_.block_order[first_ + p.block].source()];
    return state_.contacts.point(source.points[static_cast<std::size_t>(p.row)]);
  }

  void listPoints() {
    for (std::uint32_t i = 0; i < blocks_.size(); ++i) {
      const ContactBlock& k = blocks_[i];
      ends_.push_back({placeOf(k.a), placeOf(k.b)});
      const RowSource& source = scratch_.row_sources[scratch_.block_order[first_ + i].source()];
      if (source.isInner()) continue;  // the solve has held it, and it is to be closed again
      const Contact& contact = state_.contacts.contactOf(source.points[0]);
      const ContactKey& key = contact.key;
      for (int row = 0; row < k.count; ++row) {
        HitPoint p{.block = i, .row = row};
        const CastEnd* end = k.hits ? castOf(scratch_, contact, pointOf(p)) : nullptr;
        p.gap = end ? end->carried : pointOf(p).gap;
        p.e = k.bilateral ? 0.0 : restitutionOf(state_, key.a, key.b);
        p.still = p.e > 0.0 || k.bilateral ? kStill : kSoft;
        p.touching = touchingGap(state_, key);
        p.least = leastBounce(state_, key);
        const bool hit = (k.hits >> row & 1) != 0;
        const double w = velocityOf(p);
        p.holds = k.bilateral || (p.e == 0.0 && !hit && p.gap <= p.touching);
        if (!hit && p.gap <= p.touching) p.allowed = std::min(0.0, w);
        p.alpha = loadOf(k, row, w);
        points_.push_back(p);
      }
    }
  }

  /// How much faster the two come towards each other by loads [m/s²]: no more than these can.
  double loadOf(const ContactBlock& k, int row, double w) {
    const SolverVelocity a = velocityAtStart(state_, scratch_, k.a);
    const SolverVelocity b = velocityAtStart(state_, scratch_, k.b);
    const double w_start = contactVelocity(k, row, k.nx, k.ny, a, b).n;
    const double most = 2.0 * state_.gravity.norm();
    return std::clamp((w_start - w) / state_.h, -most, most);
  }

  double timeToNext() {
    double least = 1e300;
    for (const HitPoint& p : points_) {
      const double w = velocityOf(p);
      if (w >= p.allowed - p.still) continue;
      least = std::min(least, p.gap <= kMet ? 0.0 : p.gap / -w);
    }
    return least;
  }

  void advance(double dt) {
    if (dt == 0.0) return;
    for (HitPoint& p : points_) p.gap += dt * velocityOf(p);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const SolverVelocity& v = u(bodies_[i]);
      ways_[i] = {ways_[i].vx + dt * v.vx, ways_[i].vy + dt * v.vy, ways_[i].omega + dt * v.omega};
    }
    time_ += dt;
  }

  /// The velocities by Newton's law of the points that have met.
  void aim(HitPoint& p, double met) {
    const double w = velocityOf(p), extra = p.alpha * (time_ - 0.5 * state_.h);
    const bool approaches = w < p.allowed - p.still && p.gap <= met;
    p.meets = approaches;
    p.target = blocks_[p.block].bilateral ? w : p.allowed;
    p.extra = 0.0;
    if (!approaches || p.e == 0.0 || -w + extra <= p.least) return;
    p.target = std::max(0.0, p.e * (-w + extra) + extra);
    p.extra = std::max(0.0, p.target + p.e * w);
  }

  /// Two faces meet at both ends of where they overlap, also if one of them is a hair behind.
  void meetTogether(HitPoint& p, HitPoint& q) {
    if (p.block != q.block || p.meets == q.meets) return;
    HitPoint& behind = p.meets ? q : p;
    aim(behind, behind.touching);
  }

  /// Solves the points that have met, with all those around them that this makes give way.
  void hit() {
    moveArms();
    for (HitPoint& p : points_) aim(p, kMet);
    for (std::size_t i = 1; i < points_.size(); ++i) meetTogether(points_[i - 1], points_[i]);
    start_.clear();
    for (const std::uint32_t b : bodies_) start_.push_back(u(b));
    constexpr int kRounds = 4;  // then all that bear are asked
    for (int round = 0; round == 0 || addThoseThatGiveWay(round >= kRounds); ++round) {
      returnToStart();
      collectRows();
      solve();
    }
    const double part = weaken();
    // Without restitution a point that has met stays in touch, and bears the hits to come.
    for (HitPoint& p : points_) p.holds |= p.meets && p.e == 0.0;
    for (const HitPoint& p : points_) pointOf(p).struck += static_cast<float>(part * impulseOf(p));
  }

  void returnToStart() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) u(bodies_[i]) = start_[i];
  }

  /// Bodies on which the rows of the hit at hand act, and all joints.
  void listStruck() {
    struck_.clear();
    const auto add = [&](std::uint32_t rigid) {
      if (u(rigid).inv_mass > 0.0) struck_.push_back(rigid);
    };
    for (const ContactBlock& k : rows_) add(k.a), add(k.b);
    for (const JointBlock& k : joints_) add(k.a), add(k.b);
    std::ranges::sort(struck_);
    struck_.erase(std::unique(struck_.begin(), struck_.end()), struck_.end());
  }

  void collectRows() {
    rows_.clear();
    for (std::size_t i = 0; i < points_.size();) {
      std::size_t end = i;
      bool meets = false;
      for (; end < points_.size() && points_[end].block == points_[i].block; ++end) {
        meets |= points_[end].meets;
      }
      if (meets) rows_.push_back(rowsOf(points_[i].block));
      for (; i < end; ++i) {
        HitPoint& p = points_[i];
        p.rows = meets ? static_cast<std::int32_t>(rows_.size()) - 1 : -1;
        if (meets) rows_.back().bias[p.row] = p.meets ? -p.target : kNeverActs;
      }
    }
  }

  bool bears(const HitPoint& p) const {
    return p.holds && (blocks_[p.block].bilateral || p.gap <= p.touching);
  }

  /// True when there were some among those that touch and bear.
  bool addThoseThatGiveWay(bool all) {
    bool gives = false;
    for (HitPoint& p : points_) {
      if (p.meets || !bears(p)) continue;
      const double w = velocityOf(p) - p.target;
      p.meets = blocks_[p.block].bilateral ? std::abs(w) > kStill : w < -p.still;
      gives |= p.meets;
    }
    for (HitPoint& p : points_) p.meets |= gives && all && bears(p);
    return gives;
  }

  /// Lever arms where the bodies are now: both are pushed at one place, that on the first, or the
  /// impulse would change their angular momentum.
  void moveArms() {
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
      ContactBlock& k = blocks_[block];
      const Ends& ends = ends_[block];
      if (ends.a == kFixed || ends.b == kFixed) continue;
      const Vec2 apart =
          state_.rigids[k.b].x - state_.rigids[k.a].x + wayOf(ends.b) - wayOf(ends.a);
      const double across = k.nx * apart.y() - k.ny * apart.x();
      const double along = k.nx * apart.x() + k.ny * apart.y();
      for (int i = 0; i < k.count; ++i) {
        k.arm_bn[i] = k.arm_an[i] + across;
        k.arm_bt[i] = k.arm_at[i] - along;
      }
    }
  }

  /// The rows of a block without softness and impulses.
  ContactBlock rowsOf(std::uint32_t block) const {
    ContactBlock k = blocks_[block];
    k.lambda = {};
    fillMasses(k, 0.0, scratch_.u[k.a], scratch_.u[k.b]);
    return k;
  }

  /// Its place among the bodies of the island, or kFixed.
  std::uint32_t placeOf(std::uint32_t rigid) const {
    const auto at = std::ranges::lower_bound(bodies_, rigid);
    const bool moves = at != bodies_.end() && *at == rigid;
    return moves ? static_cast<std::uint32_t>(at - bodies_.begin()) : kFixed;
  }

  Vec2 wayOf(std::uint32_t place) const { return {ways_[place].vx, ways_[place].vy}; }

  void solve() {
    listStruck();
    std::vector<JointBlock> joints(joints_.begin(), joints_.end());
    for (JointBlock& k : joints) holdJoint(k);
    Nncg iteration(
        rows_.size() + joints.size(),
        [&](std::size_t i) -> Impulses& {
          return i < rows_.size() ? rows_[i].lambda : joints[i - rows_.size()].lambda;
        },
        struck_.size(), [&](std::size_t i) -> SolverVelocity& { return u(struck_[i]); },
        [&] {
          for (JointBlock& k : joints) solveJoint(k, {}, u(k.a), u(k.b));
          for (ContactBlock& k : rows_) solveBlock(k, k.nx, k.ny, u(k.a), u(k.b));
        },
        scratch_.nncg);
    constexpr std::size_t kFewRows = 8;
    constexpr double kExact = 1e-13, kClose = 1e-7;
    const bool bounces = std::ranges::any_of(
        points_, [](const HitPoint& p) { return p.meets && p.target > p.allowed; });
    iteration.endBelow(bounces ? kExact : kClose);
    const bool alone = rows_.size() == 1 && joints.empty();
    iteration.run(alone ? 2 : rows_.size() <= kFewRows ? 60 : 20, !alone);
  }

  /// A joint keeps the velocity that it has, and its motor does not act at once.
  void holdJoint(JointBlock& k) {
    k.lambda = {};
    k.motor = false;
    k.forEachRow([&](std::size_t i) {
      k.rows[i].softness = 0.0;
      k.rows[i].bias = -jointVelocity(k.rows[i], {}, u(k.a), u(k.b));
    });
  }

  double impulseOf(const HitPoint& p) const {
    return p.rows < 0 ? 0.0 : rows_[static_cast<std::size_t>(p.rows)].lambda_n(p.row);
  }

  /// Takes back the energy that the impulses would add. Where all of them are multiplied by `part`,
  /// the energy changes by part λ·w⁻ + part²/2 λ·Kλ. Returns that part.
  double weaken() {
    double along = 0.0, change = 0.0, by_loads = 0.0;
    for (const ContactBlock& k : rows_) {
      for (int i = 0; i < k.count; ++i) {
        const ContactVelocity now = contactVelocity(k, i, k.nx, k.ny, u(k.a), u(k.b));
        const ContactVelocity was = contactVelocity(k, i, k.nx, k.ny, before(k.a), before(k.b));
        along += k.lambda_n(i) * was.n + k.lambda_t(i) * was.t;
        change += 0.5 * (k.lambda_n(i) * (was.n + now.n) + k.lambda_t(i) * (was.t + now.t));
      }
    }
    for (const HitPoint& p : points_) by_loads += 0.5 * impulseOf(p) * p.extra;
    if (change <= by_loads + 1e-14 * std::abs(along) || change <= along) return 1.0;
    const double part = std::clamp((by_loads - along) / (change - along), 0.0, 1.0);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      SolverVelocity& v = u(bodies_[i]);
      const SolverVelocity& old = start_[i];
      v.vx = old.vx + part * (v.vx - old.vx);
      v.vy = old.vy + part * (v.vy - old.vy);
      v.omega = old.omega + part * (v.omega - old.omega);
    }
    return part;
  }

  const SolverVelocity& before(std::uint32_t rigid) {
    const std::uint32_t place = placeOf(rigid);
    return place == kFixed ? u(rigid) : start_[place];
  }

  void finish() {
    advance(state_.h - time_);
    keepWays();
  }
  void keepWays() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Twist& way = ways_[i];
      scratch_.hit_ways.push_back({RigidId{bodies_[i]}, Vec2(way.vx, way.vy), way.omega});
    }
  }

  State& state_;
  Scratch& scratch_;
  std::span<ContactBlock> blocks_;
  std::span<JointBlock> joints_;
  std::span<const std::uint32_t> bodies_;
  std::uint32_t first_;
  double time_ = 0.0;
  std::vector<HitPoint> points_;
  std::vector<ContactBlock> rows_;  ///< of the hit at hand
  std::vector<Ends> ends_;          ///< per block
  std::vector<std::uint32_t> struck_;
  std::vector<SolverVelocity> start_;
  std::vector<Twist> ways_;  ///< so far [m, rad]
};

}  // namespace

double leastBounce(const State& state, const ContactKey& key) {
  constexpr double kPart = 0.02, kLeast = 1e-6;  // of the size; m/s
  const double size = std::min(state.bounds(key.shape_a).extent().minCoeff(),
                               state.bounds(key.shape_b).extent().minCoeff());
  const double fall = std::sqrt(2.0 * state.gravity.norm() * kPart * size);
  return std::max(kLeast, std::min(state.settings.solver.restitution_velocity, fall));
}

void withdrawCasts(State& state, Scratch& scratch) {
  constexpr std::uint32_t kFew = 16;  // pairs of bodies
  const auto followed = [&](const Cast& cast) {
    return cast.hit && restitutionOf(state, cast.key.a, cast.key.b) == 0.0;
  };
  if (std::ranges::none_of(scratch.casts, followed)) return;
  DisjointSets& sets = scratch.sets;
  sets.reset(state.rigids.size());
  const auto rigid = [&](BodyId b) {
    return static_cast<std::uint32_t>(moverOf(state, scratch, b));
  };
  const auto moves = [&](BodyId b) { return scratch.u[rigid(b)].inv_mass > 0.0; };
  for (const BodyPair& pair : scratch.pairs) {
    if (moves(pair.a) && moves(pair.b)) sets.unite(rigid(pair.a), rigid(pair.b));
  }
  const auto islandOf = [&](const auto& pair) {
    return sets.find(rigid(moves(pair.a) ? pair.a : pair.b));
  };
  std::vector<std::uint32_t> pairs(state.rigids.size(), 0);
  for (const BodyPair& pair : scratch.pairs) ++pairs[islandOf(pair)];
  for (const Cast& cast : scratch.casts) {
    if (!followed(cast) || pairs[islandOf(cast.key)] <= kFew) continue;
    const auto* slot = findContact(state.contacts, cast.key);
    if (!slot) continue;
    updateManifold(state, state.contacts[*slot], approach(state, scratch, cast.key.a, cast.key.b));
  }
}

const Cast* castToHit(const State& state, const Scratch& scratch, const Contact& contact) {
  const Cast* cast = castOf(scratch, contact);
  if (!cast || !cast->hit || isBilateral(state, contact.key.a, contact.key.b)) return nullptr;
  return cast;
}

bool isHit(const State& state, const Contact& contact, const Cast* cast, double gap, double w_start,
           double w_free) {
  const ContactKey& key = contact.key;
  if (isBilateral(state, key.a, key.b) || gap + state.h * w_free >= 0.0) return false;
  if (-w_start <= w_start - w_free) return false;  // loads alone bring them together
  return restitutionOf(state, key.a, key.b) == 0.0 ? cast != nullptr
                                                   : -w_free > leastBounce(state, key);
}

SolverVelocity velocityAtStart(const State& state, const Scratch& scratch, std::uint32_t rigid) {
  SolverVelocity v = scratch.u[rigid];
  if (v.inv_mass == 0.0) return v;
  const StartMotion start = startMotion(state, scratch, RigidId{rigid});
  v.vx = start.v.x();
  v.vy = start.v.y();
  v.omega = start.omega;
  return v;
}

void resolveHits(State& state, Scratch& scratch, const Island& island) {
  HitSolver(state, scratch, island).run();
}

}  // namespace merge2d
