#include "src2d/merging/decided_unmerge.h"

#include <algorithm>
#include <cmath>

#include "src2d/merging/cuts.h"
#include "src2d/merging/default_unmerge.h"
#include "src2d/merging/inner_solve.h"
#include "src2d/merging/joint_welds.h"
#include "src2d/merging/limits.h"
#include "src2d/merging/load_certificate.h"
#include "src2d/merging/metric.h"
#include "src2d/merging/sweep.h"

namespace merge2d {
namespace {

/// How fast the two bodies of a weld move against each other at the corners of their boxes: of the
/// box where this is most, and of the one where it is least [m/s].
struct WeldMotion {
  double most = 0.0, least = 0.0;
};

class WeldMotions {
 public:
  WeldMotions(const State& state, const Collection& c, const std::vector<SolverVelocity>& u)
      : state_(state), c_(c), u_(u), turn_(state[c.rigid].rotation) {}

  /// Zero where a bound tells that nothing is faster than `ignored`.
  WeldMotion of(const Weld& weld, double ignored) const {
    const Vec2 between = fromFirstToSecond(weld);
    const VelocityField a = field(weld.a, Vec2::Zero()), b = field(weld.b, between);
    double radius = 0.0;
    for (const BodyId id : {weld.a, weld.b}) {
      const OrientedBox& box = state_.extent(rigidOf(id)).box;
      if (isMember(id)) radius = std::max(radius, box.frame.position.norm() + box.half.norm());
    }
    const double linear = (b.v - a.at(b.x)).norm(), turning = std::abs(b.omega - a.omega);
    if (linear + turning * (radius + between.norm()) <= ignored) return {};
    WeldMotion motion{0.0, std::numeric_limits<double>::infinity()};
    const Vec2 origin = state_.pose(weld.a).position;
    for (const BodyId id : {weld.a, weld.b}) {
      if (!isMember(id)) continue;
      OrientedBox box = state_.extent(rigidOf(id)).box;
      const Pose pose = state_.pose(id);
      box.frame = Pose{pose.position - origin, pose.rotation} * box.frame;
      const double speed = fastestCorner(box, a, b);
      motion = {std::max(motion.most, speed), std::min(motion.least, speed)};
    }
    return motion;
  }

 private:
  bool isMember(BodyId b) const { return state_[b].rigid == c_.rigid; }

  VelocityField field(BodyId b, const Vec2& at) const {
    const SolverVelocity& u = u_[index(b)];
    return {at, {u.vx, u.vy}, u.omega};
  }

  Vec2 fromFirstToSecond(const Weld& weld) const {
    if (isMember(weld.a) && isMember(weld.b)) {
      return turn_ * (state_[weld.b].local - state_[weld.a].local);
    }
    return state_.pose(weld.b).position - state_.pose(weld.a).position;
  }

