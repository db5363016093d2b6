#include "src2d/merging/warm_start.h"

#include <algorithm>

#include "src2d/collections/collection.h"
#include "src2d/collections/inner_push.h"
#include "src2d/collections/joint_sweep.h"
#include "src2d/core/memory.h"
#include "src2d/dynamics/hits.h"
#include "src2d/dynamics/solver.h"
#include "src2d/merging/rule.h"
#include "src2d/merging/sweep.h"

namespace merge2d {
namespace {

/// The velocity of each member in its collection, with last step's push.
void startMembers(const State& state, Collection& c, Scratch& scratch) {
  layOutPush(state, c);
  const Rigid& r = state[c.rigid];
  for (std::size_t i = 0; i < c.members.size(); ++i) {
    const Body& body = state[c.members[i]];
    const Vec2 arm = r.rotation * (body.local - r.center);
    const Twist& push = c.push.of[i];
    const Vec2 pushed = r.rotation * Vec2(push.vx, push.vy);
    SolverVelocity& u = scratch.sweep_u[index(c.members[i])];
    u.vx = r.v.x() - r.omega * arm.y() + state.h * state.gravity.x() + pushed.x();
    u.vy = r.v.y() + r.omega * arm.x() + state.h * state.gravity.y() + pushed.y();
    u.omega = r.omega + push.omega;
    u.inv_mass = 1.0 / body.mass;
    u.inv_inertia = 1.0 / body.inertia;
  }
}

/// Free bodies, and those that do not respond to forces.
void startOthers(const State& state, Scratch& scratch) {
  for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
    const BodyId b{i};
    if (state.isMember(b) || !state[b].alive) continue;
    const Rigid& r = state[rigidOf(b)];
    const bool free = r.floating() && !r.asleep;
    SolverVelocity& u = scratch.sweep_u[i];
    u = {r.v.x(), r.v.y(), r.omega, free ? r.inv_mass : 0.0, free ? r.inv_inertia : 0.0};
    u.surface = state[b].surface_velocity;
    if (!free) continue;
    u.vx += state.h * state.gravity.x();
    u.vy += state.h * state.gravity.y();
  }
}

void addLoads(const State& state, Scratch& scratch) {
  for (const Load& load : scratch.loads) {
    SolverVelocity& u = scratch.sweep_u[index(load.body)];
    u.vx += state.h * u.inv_mass * load.force.x();
    u.vy += state.h * u.inv_mass * load.force.y();
    u.omega += state.h * u.inv_inertia * load.torque;
  }
  for (const Kick& kick : scratch.kicks) {
    SolverVelocity& u = scratch.sweep_u[index(kick.body)];
    u.vx += u.inv_mass * kick.impulse.x();
    u.vy += u.inv_mass * kick.impulse.y();
    u.omega += u.inv_inertia * cross(kick.at - state.pose(kick.body).position, kick.impulse);
  }
}

Vec2 velocityAt(const SolverVelocity& u, const Vec2& arm) {
  return Vec2(u.vx, u.vy) + cross(u.omega, arm);
}

/// The rows of a contact outside collections, with the bodies' own masses.
void addOuterContact(const State& state, ContactTable::Slot slot, Scratch& scratch) {
  const Contact& contact = state.contacts[slot];
  const BodyId a = contact.key.a, b = contact.key.b;
  const SolverVelocity &ua = scratch.sweep_u[index(a)], &ub = scratch.sweep_u[index(b)];
  if (ua.inv_mass == 0.0 && ub.inv_mass == 0.0) return;
  const Pose pose_a = state.pose(a);
  const Vec2 x_b = state.pose(b).position;
  const SolverSettings& settings = state.settings.solver;
  BlockGeometry g;
  g.normal = pose_a.rotation * contact.normal;
  g.count = contact.count;
  g.softness = contactSoftness(state, a, b, ua.inv_mass, ub.inv_mass);
  SweepContact outer{.slot = slot, .block = {}};
  ContactBlock& k = outer.block;
  k.bilateral = isHeld(state, contact);
  const bool followed = castToHit(state, scratch, contact) != nullptr;
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
    const Vec2 p = pose_a * point.position;
    g.arm_a[i] = p - pose_a.position;
    g.arm_b[i] = p - x_b;
    k.lambda_n(i) = point.lambda_n;
    k.lambda_t(i) = point.lambda_t;
    const double w = g.normal.dot(velocityAt(ub, g.arm_b[i]) - velocityAt(ua, g.arm_a[i]));
    k.bias[i] = k.bilateral ? bilateralBias(settings, state.h, point.gap, -w)
                            : contactBias(settings, state.h, point.gap);
    if (isBilateral(state, a, b) || point.gap + state.h * w >= 0.0) continue;
    const double e = restitutionOf(state, a, b);
    const bool hit = e > 0.0 ? -w > leastBounce(state, contact.key) : followed;
    if (hit) k.bias[i] = e * w;  // all of it comes in this step
  }
  k.a = static_cast<std::uint32_t>(a);
  k.b = static_cast<std::uint32_t>(b);
  k.mu = frictionOf(state, a, b);
  if (contact.count == 1) k.setRolling(rollingOf(state, a, b), rollingImpulse(state, contact));
  prepareBlock(k, g, ua, ub);
  scratch.sweep_contacts.push_back(outer);
}

