#pragma once
/// Everything that lives across time steps, in flat tables ordered by id, and what lives for one.

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <vector>

#include "src2d/core/ids.h"
#include "src2d/dynamics/contact_block.h"
#include "src2d/dynamics/islands.h"
#include "src2d/dynamics/joint.h"
#include "src2d/geometry/box.h"
#include "src2d/geometry/collide.h"
#include "src2d/geometry/tree.h"
#include "src2d/scene/scene.h"
#include "src2d/trace/notes.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

/// A rigid thing: body `i` is rigid `i`; collections follow after the last body.
enum class RigidId : std::uint32_t {};
constexpr std::size_t index(RigidId id) { return static_cast<std::size_t>(id); }
constexpr RigidId rigidOf(BodyId id) { return RigidId{static_cast<std::uint32_t>(id)}; }

/// Bodies that never move against each other share a frame: 0 is the world (all pinned bodies), a
/// scripted body has its own. `kFloating` means: responds to forces.
using FrameId = std::int32_t;
inline constexpr FrameId kFloating = -1;
inline constexpr FrameId kWorldFrame = 0;

/// One rigid thing. Its frame is fixed to the matter; for a collection the centre of mass moves in
/// it as members come and go.
struct Rigid {
  Vec2 x = Vec2::Zero();       ///< centre of mass (the frame's origin when not floating) [m]
  Vec2 rest = Vec2::Zero();    ///< of it, what is finer than the grid of positions [m]
  Vec2 center = Vec2::Zero();  ///< centre of mass in the frame [m]
  Vec2 v = Vec2::Zero();       ///< of the centre of mass [m/s]
  double omega = 0.0;          ///< [rad/s]
  double angle = 0.0;          ///< [rad]
  Rotation rotation;           ///< of `angle`
  Rotation previous_rotation;  ///< before the last position update
  double mass = 0.0, inertia = 0.0;
  double inv_mass = 0.0, inv_inertia = 0.0;  ///< 0 unless floating
  Aabb bounds;                               ///< in the frame [m]
  OrientedBox box;                           ///< in the frame [m]
  FrameId anchor = kFloating;                ///< the frame it is fixed to
  int leaf = -1;                             ///< in the broadphase; −1: not simulated as its own
  int quiet_steps = 0;                       ///< consecutive steps below the sleeping threshold
  bool asleep = false;
  bool resized = false;  ///< bounds changed since the broadphase last looked

  bool present() const { return leaf >= 0; }
  bool floating() const { return anchor == kFloating; }
  Vec2 exactCenter() const { return x + rest; }
  /// Moves the centre of mass. The part below the grid is kept for the next time, so that rounding
  /// never adds up.
  void moveBy(const Vec2& d) {
    const Vec2 way = rest + d, rounded = onGrid(way);
    x += rounded;
    rest = way - rounded;
  }
  Pose frame() const { return {x + onGrid(rest - rotation * center), rotation}; }
  Vec2 velocityAt(const Vec2& p) const { return v + cross(omega, p - x - rest); }
  /// The same where another's centre of mass is, to which no sum of a place and a rest is exact.
  Vec2 velocityAt(const Rigid& o) const { return v + cross(omega, (o.x - x) + (o.rest - rest)); }
};

/// A body's own constants, and where it is found now.
struct Body {
  std::uint32_t first_shape = 0, shape_count = 0;  ///< into State::shape_collider
  RigidId rigid{};                                 ///< itself, or its collection
  Motion motion = Motion::Dynamic;
  bool alive = true;  ///< false before its emission
  bool magnet_on = false;
  double mass = 0.0, inertia = 0.0;
  double friction = 0.0, restitution = 0.0;
  double pinned_until = 0.0;
  double local_angle = 0.0;  ///< pose in the collection's frame
  Vec2 local = Vec2::Zero();
  Rotation local_rotation;
  Vec2 load = Vec2::Zero();         ///< outer forces now [N]
  Vec2 load_asleep = Vec2::Zero();  ///< the same when it fell asleep
};

/// Identifies a pair of shapes; contacts are kept in this order.
struct ContactKey {
  BodyId a{}, b{};  ///< a < b
  std::uint32_t shape_a = 0, shape_b = 0;
  auto operator<=>(const ContactKey&) const = default;
};

