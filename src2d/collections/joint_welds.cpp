#include "src2d/collections/joint_welds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src2d/collections/weld_list.h"

namespace merge2d {
namespace {

using Pair = std::pair<BodyId, BodyId>;

/// Inside a collection rows hold until they have yielded.
int freedomsInside(const State& state, const JointBlock& k) {
  const Joint& joint = state.joints[k.joint];
  const auto yields = [&](std::size_t row) {
    return std::abs(joint.yielded[row]) > state.settings.unmerging.sliding;
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(k.coupled); ++i) {
    if (yields(i)) return 0;
  }
  if (joint.kind == JointKind::Weld) return 3;
  const bool brake = k.motor && joint.motor->speed == 0.0 && !yields(kMotorRow);
  const bool limit = k.isAtLimit() && !yields(kLimitRow);
  if (joint.kind == JointKind::Distance) return (joint.limits ? limit : joint.stiffness == 0.0);
  return brake || limit ? 3 : 2;
}

/// The first weld that is not before the pair.
auto weldAt(std::vector<Weld>& welds, const Pair& pair) {
  return std::lower_bound(welds.begin(), welds.end(), pair,
                          [](const Weld& w, const Pair& p) { return pairOf(w) < p; });
}

/// Counts the joints of each weld anew, in contacts: `found(weld, contacts)`.
template <class F>
void countHolds(const State& state, Collection& c, F&& found) {
  std::vector<JointHold> holds(c.welds.size());
  for (const JointBlock& k : c.joints) {
    const Joint& joint = state.joints[k.joint];
    if (joint.to_world) continue;
    const auto weld = weldAt(c.welds, pairOf(joint));
    if (weld == c.welds.end() || pairOf(*weld) != pairOf(joint)) continue;
    holds[static_cast<std::size_t>(weld - c.welds.begin())].add(joint.kind,
                                                                freedomsInside(state, k));
  }
  for (std::uint32_t i = 0; i < c.welds.size(); ++i) found(i, holds[i].contacts());
}

/// True when some weld holds less than before.
bool updateWelds(const State& state, Collection& c) {
  bool less = false;
  countHolds(state, c, [&](std::uint32_t i, int contacts) {
    Weld& weld = c.welds[i];
    if (contacts == weld.joints) return;
    less |= contacts < weld.joints;
    weld.joints = static_cast<std::uint8_t>(contacts);
  });
  return less;
}

/// Sums up the velocities at the rows that give way: soft ones, and those at a bound.
void sumYields(State& state, const Collection& c, const std::vector<SolverVelocity>& u) {
  const Rotation& turn = state[c.rigid].rotation;
  for (const JointBlock& k : c.joints) {
    k.forEachRow([&](std::size_t i) {
      const JointRow& row = k.rows[i];
      const bool holds = row.softness == 0.0 && k.isWithinBounds(i);
      float& yielded = state.joints[k.joint].yielded[i];
      const double w = jointVelocity(row, turn, u[k.a], u[k.b]);
      yielded = holds ? 0.0F : yielded + static_cast<float>(w);
    });
  }
}

/// No corner of the members of a joint is farther from its ends [m].
double reachOfMembers(const State& state, const Collection& c, const Joint& joint) {
  const auto reach = [&](BodyId body, const Vec2& anchor) {
    return state[body].rigid == c.rigid ? reachFrom(state, body, anchor) : 0.0;
  };
  const double of_a = reach(joint.a, joint.anchor_a);
  return joint.to_world ? of_a : std::max(of_a, reach(joint.b, joint.anchor_b));
}

}  // namespace

void addJointWelds(const State& state, Collection& c) {
  for (const JointBlock& k : c.joints) {
    const Joint& joint = state.joints[k.joint];
    if (joint.to_world) continue;  // it is no weld
    const Pair pair = pairOf(joint);
    const auto at = weldAt(c.welds, pair);
    if (at != c.welds.end() && pairOf(*at) == pair) continue;
    c.welds.insert(at, Weld{.a = pair.first, .b = pair.second});
  }
  if (!c.joints.empty()) updateWelds(state, c);
}

bool loosenJoints(State& state, Collection& c, const std::vector<SolverVelocity>& u) {
  if (c.joints.empty()) return false;
  sumYields(state, c, u);
  return updateWelds(state, c);
}

double fastestYield(const State& state, const Collection& c) {
  double fastest = 0.0;
  for (const JointBlock& k : c.joints) {
    const std::array<double, 4> change = changeBySolving(k, {}, {});
    k.forEachRow([&](std::size_t i) {
      if (k.rows[i].softness == 0.0) return;
      const double arm = k.rows[i].turns() ? reachOfMembers(state, c, state.joints[k.joint]) : 1.0;
      fastest = std::max(fastest, arm * std::abs(change[i]));
    });
  }
  return fastest;
}

bool anyJointBreaks(const State& state, const Collection& c) {
  return std::any_of(c.joints.begin(), c.joints.end(),
                     [&](const JointBlock& k) { return breaks(state, state.joints[k.joint]); });
}

std::vector<std::uint32_t> takeOverloadedJoints(const State& state, Collection& c) {
  c.stale = true;
  std::vector<std::uint32_t> taken;
  std::erase_if(c.joints, [&](const JointBlock& k) {
    const bool overloaded = breaks(state, state.joints[k.joint]);
    if (overloaded) taken.push_back(k.joint);
    return overloaded;
  });
  countHolds(state, c, [&](std::uint32_t i, int contacts) {
    Weld& weld = c.welds[i];
    const bool held = weld.joints > 0;
    weld.joints = static_cast<std::uint8_t>(contacts);
    if (!held || weld.joints > 0 || weld.count > 0) return;
    weld.cut = true;
    weld.reason = EventReason::Broken;
  });
  return taken;
}

void breakWhatStaysInside(State& state, Scratch& scratch, std::span<const std::uint32_t> joints) {
  for (const std::uint32_t i : joints) {
    if (isInside(state, state.joints[i]) || scratch.solved) {
      breakJoint(state, scratch, state.joints[i]);
    } else {
      scratch.overloaded_joints.push_back(i);
    }
  }
}

}  // namespace merge2d
