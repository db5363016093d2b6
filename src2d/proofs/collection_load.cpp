#include "src2d/proofs/collection_load.h"

#include <algorithm>
#include <cmath>

#include "src2d/dynamics/joint_rows.h"

namespace merge2d {
namespace {

std::uint32_t slotOf(const State& state, BodyId b) {
  return static_cast<std::uint32_t>(index(state[b].rigid) - state.bodies.size());
}

/// Adds impulses per body, in the order in which they come.
class OuterLoads {
 public:
  OuterLoads(const State& state, Scratch& scratch)
      : state_(state), loads_(scratch.outer_loads), place_(scratch.load_place) {
    loads_.clear();
    place_.resize(state.bodies.size(), 0);
  }

  void add(BodyId b, const Vec2& impulse, double moment) {
    if (!state_.isAwakeMember(b)) return;
    std::uint32_t& place = place_[index(b)];
    if (place == 0) {
      loads_.push_back({.slot = slotOf(state_, b), .member = state_[rigidOf(b)].member});
      place = static_cast<std::uint32_t>(loads_.size());
    }
    loads_[place - 1].impulse += impulse;
    loads_[place - 1].moment += moment;
  }

  void finish() {
    for (const OuterLoad& l : loads_) {
      place_[index(state_.collections[l.slot].members[l.member])] = 0;
    }
    std::ranges::sort(loads_, {}, [](const OuterLoad& l) { return packed(l.slot, l.member); });
  }

 private:
  const State& state_;
  std::vector<OuterLoad>& loads_;
  std::vector<std::uint32_t>& place_;  ///< per body: one more than its place in loads_, or 0
};

void addContacts(const State& state, const Scratch& scratch, OuterLoads& loads) {
  for (const BodyPair& pair : scratch.pairs) {
    if (!state.isAwakeMember(pair.a) && !state.isAwakeMember(pair.b)) continue;
    const Pose pose_a = state.pose(pair.a);
    const Vec2 x_b = state.pose(pair.b).position;
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      const Contact& contact = state.contacts[state.contacts.order[i]];
      const Vec2 n = pose_a.rotation * contact.normal, t = perpendicular(n);
      for (int k = 0; k < contact.count; ++k) {
        const ContactPoint& point = contact.points[static_cast<std::size_t>(k)];
        if (point.lambda_n == 0.0 && point.lambda_t == 0.0) continue;
        const Vec2 p = pose_a * point.position, impulse = point.lambda_n * n + point.lambda_t * t;
        loads.add(pair.a, -impulse, -cross(p - pose_a.position, impulse));
        loads.add(pair.b, impulse, cross(p - x_b, impulse));
      }
      const double rolling = rollingImpulse(state, contact);
      if (rolling == 0.0) continue;
      loads.add(pair.a, Vec2::Zero(), -rolling);
      loads.add(pair.b, Vec2::Zero(), rolling);
    }
  }
}

/// On a body of mass and inertia 1 an impulse is a change of velocity.
void addJoints(const State& state, OuterLoads& loads) {
  for (const std::uint32_t i : state.joint_lists.present) {
    const Joint& joint = state.joints[i];
    if (!holds(state, joint) || isInside(state, joint)) continue;
    if (!state.isAwakeMember(joint.a) && (joint.to_world || !state.isAwakeMember(joint.b)))
      continue;
    const Vec2 x_a = state.pose(joint.a).position;
    const Vec2 x_b = joint.to_world ? Vec2(Vec2::Zero()) : state.pose(joint.b).position;
    SolverVelocity a{.inv_mass = 1.0, .inv_inertia = 1.0}, b = a;
    JointBlock k = makeJointBlock(state, joint, placeOf(state, joint, {}, x_a, x_b),
                                  JointRows::Removing, a, b);
    k.lambda = joint.lambda;
    applyJointImpulses(k, {}, a, b);
    loads.add(joint.a, {a.vx, a.vy}, a.omega);
    if (!joint.to_world) loads.add(joint.b, {b.vx, b.vy}, b.omega);
  }
}

}  // namespace

void listOuterLoads(const State& state, Scratch& scratch) {
  OuterLoads loads(state, scratch);
  for (const Load& load : scratch.loads) {
    loads.add(load.body, state.h * load.force, state.h * load.torque);
  }
  for (const Kick& kick : scratch.kicks) {
    loads.add(kick.body, kick.impulse,
              cross(kick.at - state.pose(kick.body).position, kick.impulse));
  }
  addContacts(state, scratch, loads);
  addJoints(state, loads);
  loads.finish();
}

