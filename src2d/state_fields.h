#pragma once
/// The fields of a saved state: every member of everything that lives across time steps. Each list
/// names all members of its struct, so that a new one is a compile error here, not a run that
/// continues differently.

#include <concepts>
#include <type_traits>

#include "src2d/dynamics/forces.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// T or const T: an archive writes the one and reads the other.
template <class T, class U>
concept Some = std::same_as<std::remove_const_t<T>, U>;

template <class Ar>
void fields(Ar& ar, Some<Rotation> auto& r) {
  auto& [c, s] = r;
  ar(c, s);
}
template <class Ar>
void fields(Ar& ar, Some<Pose> auto& p) {
  auto& [position, rotation] = p;
  ar(position, rotation);
}
template <class Ar>
void fields(Ar& ar, Some<Aabb> auto& box) {
  auto& [lower, upper] = box;
  ar(lower, upper);
}
template <class Ar>
void fields(Ar& ar, Some<OrientedBox> auto& box) {
  auto& [frame, half] = box;
  ar(frame, half);
}
template <class Ar>
void fields(Ar& ar, Some<Twist> auto& t) {
  auto& [vx, vy, omega] = t;
  ar(vx, vy, omega);
}
/// Of the leaf only whether there is one: the tree is built anew.
template <class Ar>
void fields(Ar& ar, Some<Extent> auto& e) {
  auto& [bounds, box] = e;
  ar(bounds, box);
}
template <class Ar>
void fields(Ar& ar, Some<Rigid> auto& r) {
  auto& [x, rest, center, v, omega, angle, rotation, previous_rotation, mass, inertia, inv_mass,
         inv_inertia, extent, anchor, leaf, slow_steps, quiet_steps, asleep, resized, member] = r;
  bool present = r.present();
  ar(x, rest, center, v, omega, angle, rotation, previous_rotation, mass, inertia, inv_mass,
     inv_inertia, extent, anchor, present, slow_steps, quiet_steps, asleep, resized, member);
  if constexpr (!std::is_const_v<std::remove_reference_t<decltype(r)>>) leaf = present ? 0 : -1;
}
template <class Ar>
void fields(Ar& ar, Some<Body> auto& b) {
  auto& [first_shape, shape_count, rigid, motion, alive, magnet_on, mass, inertia, friction,
         restitution, rolling, surface_velocity, local_angle, local, local_rotation, load,
         steady_load] = b;
  ar(first_shape, shape_count, rigid, motion, alive, magnet_on, mass, inertia, friction,
     restitution, rolling, surface_velocity, local_angle, local, local_rotation, load, steady_load);
}

template <class Ar>
void fields(Ar& ar, Some<ContactKey> auto& k) {
  auto& [a, b, shape_a, shape_b] = k;
  ar(a, b, shape_a, shape_b);
}
template <class Ar>
void fields(Ar& ar, Some<ContactPoint> auto& p) {
  auto& [position, gap, breath, feature, fresh, struck, lambda_n, lambda_t, w_n, w_t] = p;
  ar(position, gap, breath, feature, fresh, struck, lambda_n, lambda_t, w_n, w_t);
}
template <class Ar>
void fields(Ar& ar, Some<Contact> auto& c) {
  auto& [key, normal, count, quiet_steps, parting, borne, points, faces] = c;  // sought anew
  ar(key, normal, count, quiet_steps, parting, borne, points);
}
template <class Ar>
void fields(Ar& ar, Some<IdlePair> auto& p) {
  auto& [key, apart] = p;  // found anew: it depends on when a contact became idle
  ar(key);
}
template <class Ar>
void fields(Ar& ar, Some<ContactTable> auto& t) {
  auto& [slots, free_slots, order, idle, parked, parked_idle] = t;  // nothing is parked
  ar(slots, free_slots, order, idle);
}
template <class Ar>
void fields(Ar& ar, Some<NearPair> auto& p) {
  auto& [a, b, corners, way, fresh] = p;  // the way is found anew
  ar(a, b, corners, fresh);
}

