#pragma once
/// Everything that lives across time steps, in flat tables ordered by id.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "src2d/dynamics/collection_table.h"
#include "src2d/dynamics/contact_table.h"
#include "src2d/dynamics/joint_lists.h"
#include "src2d/dynamics/parked.h"
#include "src2d/dynamics/rigid.h"
#include "src2d/dynamics/scratch.h"
#include "src2d/dynamics/sorted_list.h"
#include "src2d/geometry/collide.h"
#include "src2d/geometry/tree.h"

namespace merge2d {

struct Broadphase {
  AabbTree tree;  ///< one leaf per rigid thing that is simulated as its own
  std::vector<std::unique_ptr<AabbTree>> shape_trees;  ///< per rigid, where it has several shapes
  std::vector<int> shape_leaves;                       ///< per shape, in its rigid's tree, or −1
  std::vector<NearPair> near;                          ///< ascending
  ParkedPairs<NearPair> parked_near;                   ///< those of parked things
};

struct TimedSpring {
  BodyIndex body = 0;
  Vec2 anchor = Vec2::Zero();  ///< from the centre of mass, in the body frame
  Vec2 to = Vec2::Zero();      ///< world, or the same in `to_body`
  std::int64_t to_body = -1;
  double stiffness = 0.0, damping = 0.0, rest_length = 0.0;
  bool removed = false;
};

/// The state of a world between two steps.
struct State {
  // constant
  Settings settings;
  Mode mode = Mode::MergeSleep;
  double h = 0.01;  ///< [s]
  Vec2 gravity{0.0, -9.81};
  std::vector<Collider> colliders;            ///< the different shapes, in the body frame
  std::vector<Aabb> collider_bounds;          ///< in the body frame
  std::vector<std::uint32_t> shape_collider;  ///< per shape of a body: which of them it is
  std::vector<BodyId> shape_body;             ///< per shape: whose it is
  std::vector<std::uint32_t> first_sibling;   ///< per shape: its run of `siblings`, and the end
  std::vector<std::uint32_t> siblings;        ///< shapes of the same body that touch it

  // what moves
  std::int64_t step = 0;
  double time = 0.0;
  std::int64_t paced_step = 0;  ///< after which h last changed
  double paced_time = 0.0;      ///< of that step [s]
  std::vector<Body> bodies;
  std::vector<Rigid> rigids;         ///< bodies, then collections
  SortedList<RigidId> present;       ///< in B, or asleep but not parked; ascending
  std::vector<Extent> extents;       ///< of the different bodies, then one per collection
  CollectionTable collections;       ///< slot i is rigid bodies.size() + i
  std::int32_t next_collection = 1;  ///< people read it as a name: C1 is the first of a run
  std::size_t used_slots = 0;  ///< of `collections`: at least this many at its start are in use
  ContactTable contacts;
  std::vector<Joint> joints;
  std::vector<std::pair<BodyId, BodyId>> joined_pairs;  ///< do not collide; ascending
  JointLists joint_lists;                               ///< follow from `joints`, and from `parked`
  Broadphase broadphase;
  double moved = 0.0;  ///< by the fastest point of all in the last step, at most [m]
  std::vector<ReadyPair> ready_before;  ///< in the last step; those still there were not welded
  Parked parked;

  const Collider& collider(std::uint32_t shape) const { return colliders[shape_collider[shape]]; }
  const Aabb& bounds(std::uint32_t shape) const { return collider_bounds[shape_collider[shape]]; }

  Body& operator[](BodyId id) { return bodies[index(id)]; }
  const Body& operator[](BodyId id) const { return bodies[index(id)]; }
  Rigid& operator[](RigidId id) { return rigids[index(id)]; }
  const Rigid& operator[](RigidId id) const { return rigids[index(id)]; }
  const Extent& extent(RigidId id) const { return extents[rigids[index(id)].extent]; }
  const Extent& extent(const Rigid& r) const { return extents[r.extent]; }
  /// The rigid thing that a body moves with: itself or its collection.
  Rigid& rigid(BodyId id) { return rigids[index(bodies[index(id)].rigid)]; }
  const Rigid& rigid(BodyId id) const { return rigids[index(bodies[index(id)].rigid)]; }
  bool isCollection(RigidId id) const { return index(id) >= bodies.size(); }
  /// In a collection.
  bool isMember(BodyId id) const { return isCollection(bodies[index(id)].rigid); }
  bool isAwakeMember(BodyId id) const { return isMember(id) && !rigid(id).asleep; }
  Collection& collection(RigidId id) { return collections[index(id) - bodies.size()]; }
  const Collection& collection(RigidId id) const { return collections[index(id) - bodies.size()]; }
  /// The body that names a rigid thing: its own, or the first member.
  BodyId firstBody(RigidId id) const {
    return isCollection(id) ? collection(id).members.front()
                            : BodyId{static_cast<std::uint32_t>(id)};
  }