  const State& state_;
  const Collection& c_;
  const std::vector<SolverVelocity>& u_;
  Rotation turn_;
};

/// A point that presses for the first time is a contact like any other from now on, and one that
/// presses again has not been lost.
void notePressing(Collection& c) {
  for (std::size_t b = 0; b < c.blocks.size(); ++b) {
    ContactBlock& k = c.blocks[b];
    InternalContact& inner = c.contacts[c.block_contact[b]];
    if (inner.since == kExpected) continue;
    for (int i = 0; i < k.count; ++i) {
      PointWatch& watch = inner.watch[static_cast<std::size_t>(i)];
      watch.slip = watch.opening = {};
      if (broken(k, i)) continue;
      watch.active = true;
      watch.lost = false;
      k.bias[i] = 0.0;
      c.watches[b].activate(i);
    }
  }
}

/// The components of the graph of welds that are not cut: in a converged solution, whatever does
/// not move is held, and no rigidity need be asked for.
Parts componentsOf(const Collection& c) {
  const auto members = static_cast<std::uint32_t>(c.members.size());
  DisjointSets sets;
  sets.reset(members);
  std::vector<std::uint8_t> fixed(members, 0);
  for (const Weld& weld : c.welds) {
    if (weld.cut || weld.expected) continue;
    if (weld.node_a < members && weld.node_b < members) {
      sets.unite(weld.node_a, weld.node_b);
    } else {
      fixed[std::min(weld.node_a, weld.node_b)] = 1;  // to the frame, whose node is the last
    }
  }
  Parts parts;
  std::vector<std::uint32_t> number(members, ~0u);
  for (std::uint32_t m = 0; m < members; ++m) {
    std::uint32_t& p = number[sets.find(m)];
    if (p == ~0u) {
      p = static_cast<std::uint32_t>(parts.anchored.size());
      parts.anchored.push_back(0);
    }
    parts.part.push_back(p);
    parts.anchored[p] = static_cast<std::uint8_t>(parts.anchored[p] | fixed[m]);
  }
  return parts;
}

/// Broken where nothing presses, sliding where a contact is on the edge of its cone.
EventReason reasonOf(const Collection& c, const Weld& weld) {
  bool presses = weld.joints > 0, slides = false;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const ContactBlock& k = c.blocks[c.contacts[i].block];
    for (int p = 0; p < k.count; ++p) {
      presses |= !broken(k, p);
      slides |= !broken(k, p) && onEdge(k, p);
    }
  }
  if (!presses) return EventReason::Broken;
  return slides ? EventReason::Sliding : EventReason::RelativeMotion;
}

/// The decision about one weld, as a value.
Decision decide(const Weld& weld, double speed, double threshold) {
  return {.a = weld.a,
          .b = weld.b,
          .stage = "Unmerge",
          .criterion = "motion",
          .equation = "",
          .value = speed,
          .threshold = threshold,
          .count = speed > threshold ? 1 : 0,
          .verdict = speed > threshold ? "unmerge" : "keep"};
}

/// Cuts the welds whose bodies move. Returns whether any does.
bool cutMovers(const State& state, Scratch& scratch, Collection& c) {
  const WeldMotions motions(state, c, scratch.sweep_u);
  const double threshold = cutSpeed(state), noise = kDecided.beyond_residual * c.residual;
  c.cut_welds.clear();
  for (std::uint32_t w = 0; w < c.welds.size(); ++w) {
    Weld& weld = c.welds[w];
    weld.cut = false;
    weld.turning = {};
    if (weld.expected) continue;
    const WeldMotion motion = motions.of(weld, scratch.notes ? 0.0 : threshold);
    const double speed = motion.least > noise ? motion.most : 0.0;
    const Decision decision = decide(weld, speed, threshold);
    if (scratch.notes) scratch.notes->decisions.push_back(decision);
    if (speed <= threshold) continue;
    weld.cut = true;
    weld.turning = {static_cast<float>(speed), 1};
    weld.reason = reasonOf(c, weld);
    c.cut_welds.push_back(w);
  }
  return !c.cut_welds.empty();
}

/// Remembers the impulses that carry today's load, and looks whether a load beyond it is carried
/// too: one that swings then finds its proof before it gets there.
void prove(const State& state, Scratch& scratch, Collection& c) {
  LoadCertificate& proof = c.certificate.front();
  const Witness load = asWitness(state, c, loadOn(state, scratch, c));
  remember(c, Witness(load));
  if (proof.witnesses.size() < 2) return;
  const std::vector<Impulses> today = proof.witnesses.back().lambda;
  Witness next = beyond(proof, load, kDecided.overshoot);
  const bool carried = carries(state, scratch, c, next);
  if (carried) remember(c, std::move(next));
  std::size_t at = 0;
  for (ContactBlock& k : c.blocks) k.lambda = today[at++];
  for (JointBlock& k : c.joints) k.lambda = today[at++];
  const auto of_today = std::ranges::find(proof.witnesses, today, &Witness::lambda);
  proof.weights = {};
  proof.lambda_stale = proof.push_stale = true;
  if (of_today == proof.witnesses.end()) return;  // the other one took its place
  proof.weights[static_cast<std::size_t>(of_today - proof.witnesses.begin())] = 1.0;
  proof.lambda_stale = false;
}

/// Where the search has not converged, nothing is concluded but from motion far above its residual.
void decideOne(State& state, Scratch& scratch, Collection& c) {
  if (breakJointsInside(state, scratch, c)) return;
  notePressing(c);
  if (!c.joints.empty()) loosenJoints(state, c, scratch.sweep_u);
  Noted noted(scratch.notes);
  const bool cut = cutMovers(state, scratch, c);
  noted.close();
  c.settled = !cut && !c.certificate.front().in_doubt;
  if (c.settled) return prove(state, scratch, c);
  if (!cut) return;
  const Parts parts = componentsOf(c);
  const RigidId id = c.rigid;
  if (fallsApart(state, c, parts)) splitAtCuts(state, scratch, id, parts);
  restate(state, noted, "cut");
}

}  // namespace

void unmergeMovers(State& state, Scratch& scratch) {
  const std::size_t slots = scratch.doubts.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    Collection& c = state.collections[slot];
    if (c.id == kNoCollection || doubtOf(state, scratch, c) != Doubt::Load) continue;
    decideOne(state, scratch, c);
  }
  unmergeConfirmed(state, scratch);
}

}  // namespace merge2d
