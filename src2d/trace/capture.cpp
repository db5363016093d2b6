#include "src2d/trace/capture.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "src2d/dynamics/spring_forces.h"

namespace merge2d {
namespace {

ContactState stateOf(double lambda_n, double lambda_t, double mu, bool bilateral) {
  if (bilateral) return ContactState::Sticking;
  if (lambda_n <= 0.0) return ContactState::Broken;
  return std::abs(lambda_t) >= (1.0 - 1e-9) * mu * lambda_n ? ContactState::Sliding
                                                            : ContactState::Sticking;
}

Vec2 velocityOf(const State& state, BodyId b) {
  return state.rigid(b).velocityAt(state.pose(b).position);
}

void captureBodies(const State& state, Snapshot& out) {
  out.bodies.clear();
  for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
    const BodyId id{i};
    const Body& body = state[id];
    if (!body.alive) continue;
    const Rigid& r = state.rigid(id);
    BodyState seen;
    seen.id = id;
    seen.x = body.rigid == rigidOf(id) ? r.exactCenter() : state.pose(id).position;
    seen.angle = state.angle(id);
    seen.v = velocityOf(state, id);
    seen.omega = r.omega;
    if (state.isCollection(body.rigid)) seen.collection = state.collection(body.rigid).id;
    seen.asleep = r.asleep;
    seen.pinned =
        !r.floating() && body.motion != Motion::Scripted && !state.isCollection(body.rigid);
    seen.magnet_on = body.magnet_on;
    out.bodies.push_back(seen);
  }
}

ContactView view(const State& state, const Contact& contact, const ContactPoint& p,
                 const Pose& frame) {
  ContactView seen;
  seen.a = contact.key.a;
  seen.b = contact.key.b;
  seen.feature = p.feature;
  seen.x = frame * p.position;
  seen.normal = frame.rotation * contact.normal;
  seen.gap = p.gap;
  seen.lambda_n = p.lambda_n + p.struck;
  seen.lambda_t = p.lambda_t;
  seen.w_n = p.w_n;
  seen.w_t = p.w_t;
  seen.mu = frictionOf(state, contact.key.a, contact.key.b);
  seen.state = stateOf(seen.lambda_n, p.lambda_t, seen.mu, isHeld(state, contact));
  seen.fresh = p.fresh;
  return seen;
}

/// Velocity at a point inside a collection: what the last sweep left, or the full solve for one
/// that became internal after it; asleep nothing moves.
void showInternalVelocity(const State& state, const Scratch& scratch, const Collection& c,
                          std::size_t block, int i, ContactPoint& p) {
  const Rigid& r = state[c.rigid];
  const ContactBlock& k = c.blocks[block];
  const bool swept = scratch.last_sweep >= 0 && state.step - scratch.last_sweep <= 1;
  const bool was_inside = c.contacts[c.block_contact[block]].since < scratch.last_sweep;
  if (r.asleep || (swept && was_inside && !(scratch.swept[k.a] && scratch.swept[k.b]))) {
    p.w_n = p.w_t = 0.0F;
  } else if (swept && was_inside) {
    const bool step_is_over = state.step > scratch.last_sweep;
    const Rotation turn = step_is_over ? r.previous_rotation : r.rotation;
    const Vec2 n = turn * Vec2(k.nx, k.ny);
    const ContactVelocity w =
        contactVelocity(k, i, n.x(), n.y(), scratch.sweep_u[k.a], scratch.sweep_u[k.b]);
    p.w_n = static_cast<float>(w.n);
    p.w_t = static_cast<float>(w.t);
  }
}

/// By bodies and feature. Two points may lie in one place: then the rest tells them apart, −0 and 0
/// as well, so that no sorting algorithm has a choice.
bool comesBefore(const ContactView& x, const ContactView& y) {
  const auto names = [](const ContactView& c) { return std::tuple(c.a, c.b, c.feature); };
  if (names(x) != names(y)) return names(x) < names(y);
  const auto of = [](double number) { return std::pair(number, !std::signbit(number)); };
  const auto rest = [&](const ContactView& c) {
    return std::tuple(of(c.x.x()), of(c.x.y()), of(c.lambda_n), of(c.lambda_t), of(c.gap),
                      of(c.w_n), of(c.w_t), of(c.normal.x()), of(c.normal.y()), c.internal,
                      c.fresh);
  };
  return rest(x) < rest(y);
}

void captureContacts(const State& state, const Scratch& scratch, Snapshot& out) {
  out.contacts.clear();
  const auto show = [&](ContactTable::Slot slot) {
    const Contact& contact = state.contacts[slot];
    for (int i = 0; i < contact.count; ++i) {
      out.contacts.push_back(view(state, contact, contact.points[static_cast<std::size_t>(i)],
                                  state.pose(contact.key.a)));
    }
  };
  for (const ContactTable::Slot slot : state.contacts.order) show(slot);
  state.contacts.parked.forEach(show);
  for (const Collection& c : state.collections.all()) {
    if (c.id == kNoCollection) continue;
    const Pose frame = state[c.rigid].frame();
    const bool has_blocks = !c.blocks.empty();  // else nothing moves inside
    for (std::size_t b = 0; b < c.block_contact.size(); ++b) {
      const Contact contact = c.contacts[c.block_contact[b]].released();
      for (int i = 0; i < contact.count; ++i) {
        ContactPoint p = contact.points[static_cast<std::size_t>(i)];
        p.fresh = false;
        const Impulses lambda = c.impulsesOf(b);
        p.lambda_n = lambda[static_cast<std::size_t>(i)];
        p.lambda_t = lambda[static_cast<std::size_t>(i) + 2];
        if (has_blocks) showInternalVelocity(state, scratch, c, b, i, p);
        out.contacts.push_back(view(state, contact, p, frame));
        out.contacts.back().internal = true;
      }
    }
  }
  std::ranges::sort(out.contacts, comesBefore);
}

/// Of an anchored collection centre and inertia are those of its members.
CollectionView view(const State& state, const Collection& c) {
  const Rigid& r = state[c.rigid];
  CollectionView seen;
  seen.id = c.id;
  seen.bodies = c.members;
  std::ranges::sort(seen.bodies);
  seen.anchored = !r.floating();
  seen.anchor = c.anchor;
  for (const BodyId b : c.members) {
    seen.mass += state[b].mass;
    seen.x += state[b].mass * state.pose(b).position;
  }
  seen.x /= seen.mass;
  for (const BodyId b : c.members) {
    seen.inertia +=
        state[b].inertia + state[b].mass * (state.pose(b).position - seen.x).squaredNorm();
  }
  seen.v = r.velocityAt(seen.x);
  seen.omega = r.omega;
  seen.box = state.extent(r).box;
  seen.box.frame = r.frame() * seen.box.frame;
  seen.asleep = r.asleep;
  return seen;
}

void captureCollections(const State& state, Snapshot& out) {
  out.collections.clear();
  for (const Collection& c : state.collections.all()) {
    if (c.id != kNoCollection) out.collections.push_back(view(state, c));
  }
  std::sort(out.collections.begin(), out.collections.end(),
            [](const CollectionView& x, const CollectionView& y) { return x.id < y.id; });
}

void captureWelds(const State& state, Snapshot& out) {
  out.welds.clear();
  for (const Collection& c : state.collections.all()) {
    if (c.id == kNoCollection) continue;
    for (const Weld& weld : c.welds) {
      if (weld.expected) continue;
      int contacts = 0;
      for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
        contacts += c.contacts[i].count;
      }
      out.welds.push_back({weld.a, weld.b, contacts});
    }
  }
  std::sort(out.welds.begin(), out.welds.end(), [](const WeldView& x, const WeldView& y) {
    return std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
}

void captureJoints(const State& state, Snapshot& out) {
  out.joints.clear();
  for (const Joint& joint : state.joints) {
    const Pose a = state.pose(joint.a);
    JointView seen;
    seen.kind = joint.kind;
    seen.a = joint.a;
    seen.b = joint.b;
    seen.to_world = joint.to_world;
    seen.from = a * joint.anchor_a;
    seen.to = joint.to_world ? joint.anchor_b : state.pose(joint.b) * joint.anchor_b;
    seen.axis = a.rotation * joint.axis;
    const JointForce load = jointForce(state, joint);
    seen.force = load.force;
    seen.torque = load.torque;
    seen.broken = joint.broken;
    seen.internal = holds(state, joint) && isInside(state, joint);
    out.joints.push_back(seen);
  }
}

double deepestOf(const Contact& contact) {
  double deepest = 0.0;
  for (int i = 0; i < contact.count; ++i) {
    deepest = std::max(deepest, -contact.points[static_cast<std::size_t>(i)].gap);
  }
  return deepest;
}

double deepestOf(const InternalContact& inner) {
  double deepest = 0.0;
  for (int i = 0; i < inner.count; ++i) {
    deepest = std::max(deepest, -inner.gap[static_cast<std::size_t>(i)]);
  }
  return deepest;
}

double deepestOfAll(const State& state) {
  double deepest = 0.0;
  const auto look = [&](ContactTable::Slot slot) {
    deepest = std::max(deepest, deepestOf(state.contacts[slot]));
  };
  for (const ContactTable::Slot slot : state.contacts.order) look(slot);
  state.contacts.parked.forEach(look);
  for (const Collection& c : state.collections.all()) {
    for (const InternalContact& inner : c.contacts) deepest = std::max(deepest, deepestOf(inner));
  }
  return deepest;
}

/// Momentum and energy of the bodies that respond to forces.
void measure(const State& state, const Actions& actions, const Snapshot& seen, Stats& stats) {
  stats.kinetic_energy = stats.potential_energy = stats.angular_momentum = 0.0;
  stats.momentum.setZero();
  for (const BodyState& b : seen.bodies) {
    if (state[rigidOf(b.id)].anchor != kFloating && !state.isMember(b.id)) continue;
    const Body& body = state[b.id];
    stats.kinetic_energy +=
        0.5 * (body.mass * b.v.squaredNorm() + body.inertia * b.omega * b.omega);
    stats.potential_energy -= body.mass * state.gravity.dot(b.x);
    stats.momentum += body.mass * b.v;
    stats.angular_momentum += body.inertia * b.omega + body.mass * cross(b.x, b.v);
  }
  stats.potential_energy += springEnergy(state, actions);
  stats.max_penetration = deepestOfAll(state);
}

}  // namespace

void captureState(const State& state, const Actions& actions, const Scratch& scratch,
                  Snapshot& out) {
  out.step = state.step;
  out.time = state.time;
  captureBodies(state, out);
  captureContacts(state, scratch, out);
  captureCollections(state, out);
  captureWelds(state, out);
  out.springs = scratch.springs;
  captureJoints(state, out);
  out.events = scratch.events;
  out.stats = scratch.stats;
  measure(state, actions, out, out.stats);
}

void captureMotion(const State& state, const Actions& actions, const Scratch& scratch,
                   Snapshot& out) {
  out.step = state.step;
  out.time = state.time;
  captureBodies(state, out);
  captureCollections(state, out);
  out.contacts.clear();
  out.welds.clear();
  out.joints.clear();
  out.springs = scratch.springs;
  out.events = scratch.events;
  out.stats = scratch.stats;
  measure(state, actions, out, out.stats);
}

double deepestOverlap(const State& state, const std::vector<Event>& events) {
  double deepest = 0.0;
  for (const ContactTable::Slot slot : state.contacts.order) {
    deepest = std::max(deepest, deepestOf(state.contacts[slot]));
  }
  std::vector<RigidId> grown;  // none in most steps
  for (const Event& event : events) {
    if (event.type != EventType::Merge) continue;
    for (const BodyId b : {event.a, event.b}) {
      if (state.isMember(b)) grown.push_back(state[b].rigid);
    }
  }
  std::ranges::sort(grown);
  grown.erase(std::unique(grown.begin(), grown.end()), grown.end());
  for (const RigidId id : grown) {
    for (const InternalContact& inner : state.collection(id).contacts) {
      deepest = std::max(deepest, deepestOf(inner));
    }
  }
  return deepest;
}

void countBodies(const State& state, Scratch& scratch) {
  Stats& stats = scratch.stats;
  stats.active_bodies = stats.internal_contacts = 0;
  stats.bodies = stats.asleep = state.parked.bodies;
  stats.collections = state.parked.collections;
  for (const RigidId id : state.present) {
    const Rigid& r = state[id];
    if (!state.isCollection(id)) {
      if (!r.floating()) continue;
      stats.bodies += 1;
      stats.asleep += r.asleep ? 1 : 0;
      stats.active_bodies += r.asleep ? 0 : 1;
    } else {
      const Collection& c = state.collection(id);
      const int members = static_cast<int>(c.members.size());
      stats.bodies += members;
      stats.collections += 1;
      stats.asleep += r.asleep ? members : 0;
      stats.active_bodies += r.asleep ? 0 : 1;
      stats.internal_contacts += r.asleep ? 0 : c.laid_out.points;
    }
  }
}

}  // namespace merge2d
