#include "src2d/merging/merge_criteria.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "src2d/dynamics/solver.h"
#include "src2d/merging/pair_metric.h"
#include "src2d/proofs/decided_settings.h"

namespace merge2d {
namespace {

constexpr double kPairOnEdge = 1.0 - 1e-6;

/// The span of a few rows, as an orthonormal basis.
struct RowSpan {
  std::array<Eigen::Vector3d, 3> basis;
  std::size_t rank = 0;

  void add(Eigen::Vector3d row) {
    constexpr double kRankTolerance = 1e-6;
    for (std::size_t i = 0; i < rank; ++i) row -= basis[i].dot(row) * basis[i];
    if (rank < 3 && row.squaredNorm() >= kRankTolerance) basis[rank++] = row.normalized();
  }
};

/// Calls `visit` with the normal of each point that presses, its place as seen from b in units of
/// `size`, and the point.
template <class Visit>
void forEachPressed(const State& state, const BodyPair& pair, double size, Visit&& visit) {
  const Pose a = state.pose(pair.a);
  const Vec2 center = state.pose(pair.b).position;
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const Contact& contact = state.contacts[state.contacts.order[i]];
    const Vec2 n = a.rotation * contact.normal;
    for (int k = 0; k < contact.count; ++k) {
      const ContactPoint& p = contact.points[static_cast<std::size_t>(k)];
      if (p.lambda_n > 0.0) visit(n, Vec2((a * p.position - center) / size), p);
    }
  }
}

/// All active contacts are on the edge of their cones: is there a motion of b against a, keeping
/// all of them closed, in which every one slips against its friction? A body wedged into a corner
/// is on the edge too, but goes nowhere. On ice any such motion goes on, however slow.
bool aboutToSlide(const State& state, const BodyPair& pair) {
  const double size = state.extent(rigidOf(pair.b)).box.half.norm();
  const auto row = [](const Vec2& d, const Vec2& arm) {  // of a motion (v, size · omega) of b
    return Eigen::Vector3d(d.x(), d.y(), cross(arm, d));
  };
  RowSpan closed;
  forEachPressed(state, pair, size, [&](const Vec2& n, const Vec2& arm, const ContactPoint&) {
    closed.add(row(n, arm));
  });
  if (closed.rank != 2 || frictionOf(state, pair.a, pair.b) == 0.0) return closed.rank < 3;
  const Eigen::Vector3d motion = closed.basis[0].cross(closed.basis[1]);
  bool forwards = true, backwards = true;
  forEachPressed(state, pair, size, [&](const Vec2& n, const Vec2& arm, const ContactPoint& p) {
    const double slip = row(perpendicular(n), arm).dot(motion) * (p.lambda_t > 0.0 ? 1.0 : -1.0);
    forwards &= slip > 0.0;
    backwards &= slip < 0.0;
  });
  return forwards || backwards;
}

/// How fast the impulse between two bodies changes, seen from the first, as a part of itself [1/s]:
/// a frame that turns steadily changes nothing.
double changeOfLoad(const State& state, const BodyPair& pair) {
  Vec2 now = Vec2::Zero(), before = Vec2::Zero();
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const Contact& contact = state.contacts[state.contacts.order[i]];
    const Vec2 n = contact.normal, t = perpendicular(n), impulse = impulseOf(contact);
    now += impulse.x() * n + impulse.y() * t;
    before += static_cast<double>(contact.borne[0]) * n + static_cast<double>(contact.borne[1]) * t;
  }
  const double change = (now - before).norm();
  return change > 0.0 ? change / (state.h * std::max(now.norm(), before.norm())) : 0.0;
}

/// The paper's thresholds hold for bodies of usual size: those of smaller ones are ours.
std::string_view sourceOf(const PairInContact& pair, std::string_view paper) {
  return pair.scale < 1.0 ? kOwnMerging : paper;
}

}  // namespace

bool isWatched(const State& state, BodyId one, BodyId other) {
  const Rigid &a = state.rigid(one), &b = state.rigid(other);
  return !a.asleep && !b.asleep && !areOnTwoFrames(a, b);
}

Criterion isNotCarried(const State& state, BodyId one, BodyId other) {
  const double speed =
      std::max(std::abs(state[one].surface_velocity), std::abs(state[other].surface_velocity));
  return {"belt", kOwnMerging, speed, 0.0, !hasBelt(state, one, other)};
}

Vec2 impulseOf(const Contact& contact) {
  Vec2 sum = Vec2::Zero();
  for (int k = 0; k < contact.count; ++k) {
    const ContactPoint& p = contact.points[static_cast<std::size_t>(k)];
    sum += Vec2(p.lambda_n, p.lambda_t);
  }
  return sum;
}

PairInContact lookAt(const State& state, const BodyPair& pair) {
  PairInContact seen{.state = state, .pair = pair};
  const bool bilateral = isBilateral(state, pair.a, pair.b);
  const double mu = frictionOf(state, pair.a, pair.b);
  // On one frame they are at rest: their contacts have no rows, and show how they came there.
  const bool rests = sameFrame(state.rigid(pair.a), state.rigid(pair.b));
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const Contact& contact = state.contacts[state.contacts.order[i]];
    for (int k = 0; k < contact.count; ++k) {
      const ContactPoint& p = contact.points[static_cast<std::size_t>(k)];
      if (p.lambda_n <= 0.0 && !bilateral) continue;
      ++seen.active;
      const double slip = rests ? 0.0 : std::abs(p.w_t);
      seen.fastest_slip = std::max(seen.fastest_slip, slip);
      seen.largest_breath = std::max<double>(seen.largest_breath, std::abs(p.breath));
      const bool sticks = mu > 0.0 && slip < state.settings.sleeping.velocity;
      seen.on_edge +=
          !bilateral && !sticks && std::abs(p.lambda_t) >= kPairOnEdge * mu * p.lambda_n;
    }
  }
  if (seen.active > 0) seen.scale = thresholdScale(contactSize(state, pair.a, pair.b));
  return seen;
}

Criterion pressed(const PairInContact& pair) {
  return {"pressed", "Section 5.3", static_cast<double>(pair.active), 1.0, pair.active > 0};
}

Criterion slidesSlowly(const PairInContact& pair) {
  const double most = pair.scale * pair.state.settings.merging.sliding;
  return below("sliding", sourceOf(pair, "(18)"), pair.fastest_slip, most);
}

Criterion hardlyBreathes(const PairInContact& pair) {
  const double most = pair.scale * pair.state.settings.merging.breathing;
  return below("breathing", sourceOf(pair, "Section 5.3"), pair.largest_breath, most);
}

Criterion isNotAboutToSlide(const PairInContact& pair) {
  const bool wedged = pair.on_edge == pair.active && !aboutToSlide(pair.state, pair.pair);
  return below("edge", kOwnMerging, wedged ? 0.0 : pair.on_edge, pair.active);
}

Criterion hasSettledLoad(const PairInContact& pair) {
  return below("load", kOwnMerging, changeOfLoad(pair.state, pair.pair), kDecided.settling_rate);
}

Criterion movesAsOne(const PairInContact& pair) {
  const double most = pair.scale * pair.state.settings.merging.velocity;
  const std::string_view source =
      isNaive(pair.state, pair.pair) ? kOwnMerging : sourceOf(pair, "(17)");
  return below("relative-motion", source, relativeMotion(pair.state, pair.pair), most);
}

}  // namespace merge2d