namespace {

/// The velocity that a frame will have at the end of this step, at its centre.
struct FrameMotion {
  Vec2 v = Vec2::Zero();
  double omega = 0.0;
};

FrameMotion motionAfter(const State& state, const Collection& c, std::span<const OuterLoad> outer) {
  const Rigid& r = state[c.rigid];
  if (!r.floating()) {
    if (r.anchor == kWorldFrame) return {};
    const Rigid& anchor = state[rigidOf(c.anchor)];
    return {anchor.v, anchor.omega};
  }
  Vec2 p = Vec2::Zero();
  double l = 0.0;
  for (const OuterLoad& load : outer) {
    const Vec2 arm = r.rotation * (state[c.members[load.member]].local - r.center);
    p += load.impulse;
    l += load.moment + cross(arm, load.impulse);
  }
  return {r.v + state.h * state.gravity + r.inv_mass * p, r.omega + r.inv_inertia * l};
}

}  // namespace

Twist gainOf(const State& state, const Collection& c, const CollectionLoad& load,
             const OuterLoad& outer) {
  const Body& body = state[c.members[outer.member]];
  const Vec2 v = load.back * outer.impulse / body.mass;
  return {v.x(), v.y(), outer.moment / body.inertia * load.size};
}

CollectionLoad loadOn(const State& state, const Scratch& scratch, const Collection& c) {
  const auto slot = static_cast<std::uint32_t>(state.collections.slotOf(c));
  const auto& all = scratch.outer_loads;
  const auto first = std::ranges::lower_bound(all, slot, {}, &OuterLoad::slot);
  const auto last = std::ranges::upper_bound(all, slot, {}, &OuterLoad::slot);
  const Rigid& r = state[c.rigid];
  const OrientedBox& box = state.extent(r).box;
  CollectionLoad load;
  load.outer = std::span(all).subspan(static_cast<std::size_t>(first - all.begin()),
                                      static_cast<std::size_t>(last - first));
  load.back = r.rotation.inverse();
  load.size = sizeOf(state, c);
  const FrameMotion after = motionAfter(state, c, load.outer);
  // v(x) = v + ω × (x − c) of both, the earlier one with the rotation before the last step.
  const Rotation turn = load.back * r.previous_rotation;
  const double along = -r.omega * turn.s, across = r.omega * turn.c - after.omega;
  const Vec2 arm = box.frame.position - r.center;
  const Vec2 d = load.back * Vec2(r.v + state.h * state.gravity - after.v) + along * arm +
                 across * perpendicular(arm);
  load.frame = {d.x(), d.y(), along * load.size, across * load.size,
                (r.omega - after.omega) * load.size};
  double square = 0.0;
  for (const double q : load.frame) square += q * q;
  load.norm = std::sqrt(square);
  double outer = 0.0;
  for (const OuterLoad& o : load.outer) {
    if (c.members[o.member] == c.certificate.front().heaviest) continue;
    const Twist gain = gainOf(state, c, load, o);
    outer += gain.vx * gain.vx + gain.vy * gain.vy + gain.omega * gain.omega;
  }
  load.outer_norm = std::sqrt(outer);
  return load;
}

double sizeOf(const State& state, const Collection& c) {
  return static_cast<double>(static_cast<float>(state.extent(c.rigid).box.half.norm()));
}

Twist velocityAt(const State& state, const Collection& c, const FrameLoad& load,
                 const Vec2& local) {
  const OrientedBox& box = state.extent(c.rigid).box;
  const double size = sizeOf(state, c), along = load[2] / size, across = load[3] / size;
  const Vec2 arm = local - box.frame.position;
  return {load[0] + along * arm.x() - across * arm.y(),
          load[1] + along * arm.y() + across * arm.x(), load[4] / size};
}

Twist memberGain(const State& state, const Collection& c, const CollectionLoad& load,
                 const OuterLoad& outer) {
  const Twist u = velocityAt(state, c, load.frame, state[c.members[outer.member]].local);
  const Twist gain = gainOf(state, c, load, outer);
  return {u.vx + gain.vx, u.vy + gain.vy, u.omega + gain.omega / load.size};
}

void loadMembers(const State& state, const Collection& c, const CollectionLoad& load,
                 std::vector<Twist>& out) {
  out.resize(c.members.size());
  for (std::uint32_t m = 0; m < out.size(); ++m) {
    out[m] = velocityAt(state, c, load.frame, state[c.members[m]].local);
  }
  for (const OuterLoad& o : load.outer) out[o.member] = memberGain(state, c, load, o);
}

}  // namespace merge2d