/// The impulses of the last step of a contact that is not swept itself: a load on the bodies around
/// a collection.
void applyAsLoad(const State& state, const Contact& contact, std::vector<SolverVelocity>& u) {
  const Pose pose_a = state.pose(contact.key.a);
  const Vec2 x_b = state.pose(contact.key.b).position;
  const Vec2 n = pose_a.rotation * contact.normal, t = perpendicular(n);
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
    const Vec2 p = pose_a * point.position, impulse = point.lambda_n * n + point.lambda_t * t;
    const auto push = [&](BodyId b, const Vec2& arm, double sign) {
      SolverVelocity& v = u[index(b)];
      v.vx += sign * v.inv_mass * impulse.x();
      v.vy += sign * v.inv_mass * impulse.y();
      v.omega += sign * v.inv_inertia * cross(arm, impulse);
    };
    push(contact.key.a, p - pose_a.position, -1.0);
    push(contact.key.b, p - x_b, 1.0);
  }
  const double rolling = rollingImpulse(state, contact);
  if (rolling == 0.0) return;
  applyRolling(rolling, u[index(contact.key.a)], u[index(contact.key.b)]);
}

/// Contacts between bodies that are awake get rows; at one that sleeps a contact keeps pushing with
/// the impulses of the last step.
void warmStartOuter(const State& state, Scratch& scratch) {
  scratch.sweep_contacts.clear();
  scratch.near_collection.assign(state.bodies.size(), 0);
  const auto asleep = [&](BodyId b) { return state.rigid(b).asleep; };
  for (const BodyPair& pair : scratch.pairs) {
    const bool has_rows = !asleep(pair.a) && !asleep(pair.b);
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      const ContactTable::Slot slot = state.contacts.order[i];
      if (state.contacts[slot].count == 0) continue;
      if (!has_rows) {
        applyAsLoad(state, state.contacts[slot], scratch.sweep_u);
        continue;
      }
      for (const BodyId b : {pair.a, pair.b}) scratch.near_collection[index(b)] = 1;
      addOuterContact(state, slot, scratch);
    }
  }
  trim(scratch.sweep_contacts);
  if (!state.joints.empty()) listSweepJoints(state, scratch);
  for (const SweepContact& outer : scratch.sweep_contacts) {
    const ContactBlock& k = outer.block;
    applyImpulses(k, scratch.sweep_u[k.a], scratch.sweep_u[k.b]);
  }
  if (!state.joints.empty()) warmStartSweepJoints(state, scratch);
}

}  // namespace

void warmStart(State& state, Scratch& scratch) { unmergingMethod(state).warmStart(state, scratch); }

void warmStartSweep(State& state, Scratch& scratch) {
  scratch.sweep_contacts.clear();
  scratch.sweep_joints.clear();
  const auto swept = [&](const Collection& c) { return isSwept(state, c); };
  scratch.sweeping = std::ranges::any_of(state.collections, swept);
  if (!scratch.sweeping) return;
  scratch.last_sweep = state.step;
  scratch.sweep_u.resize(state.bodies.size() + 1);  // the world's stands last
  scratch.sweep_u.back() = {};
  scratch.swept.assign(state.bodies.size() + 1, 1);
  startOthers(state, scratch);
  for (Collection& c : state.collections) {
    if (swept(c)) startMembers(state, c, scratch);
  }
  addLoads(state, scratch);
  warmStartOuter(state, scratch);
}

}  // namespace merge2d
