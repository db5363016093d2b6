#include "src2d/merging/pair_readiness.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "src2d/dynamics/solver.h"
#include "src2d/merging/pair_metric.h"
#include "src2d/merging/rule.h"
#include "src2d/proofs/decided_settings.h"

namespace merge2d {
namespace {

constexpr double kPairOnEdge = 1.0 - 1e-6;

/// Sums and extremes over the contacts of one pair.
struct PairContacts {
  int active = 0;
  double fastest_slip = 0.0;    ///< of active contacts [m/s]
  double largest_breath = 0.0;  ///< change of the overlap since the last step [m]
  int on_edge = 0;              ///< active contacts at the limit of their cone
};

PairContacts lookAt(const State& state, const BodyPair& pair) {
  PairContacts seen;
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
  return seen;
}

/// All active contacts are on the edge of their cones: is there a motion of b against a, keeping
/// all of them closed, in which every one slips against its friction? A body wedged into a corner
/// is on the edge too, but goes nowhere. On ice any such motion goes on, however slow.
bool aboutToSlide(const State& state, const BodyPair& pair) {
  const Pose pose = state.pose(pair.b);
  const double size = state.extent(rigidOf(pair.b)).box.half.norm();
  std::vector<Eigen::Vector3d> tangents;  // rows: slip by a motion (v, size · omega) of b
  Eigen::Matrix3d closed = Eigen::Matrix3d::Zero();  // sum of the normals' rows, squared
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const Contact& contact = state.contacts[state.contacts.order[i]];
    const Pose a = state.pose(pair.a);
    const Vec2 n = a.rotation * contact.normal, t = perpendicular(n);
    for (int k = 0; k < contact.count; ++k) {
      const ContactPoint& p = contact.points[static_cast<std::size_t>(k)];
      if (p.lambda_n <= 0.0) continue;
      const Vec2 arm = (a * p.position - pose.position) / size;
      const Eigen::Vector3d normal(n.x(), n.y(), cross(arm, n));
      closed += normal * normal.transpose();
      tangents.push_back(Eigen::Vector3d(t.x(), t.y(), cross(arm, t)) *
                         (p.lambda_t > 0.0 ? 1.0 : -1.0));
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(closed);
  constexpr double kRankTolerance = 1e-6;
  const auto free = (modes.eigenvalues().array() < kRankTolerance).count();
  if (free != 1 || frictionOf(state, pair.a, pair.b) == 0.0) return free > 0;
  const Eigen::Vector3d motion = modes.eigenvectors().col(0);
  const auto along = [&](const Eigen::Vector3d& row) { return row.dot(motion); };
  return std::all_of(tangents.begin(), tangents.end(),
                     [&](const auto& r) { return along(r) > 0; }) ||
         std::all_of(tangents.begin(), tangents.end(), [&](const auto& r) { return along(r) < 0; });
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

}  // namespace

Vec2 impulseOf(const Contact& contact) {
  Vec2 sum = Vec2::Zero();
  for (int k = 0; k < contact.count; ++k) {
    const ContactPoint& p = contact.points[static_cast<std::size_t>(k)];
    sum += Vec2(p.lambda_n, p.lambda_t);
  }
  return sum;
}

int activePoints(const State& state, const BodyPair& pair) { return lookAt(state, pair).active; }

bool PairTest::ready() {
  const MergingSettings& m = state_.settings.merging;
  const PairContacts seen = lookAt(state_, pair_);
  bool ok = seen.active > 0;
  if (!ok) return note("pressed", "Section 5.3", seen.active, 1.0, false);
  const double scale = thresholdScale(contactSize(state_, pair_.a, pair_.b));
  const bool loud =
      seen.fastest_slip >= scale * m.sliding || seen.largest_breath >= scale * m.breathing;
  if (loud && !notes_) return false;  // the dearer question need not be asked
  if (mergingMethod(state_).refuses_edge) {
    const bool slides = seen.on_edge == seen.active && aboutToSlide(state_, pair_);
    ok &= note("edge", kOwnMerging, seen.on_edge, seen.active, !slides);
  }
  if (!ok && !notes_) return false;
  ok &= below("sliding", "(18)", seen.fastest_slip, scale * m.sliding);
  ok &= below("breathing", "Section 5.3", seen.largest_breath, scale * m.breathing);
  if (!ok && !notes_) return false;
  if (mergingMethod(state_).waits_for_load) {
    ok &= below("load", kOwnMerging, changeOfLoad(state_, pair_), kDecided.settling_rate);
  }
  if (!ok && !notes_) return false;
  const double motion = relativeMotion(state_, pair_, notes_);
  return below("relative-motion", "(17)", motion, scale * m.velocity) && ok;
}

void PairTest::noteCount(int before, int now) const {
  if (!notes_) return;
  for (std::size_t i = first_; i < notes_->decisions.size(); ++i) {
    notes_->decisions[i].before = before;
    notes_->decisions[i].count = now;
  }
}

bool PairTest::note(std::string_view criterion, std::string_view equation, double value,
                    double threshold, bool ok) {
  if (notes_) {
    notes_->decisions.push_back({.a = pair_.a,
                                 .b = pair_.b,
                                 .stage = "AccumulateRelativeMotion",
                                 .criterion = criterion,
                                 .equation = equation,
                                 .value = value,
                                 .threshold = threshold,
                                 .needed = state_.settings.merging.steps,
                                 .verdict = ok ? "below" : "apart"});
  }
  return ok;
}

}  // namespace merge2d