  /// True for a body that forces move, also inside a collection: neither pinned nor scripted.
  bool responds(BodyId id) const { return rigid(id).floating() || isMember(id); }

  /// Of the boxes around two shapes the least extent [m].
  double thickness(std::uint32_t shape_a, std::uint32_t shape_b) const {
    return std::min(bounds(shape_a).extent().minCoeff(), bounds(shape_b).extent().minCoeff());
  }

  Pose pose(BodyId id) const {
    const Body& body = bodies[index(id)];
    const Rigid& r = rigids[index(body.rigid)];
    if (body.rigid == rigidOf(id)) return {r.x, r.rotation};
    return r.frame() * Pose{body.local, body.local_rotation};
  }
  double angle(BodyId id) const {
    const Body& body = bodies[index(id)];
    const double own = rigids[index(body.rigid)].angle;
    return body.rigid == rigidOf(id) ? own : own + body.local_angle;
  }
};

/// The rigid thing that a body moves with in the full solve: itself, where its collection is open.
inline RigidId moverOf(const State& state, const Scratch& scratch, BodyId b) {
  const bool open = !scratch.open.empty() && scratch.open[index(b)] != 0;
  return open ? rigidOf(b) : state[b].rigid;
}

/// A body with its own masses, as the rows inside a collection see a member.
inline SolverVelocity memberVelocity(const State& state, BodyId b, const Twist& u = {}) {
  return {u.vx, u.vy, u.omega, 1.0 / state[b].mass, 1.0 / state[b].inertia};
}
/// Without velocity; a body of the collection's frame does not respond, nor does the world.
inline SolverVelocity memberMasses(const State& state, const Collection& c, std::uint32_t body) {
  const bool is_member = body < state.bodies.size() && state.bodies[body].rigid == c.rigid;
  return is_member ? memberVelocity(state, BodyId{body}) : SolverVelocity{};
}

/// Per body 1 where it is one of these, else 0.
inline std::vector<std::uint8_t> namedAmong(const State& state, const std::vector<BodyId>& bodies) {
  std::vector<std::uint8_t> is_named(state.bodies.size(), 0);
  for (const BodyId b : bodies) is_named[index(b)] = 1;
  return is_named;
}

/// The mixing rules of two bodies: friction by the geometric mean, restitution by the larger.
inline double frictionOf(const State& state, BodyId a, BodyId b) {
  return std::sqrt(state[a].friction * state[b].friction);
}
inline double restitutionOf(const State& state, BodyId a, BodyId b) {
  return std::max(state[a].restitution, state[b].restitution);
}

/// Rolling resistance by the longer lever arm.
inline double rollingOf(const State& state, BodyId a, BodyId b) {
  return std::max(state[a].rolling, state[b].rolling);
}
/// The impulse that resists the rolling of a contact; it stands in the place of a second point
/// [N m s].
inline double rollingImpulse(const State& state, const Contact& contact) {
  if (contact.count != 1) return 0.0;
  const double arm = rollingOf(state, contact.key.a, contact.key.b);
  const double limit = arm * std::max(0.0, contact.points[0].lambda_n);
  return std::clamp(contact.points[1].lambda_t, -limit, limit);
}

/// A body with a belt merges with nothing: contacts inside a collection do not slide.
inline bool hasBelt(const State& state, BodyId a, BodyId b) {
  return state[a].surface_velocity != 0.0 || state[b].surface_velocity != 0.0;
}

/// Contacts of a magnet that is on pull too, and do not slide.
inline bool isBilateral(const State& state, BodyId a, BodyId b) {
  return state[a].magnet_on || state[b].magnet_on;
}
/// Only those with a point within the margin do so: contacts of fast bodies are found farther away,
/// where a magnet does not act. Guarded by Magnet.LeavesWhatFliesPastAlone.
inline bool isHeld(const State& state, const Contact& contact) {
  if (!isBilateral(state, contact.key.a, contact.key.b)) return false;
  const auto last = contact.points.begin() + contact.count;
  return std::any_of(contact.points.begin(), last, [&](const ContactPoint& point) {
    return point.gap <= state.settings.solver.margin;
  });
}

}  // namespace merge2d