/// What is remembered of a contact point while it lasts.
struct ContactPoint {
  Vec2 position = Vec2::Zero();  ///< in a's frame; inside a collection in the collection's [m]
  double gap = 0.0;              ///< [m]
  float breath = 0.0F;           ///< change of the gap since the last step [m]
  std::uint32_t feature = 0;
  bool fresh = false;                     ///< was not there, or carried nothing, in the last step
  float approach = 0.0F;                  ///< fastest approach while it was still open [m/s]
  double lambda_n = 0.0, lambda_t = 0.0;  ///< impulse of the last step [N s]
  float w_n = 0.0F, w_t = 0.0F;           ///< velocity after it [m/s]
};

/// The contact of two convex shapes: persistent over steps, at most two points.
struct Contact {
  ContactKey key;
  Vec2 normal = Vec2::UnitX();  ///< from a to b, in a's frame; inside a collection in its frame
  int count = 0;
  int quiet_steps = 0;  ///< consecutive steps in which the pair could have merged
  std::array<ContactPoint, 2> points;
};

/// A point of a contact in the table: twice its slot, plus which of the two it is.
using PointIndex = std::uint32_t;

/// Contacts between different rigid things: slots that stay in place, and their order by key.
struct ContactTable {
  struct Entry {
    ContactKey key;
    std::uint32_t slot = 0;
  };
  std::vector<Contact> slots;
  std::vector<std::uint32_t> free_slots;
  std::vector<Entry> order;

  Contact& operator[](const Entry& entry) { return slots[entry.slot]; }
  const Contact& operator[](const Entry& entry) const { return slots[entry.slot]; }

  const Contact& contactOf(PointIndex i) const { return slots[i / 2]; }
  ContactPoint& point(PointIndex i) { return slots[i / 2].points[i % 2]; }
  const ContactPoint& point(PointIndex i) const { return slots[i / 2].points[i % 2]; }
};

/// A pair of bodies in contact: a run of ContactTable::order.
struct BodyPair {
  BodyId a{}, b{};
  std::uint32_t first = 0, count = 0;
};

/// Two rigid things near each other of which at least one has several shapes: where the second was
/// seen from the first when their shapes were last paired.
struct NearPair {
  RigidId a{}, b{};
  std::array<Vec2, 4> corners{};  ///< of b's bounds in a's frame
  bool fresh = true;
  auto operator<=>(const NearPair& o) const {
    if (auto c = a <=> o.a; c != 0) return c;
    return b <=> o.b;
  }
  bool operator==(const NearPair& o) const { return a == o.a && b == o.b; }
};

struct Broadphase {
  AabbTree tree;  ///< one leaf per rigid thing that is simulated as its own
  std::vector<std::unique_ptr<AabbTree>> shape_trees;  ///< per rigid, where it has several shapes
  std::vector<int> shape_leaves;                       ///< per shape, in its rigid's tree, or −1
  std::vector<NearPair> near;                          ///< ascending
};

/// A change of a body's velocity.
struct Twist {
  double vx = 0.0, vy = 0.0;  ///< [m/s]
  double omega = 0.0;         ///< [rad/s]
};

/// A velocity summed over consecutive steps.
struct Drift {
  float sum = 0.0F;  ///< [m/s]
  int steps = 0;
};

/// A contact inside a collection: its memory is cold, its block hot.
struct InternalContact {
  Contact contact;                  ///< positions and normal in the collection's frame
  bool active[2] = {false, false};  ///< has carried a force, so that its loss is a break
  bool lost[2] = {false, false};    ///< has opened since
  Drift slip[2];           ///< along the tangent, over consecutive steps on the edge of the cone
  Drift opening[2];        ///< along the normal, over consecutive steps without a force
  std::int64_t since = 0;  ///< step of the merge that brought it in
};

/// A pair of bodies held together: by a run of Collection::contacts, joints, or both.
struct Weld {
  BodyId a{}, b{};
  std::uint32_t first = 0, count = 0;
  int joints = 0;      ///< what its joints hold, in contacts: 1 is a pivot, 2 are rigid
  int loud_steps = 0;  ///< consecutive steps above the unmerging threshold
  bool cut = false;    ///< found broken, sliding or moving in this step
  EventReason reason = EventReason::None;
};