template <class Ar>
void fields(Ar& ar, Some<ContactBlock> auto& k) {
  auto& [a, b, count, bilateral, hits, nx, ny, arm_an, arm_bn, arm_at, arm_bt, k11, k12, k22,
         inv_det, inv_kt, softness, bias, mu, lambda] = k;
  ar(a, b, count, bilateral, hits, nx, ny, arm_an, arm_bn, arm_at, arm_bt, k11, k12, k22, inv_det,
     inv_kt, softness, bias, mu, lambda);
}
template <class Ar>
void fields(Ar& ar, Some<JointRow> auto& r) {
  auto& [dx, dy, arm_a, arm_b, bias, softness, inv_k, lower, upper] = r;
  ar(dx, dy, arm_a, arm_b, bias, softness, inv_k, lower, upper);
}
template <class Ar>
void fields(Ar& ar, Some<JointBlock> auto& k) {
  auto& [a, b, joint, coupled, motor, limit, rows, inverse, lambda] = k;
  ar(a, b, joint, coupled, motor, limit, rows, inverse, lambda);
}
template <class Ar>
void fields(Ar& ar, Some<JointDesc::Limits> auto& l) {
  auto& [lower, upper] = l;
  ar(lower, upper);
}
template <class Ar>
void fields(Ar& ar, Some<JointDesc::Motor> auto& m) {
  auto& [speed, strength] = m;
  ar(speed, strength);
}
template <class Ar>
void fields(Ar& ar, Some<Joint> auto& j) {
  auto& [kind, a, b, to_world, anchor_a, anchor_b, axis, reference, length, stiffness, damping,
         compliance, limits, motor, break_force, break_torque, collide, broken, lambda, error,
         breath, quiet_steps, yielded] = j;
  ar(kind, a, b, to_world, anchor_a, anchor_b, axis, reference, length, stiffness, damping,
     compliance, limits, motor, break_force, break_torque, collide, broken, lambda, error, breath,
     quiet_steps, yielded);
}

template <class Ar>
void fields(Ar& ar, Some<InternalPoint> auto& p) {
  auto& [position, lambda_n, lambda_t] = p;
  ar(position, lambda_n, lambda_t);
}
template <class Ar>
void fields(Ar& ar, Some<PointWatch> auto& w) {
  auto& [active, lost] = w;
  ar(active, lost);
}
template <class Ar>
void fields(Ar& ar, Some<InternalContact> auto& c) {
  auto& [since, weld, count, watch, block, feature, key, normal, points, gap] = c;
  ar(since, weld, count, watch, block, feature, key, normal, points, gap);
}
template <class Ar>
void fields(Ar& ar, Some<Weld> auto& w) {
  auto& [a, b, first, count, node_a, node_b, motion, moving, joints, expected, cut, reason] = w;
  ar(a, b, first, count, node_a, node_b, motion, moving, joints, expected, cut, reason);
}
template <class Ar>
void fields(Ar& ar, Some<IndexRuns> auto& r) {
  auto& [numbers] = r;
  ar(numbers);
}
template <class Ar>
void fields(Ar& ar, Some<Witness> auto& w) {
  auto& [frame, outer, lambda, motion] = w;
  ar(frame, outer, lambda, motion);
}
template <class Ar>
void fields(Ar& ar, Some<NncgBuffers> auto& m) {
  auto& [before, direction, u_before, u_direction, previous] = m;
  ar(before, direction, u_before, u_direction, previous);
}
template <class Ar>
void fields(Ar& ar, Some<Bound> auto& b) {
  auto& [exists, gap, slack, d_gap, d_slack] = b;
  ar(exists, gap, slack, d_gap, d_slack);
}
template <class Ar>
void fields(Ar& ar, Some<BoundedImpulse> auto& b) {
  auto& [x, error, rhs, low, high] = b;
  ar(x, error, rhs, low, high);
}
template <class Ar>
void fields(Ar& ar, Some<NewtonIterate> auto& n) {
  auto& [unknowns, u, exact, steps] = n;
  ar(unknowns, u, exact, steps);
}
template <class Ar>
void fields(Ar& ar, Some<ProofSearch> auto& s) {
  auto& [load, start, nncg, newton, movers, way, steps, ahead] = s;
  ar(load, start, nncg, newton, movers, way, steps, ahead);
}
template <class Ar>
void fields(Ar& ar, Some<LoadCertificate> auto& c) {
  auto& [columns, witnesses, inherited, gram, weights, heaviest, lambda_stale, in_doubt, since,
         last_doubt, search] = c;
  ar(columns, witnesses, inherited, gram, weights, heaviest, lambda_stale, in_doubt, since,
     last_doubt, search);
}
template <class Ar>
void fields(Ar& ar, Some<HitRun> auto& run) {
  auto& [blow, met, first, last] = run;
  ar(blow, met, first, last);
}
template <class Ar>
void fields(Ar& ar, Some<InnerPush> auto& p) {
  auto& [of, unbalanced, frame, tolerance, fastest] = p;
  ar(of, unbalanced, frame, tolerance, fastest);
}
template <class Ar>
void fields(Ar& ar, Some<LaidOut> auto& l) {
  auto& [members, sorted_welds, active_blocks, points] = l;
  ar(members, sorted_welds, active_blocks, points);
}

