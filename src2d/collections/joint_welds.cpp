#include "src2d/collections/joint_welds.h"

#include <algorithm>

#include "src2d/collections/weld_list.h"

namespace merge2d {
namespace {

using Pair = std::pair<BodyId, BodyId>;

/// Inside a collection motor and limit hold until they have yielded.
int freedomsInside(const State& state, const JointBlock& k) {
  const Joint& joint = state.joints[k.joint];
  if (joint.kind == JointKind::Weld) return 3;
  const auto yields = [&](std::size_t row) {
    return std::abs(joint.yielded[row - kMotorRow]) > state.settings.unmerging.sliding;
  };
  const bool brake = k.motor && joint.motor->speed == 0.0 && !yields(kMotorRow);
  const bool limit = k.limit && k.rows[kLimitRow].bias == 0.0 && !yields(kLimitRow);
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

/// Calls `f(yielded, w)` for motors and limits, with the velocity at them, 0 inside their bounds.
template <class F>
void forEachBound(State& state, const Collection& c, const std::vector<SolverVelocity>& u, F&& f) {
  const Rotation& turn = state[c.rigid].rotation;
  for (const JointBlock& k : c.joints) {
    for (const std::size_t row : {kMotorRow, kLimitRow}) {
      if (!(row == kMotorRow ? k.motor : k.limit)) continue;
      const JointRow& r = k.rows[row];
      const bool inside = k.lambda[row] > r.lower && k.lambda[row] < r.upper;
      const double w = inside ? 0.0 : jointVelocity(r, turn, u[k.a], u[k.b]);
      f(state.joints[k.joint].yielded[row - kMotorRow], w, inside);
    }
  }
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
  forEachBound(state, c, u, [](float& yielded, double w, bool inside) {
    yielded = inside ? 0.0F : yielded + static_cast<float>(w);
  });
  return updateWelds(state, c);
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