/// Bodies simulated as one (Section 4).
struct Collection {
  CollectionId id = kNoCollection;  ///< kNoCollection: the slot is free
  RigidId rigid{};
  BodyId anchor{};              ///< when its rigid is not floating: a body of that frame
  std::vector<BodyId> members;  ///< ascending; pinned and scripted bodies are never members
  std::vector<InternalContact> contacts;  ///< ascending by key
  std::vector<ContactBlock> blocks;       ///< one per contact, in the order of an undisturbed sweep
  std::vector<std::uint32_t> block_contact;  ///< which contact a block is
  std::vector<std::uint32_t> block_weld;     ///< which weld it belongs to
  std::vector<std::uint8_t> watched;         ///< per block: was at its limit in the last step
  std::vector<std::uint32_t> pivots;         ///< welds with fewer than two contacts that hold
  std::vector<std::uint32_t> cut_welds;      ///< in the last step
  bool pivots_stale = true;
  std::uint32_t active_blocks = 0;  ///< the first ones; the others are swept in disturbed steps
  std::vector<Weld> welds;          ///< ascending by pair
  std::vector<JointBlock> joints;   ///< those that act inside; λ is live here
  std::vector<Twist> push;          ///< per member: Δu by the inner forces, in the frame
  bool stale = false;               ///< contacts changed: welds and blocks must be laid out anew
  Vec2 frame_v = Vec2::Zero(), frame_gain = Vec2::Zero();  ///< velocity, and its last gain [m/s]
  int frame_known = 0;                                     ///< steps since it was formed, up to 2
  bool settled = false;  ///< inner forces did not change in the last sweep
  bool refuted = false;  ///< more sweeps did not confirm what seemed to part, and nothing is new
};

struct TimedSpring {
  BodyIndex body = 0;
  Vec2 anchor = Vec2::Zero();  ///< from the centre of mass, in the body frame
  Vec2 to = Vec2::Zero();      ///< world, or the same in `to_body`
  std::int64_t to_body = -1;
  double stiffness = 0.0, damping = 0.0, rest_length = 0.0;
};

/// A pair of bodies that is ready to merge, as an edge between two nodes: rigid things, or frames.
struct ReadyPair {
  BodyPair pair;
  std::uint32_t node_a = 0, node_b = 0;
  int contacts = 0;              ///< active ones, or what joints are worth
  Vec2 joint_at = Vec2::Zero();  ///< where there are no contacts
};

/// The state of a world between two steps.
struct State {
  // constant
  Settings settings;
  Mode mode = Mode::MergeSleep;
  double h = 0.01;
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
  std::vector<Body> bodies;
  std::vector<Rigid> rigids;            ///< bodies, then collections
  std::vector<Collection> collections;  ///< slot i is rigid bodies.size() + i
  std::int32_t next_collection = 0;
  ContactTable contacts;
  std::vector<Joint> joints;
  std::vector<std::pair<BodyId, BodyId>> joined_pairs;  ///< do not collide; ascending
  Broadphase broadphase;
  std::vector<ReadyPair> ready_before;  ///< in the last step; those still there were not welded

  const Collider& collider(std::uint32_t shape) const { return colliders[shape_collider[shape]]; }
  const Aabb& bounds(std::uint32_t shape) const { return collider_bounds[shape_collider[shape]]; }