template <class Ar>
void fields(Ar& ar, Some<Collection> auto& c) {
  auto& [id, rigid, anchor, members, contacts, blocks, block_contact, laid_out, stale, welds,
         welds_of, joints, push, residual, settled, hits, certificate] = c;
  ar(id, rigid, anchor, members, contacts, blocks, block_contact, laid_out, stale, welds, welds_of,
     joints, push, residual, settled, hits, certificate);
}

template <class Ar>
void fields(Ar& ar, Some<BodyPair> auto& p) {
  auto& [a, b, first, count] = p;
  ar(a, b, first, count);
}
template <class Ar>
void fields(Ar& ar, Some<ReadyPair> auto& r) {
  auto& [pair, node_a, node_b, contacts, joint_at] = r;
  ar(pair, node_a, node_b, contacts, joint_at);
}

/// The variables of a state in which nothing is parked; constants come from the scene, trees are
/// built anew.
template <class Ar>
void fields(Ar& ar, Some<State> auto& state) {
  auto& [settings, mode, h, gravity, colliders, collider_bounds, shape_collider, shape_body,
         first_sibling, siblings, step, time, paced_step, paced_time, bodies, rigids, present,
         extents, collections, next_collection, used_slots, contacts, joints, joined_pairs,
         joint_lists, broadphase, moved, ready_before, parked] = state;
  ar(h, step, time, paced_step, paced_time, bodies, rigids, present.ids(), extents,
     collections.all(), next_collection, contacts, joints, joined_pairs, broadphase.near, moved,
     ready_before);
}

template <class Ar>
void fields(Ar& ar, Some<Kick> auto& k) {
  auto& [body, at, impulse] = k;
  ar(body, at, impulse);
}
template <class Ar>
void fields(Ar& ar, Some<Load> auto& l) {
  auto& [body, force, torque] = l;
  ar(body, force, torque);
}
template <class Ar>
void fields(Ar& ar, Some<TimedSpring> auto& s) {
  auto& [body, anchor, to, to_body, stiffness, damping, rest_length, removed] = s;
  ar(body, anchor, to, to_body, stiffness, damping, rest_length, removed);
}
template <class Ar>
void fields(Ar& ar, Some<Actions::Launch> auto& l) {
  auto& [body, time, v, omega, done] = l;
  ar(body, time, v, omega, done);
}
template <class Ar>
void fields(Ar& ar, Some<Actions> auto& actions) {
  auto& [springs, forces, impulses, magnets, emissions, next_impulse, next_emission, scripts,
         user_kicks, user_loads, loaded, stirred, launches, timetable] = actions;
  ar(springs, next_impulse, next_emission, user_kicks, user_loads, loaded, stirred, launches);
  if constexpr (!std::is_const_v<std::remove_reference_t<decltype(actions)>>) timetable = {};
}

template <class Ar>
void fields(Ar& ar, Some<Circle> auto& c) {
  auto& [center, radius] = c;
  ar(center, radius);
}
template <class Ar>
void fields(Ar& ar, Some<Polygon> auto& p) {
  auto& [vertices] = p;
  ar(vertices);
}
/// Of a body that was added while the world ran. Such a body has no script.
template <class Ar>
void fields(Ar& ar, Some<BodyDesc> auto& b) {
  auto& [name, motion, at, angle, velocity, spin, shapes, mass, density, friction, restitution,
         rolling, surface_velocity, pinned_until, script] = b;
  ar(name, motion, at, angle, velocity, spin, shapes, mass, density, friction, restitution, rolling,
     surface_velocity, pinned_until);
}

}  // namespace merge2d