  Body& operator[](BodyId id) { return bodies[index(id)]; }
  const Body& operator[](BodyId id) const { return bodies[index(id)]; }
  Rigid& operator[](RigidId id) { return rigids[index(id)]; }
  const Rigid& operator[](RigidId id) const { return rigids[index(id)]; }
  /// The rigid thing that a body moves with: itself or its collection.
  Rigid& rigid(BodyId id) { return rigids[index(bodies[index(id)].rigid)]; }
  const Rigid& rigid(BodyId id) const { return rigids[index(bodies[index(id)].rigid)]; }
  bool isCollection(RigidId id) const { return index(id) >= bodies.size(); }
  Collection& collection(RigidId id) { return collections[index(id) - bodies.size()]; }
  const Collection& collection(RigidId id) const { return collections[index(id) - bodies.size()]; }

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

/// The mixing rules of two bodies: friction by the geometric mean, restitution by the larger.
inline double frictionOf(const State& state, BodyId a, BodyId b) {
  return std::sqrt(state[a].friction * state[b].friction);
}
inline double restitutionOf(const State& state, BodyId a, BodyId b) {
  return std::max(state[a].restitution, state[b].restitution);
}

/// Contacts of a magnet that is on pull too, and do not slide.
inline bool isBilateral(const State& state, BodyId a, BodyId b) {
  return state[a].magnet_on || state[b].magnet_on;
}

/// A force acting through this step: on a body, about its centre of mass.
struct Load {
  BodyId body{};
  Vec2 force = Vec2::Zero();  ///< [N]
  double torque = 0.0;        ///< [N m]
};

/// An impulse given at the start of this step.
struct Kick {
  BodyId body{};
  Vec2 at = Vec2::Zero();       ///< world point [m]
  Vec2 impulse = Vec2::Zero();  ///< [N s]
};

/// A contact outside collections in the single sweep.
struct SweepContact {
  std::uint32_t slot = 0;  ///< of the contact table
  ContactBlock block;      ///< with the bodies' own masses
};

/// What a block of the full solve is made from, and where its impulses go.
struct RowSource {
  static constexpr PointIndex kNone = ~PointIndex{0};
  std::array<PointIndex, 2> points{kNone, kNone};
  int count() const { return points[1] == kNone ? 1 : 2; }
};

/// Blocks and bodies of one island of the full solve: ranges of Scratch::blocks, island_bodies.
struct Island {
  std::uint32_t root = 0;
  std::uint32_t first = 0, last = 0;
  std::uint32_t first_body = 0, last_body = 0;
  std::uint32_t first_joint = 0, last_joint = 0;  ///< of Scratch::joint_blocks
};

/// Where a block stands: `source` is its RowSource.
struct BlockOrder {
  std::uint32_t island = 0, colour = 0, source = 0;
  auto operator<=>(const BlockOrder&) const = default;
};

/// Where a joint stands: `joint` is its index.
struct JointOrder {
  std::uint32_t island = 0, joint = 0;
  auto operator<=>(const JointOrder&) const = default;
};

/// Normal and tangential impulses of a block's two points.
using Impulses = std::array<double, 4>;

/// Memory of the conjugate gradient (dynamics/nncg.h), kept between calls.
struct NncgBuffers {
  std::vector<Impulses> before, direction;   ///< per block
  std::vector<Twist> u_before, u_direction;  ///< per body
};

/// Lives for one step; its memory is kept.
struct Scratch {
  std::vector<Load> loads;
  std::vector<Kick> kicks;
  std::vector<SpringView> springs;
  std::vector<BodyPair> pairs;  ///< body pairs in contact, ascending
  std::vector<Event> events;
  Notes* notes = nullptr;  ///< null: nobody asks
  Stats stats;

  // ContactDetection
  std::vector<RigidId> moved;
  std::vector<std::uint8_t> moved_flag;
  std::vector<ContactKey> candidates;
  std::vector<NearPair> near_candidates;
  std::vector<std::uint8_t> near_refined;  ///< per near pair: paired anew in this step

  // ContactOrdering: where something new enters
  std::vector<std::uint32_t> seeds;  ///< bodies

  /// Bodies for which something is new in this step that is no contact and no impulse: a force
  /// begins or ends, a magnet is switched, a pin is drawn.
  std::vector<BodyId> stirred;

  // SleepAndWake
  std::vector<std::uint8_t> restless, island_awake;  ///< per rigid

  // SingleIterationPGS
  bool sweeping = false;                ///< some collection is swept
  std::int64_t last_sweep = -1;         ///< step whose velocities are in sweep_u
  std::vector<SolverVelocity> sweep_u;  ///< per body
  std::vector<Twist> sweep_before;      ///< per member
  std::vector<SweepContact> sweep_contacts;
  std::vector<JointBlock> sweep_joints;       ///< outside collections
  std::vector<std::uint8_t> near_collection;  ///< per body: has a row in sweep_contacts
  std::vector<std::uint8_t> disturbed;        ///< per collection slot

  // Unmerge
  bool split = false;                      ///< some collection was taken apart
  std::vector<std::uint32_t> cuts_before;  ///< welds of the collection at hand

  // Merge
  std::vector<ReadyPair> ready;  ///< ascending by bodies

  // SolveLCP
  std::vector<SolverVelocity> u;       ///< per rigid, and the world's
  std::vector<ContactBlock> blocks;    ///< by island, then by colour
  std::vector<RowSource> row_sources;  ///< in the order of the pairs
  std::vector<Island> islands;
  std::vector<std::uint32_t> island_bodies;
  std::vector<std::int32_t> island_of;  ///< per rigid; −1: touches nothing
  DisjointSets sets;
  std::vector<std::uint64_t> colours;  ///< per rigid: those of its blocks, as bits
  std::vector<JointOrder> joint_order;
  std::vector<JointBlock> joint_blocks;  ///< by island
  std::vector<BlockOrder> block_order;
  NncgBuffers nncg;
};

}  // namespace merge2d
