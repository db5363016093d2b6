#pragma once
/// Data of one step; its memory is kept for the next.

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <vector>

#include "src2d/core/assert.h"
#include "src2d/core/disjoint_sets.h"
#include "src2d/core/events.h"
#include "src2d/core/notes.h"
#include "src2d/core/springs.h"
#include "src2d/core/stats.h"
#include "src2d/core/sweep_path.h"
#include "src2d/dynamics/collections.h"
#include "src2d/dynamics/joint_corrections.h"
#include "src2d/dynamics/joint_solver.h"
#include "src2d/dynamics/newton_workspace.h"
#include "src2d/dynamics/wide_blocks.h"

namespace merge2d {

class TaskPool;

/// A force acting through this step: on a body, about its centre of mass.
struct Load {
  BodyId body{};
  Vec2 force = Vec2::Zero();  ///< [N]
  double torque = 0.0;        ///< [N m]
};

/// One end of a spring.
struct SpringEnd {
  BodyId body{};
  Vec2 at = Vec2::Zero();   ///< in the world [m]
  Vec2 arm = Vec2::Zero();  ///< from the body's centre of mass [m]
};

/// A spring as it is now.
struct SpringStretch {
  SpringEnd from, to;
  bool other = false;  ///< `to` is at a body
  double length = 0.0;
  Vec2 direction = Vec2::Zero();
};

/// An impulse given at the start of this step.
struct Kick {
  BodyId body{};
  Vec2 at = Vec2::Zero();       ///< world point [m]
  Vec2 impulse = Vec2::Zero();  ///< [N s]
};

/// A load or a kick, by the rigid thing that it acts on.
struct ActionOrder {
  RigidId rigid{};
  std::uint32_t action = 0;  ///< its place in Scratch::loads or Scratch::kicks
  auto operator<=>(const ActionOrder&) const = default;
};

/// A contact that closes in this step and was open in the last one, or is hit.
struct Meeting {
  std::uint32_t pair = 0;     ///< of Scratch::pairs
  std::uint32_t contact = 0;  ///< its place in ContactTable::order
  double speed = 0.0;         ///< [m/s]
};

/// A contact of `toucher` with a shape that may have hidden sides (contact/hidden_sides.h).
struct SeamContact {
  std::uint32_t toucher = 0;  ///< the shape that touches it
  std::uint32_t side = 0;     ///< twice its place in ContactTable::order, plus 1 for a's sides
  std::uint32_t place() const { return side / 2; }
  bool ofA() const { return side % 2 == 1; }
};

/// A side that one toucher meets and that bears nothing yet.
struct LooseSide {
  std::uint32_t seam = 0;   ///< its place among the seams of the toucher
  std::uint32_t fixed = 0;  ///< the same for sides that cannot part
  Vec2 met = Vec2::Zero();  ///< where it is met, in the frame of the toucher's body [m]
  bool hidden = false;
};

/// What one toucher meets of things that cannot part, for each other's sides.
struct FixedCover {
  Vec2 up = Vec2::Zero();  ///< normal out of it, in the world
  std::uint32_t seam = 0;  ///< its place among the seams of the toucher
  std::uint32_t end = 0;   ///< of the run of those with the same `up`
};

/// A point of a contact that was predicted ahead, at the meeting.
struct CastEnd {
  std::uint32_t feature = 0;
  double gap = 0.0;          ///< [m]
  double carried = 0.0;      ///< the gap now that closes then [m]
  Vec2 on_b = Vec2::Zero();  ///< where the point lies on the second body, in its frame
};

/// Where such a contact was cast to (contact/cast.h).
struct Cast {
  ContactKey key;
  Vec2 normal = Vec2::UnitX();  ///< of the contact then, to know it by
  bool hit = false;             ///< they meet in this step; otherwise: where they are nearest
  bool displaced = false;       ///< by then much has turned, or moved across
  std::array<CastEnd, 2> ends;
};

/// A contact outside collections in the single sweep.
struct SweepContact {
  std::uint32_t slot = 0;  ///< of the contact table
  ContactBlock block;      ///< with the bodies' own masses
};

/// A contact or a joint, inside a collection or outside; `frame` is its collection's.
struct SweepItem {
  ContactBlock* block = nullptr;
  JointBlock* joint = nullptr;  ///< when there is no contact
  Rotation turn;                ///< of a joint's frame, or of the x axis into the contact's normal

  explicit SweepItem(ContactBlock& k, const Rotation& frame = {})
      : block(&k), turn(frame * Rotation{k.nx, k.ny}) {}
  explicit SweepItem(JointBlock& k, const Rotation& frame = {}) : joint(&k), turn(frame) {}

  Vec2 normal() const { return {turn.c, turn.s}; }
  std::uint32_t a() const { return block ? block->a : joint->a; }
  std::uint32_t b() const { return block ? block->b : joint->b; }
};

/// The source of a block of the full solve, which its impulses go back to: one or two points of the
/// contact table, or a block inside an open collection.
struct RowSource {
  static constexpr PointIndex kInner = PointIndex{1} << 31;
  std::array<PointIndex, 2> points{kNone, kNone};

  static RowSource inside(std::uint32_t slot, std::uint32_t block) {
    return {{kInner | slot, block}};
  }
  bool isInner() const { return (points[0] & kInner) != 0; }
  std::uint32_t slot() const { return points[0] & ~kInner; }  ///< of the collection
  std::uint32_t block() const { return points[1]; }           ///< of Collection::blocks
  int count() const { return points[1] == kNone ? 1 : 2; }
};

/// Blocks and bodies of one island of the full solve: ranges of Scratch::blocks, island_bodies.
struct Island {
  std::uint32_t root = 0;
  std::uint32_t first = 0, last = 0;
  std::uint32_t first_body = 0, last_body = 0;
  std::uint32_t first_joint = 0, last_joint = 0;  ///< of Scratch::joint_blocks
  bool hits = false;                              ///< some of its points are hit in this step
};

/// How a rigid thing went through a step in which it was hit, which is not its velocity times h.
struct HitWay {
  RigidId id{};
  Vec2 way = Vec2::Zero();  ///< of its centre of mass [m]
  double turn = 0.0;        ///< [rad]
};

/// Where a block stands: by island, then by colour, then by its RowSource; as one number, which is
/// small and quick to sort.
struct BlockOrder {
  static constexpr int kSourceBits = 26, kIslandShift = 32;
  /// The last colour holds what found no other; its blocks may share bodies.
  static constexpr std::uint32_t kMixed = 63;
  std::uint64_t packed = 0;

  static BlockOrder of(std::uint32_t island, std::uint32_t colour, std::uint32_t source) {
    MERGE2D_ASSERT(colour <= kMixed && source >> kSourceBits == 0, "colour {}, source {}", colour,
                   source);
    return {std::uint64_t{island} << kIslandShift | std::uint64_t{colour} << kSourceBits | source};
  }
  std::uint32_t island() const { return static_cast<std::uint32_t>(packed >> kIslandShift); }
  std::uint32_t colour() const { return static_cast<std::uint32_t>(packed >> kSourceBits) & 63U; }
  std::uint32_t source() const {
    return static_cast<std::uint32_t>(packed & ((std::uint64_t{1} << kSourceBits) - 1));
  }
  auto operator<=>(const BlockOrder&) const = default;
};

/// Where a joint stands: `joint` is its index.
struct JointOrder {
  std::uint32_t island = 0, joint = 0;
  auto operator<=>(const JointOrder&) const = default;
};

/// The forces and contacts from outside on one member of a collection, in one step.
struct OuterLoad {
  std::uint32_t slot = 0, member = 0;
  Vec2 impulse = Vec2::Zero();  ///< in the world [N s]
  double moment = 0.0;          ///< about the member's centre of mass [N m s]
};

/// Why the forces inside a collection are sought in this step.
enum class Doubt : std::uint8_t {
  None,     ///< its proofs cover the load
  Search,   ///< impulses are sought, for a load that they do not cover or for one beyond it
  Reached,  ///< a hit may reach it through others: the solve of the step tells
  Open,     ///< its contacts may not carry the load: it is hit, dragged, or a search found motion
};

/// The part of an open collection whose members the full solve takes on their own
/// (open_region.h).
struct OpenRegion {
  std::uint32_t slot = 0;                                  ///< of the collection
  bool whole = false;                                      ///< all members are inside
  std::vector<std::uint32_t> members;                      ///< that are inside
  std::vector<std::pair<std::uint32_t, Impulses>> before;  ///< of its blocks, where it is not whole
  std::vector<OuterLoad> outer;  ///< that it began with, where it is not whole
  int rings = 2;                 ///< of neighbours that are added next
  bool passes = false;           ///< its hits may be passed on to the frame (load_path.h)
};

/// The motion with which a rigid thing begins a step (contact/approach.h).
struct StartedMotion {
  Vec2 v = Vec2::Zero();  ///< of the centre of mass [m/s]
  double omega = 0.0;     ///< [rad/s]
  double turning = 0.0;   ///< speed of the fastest point against the centre of mass, at most [m/s]
};

/// The findings of one task of the contact detection, where several threads search.
struct FoundByTask {
  std::vector<ContactKey> candidates;
  std::vector<NearPair> near;
  std::vector<std::pair<std::uint32_t, Contact>> touching;  ///< with the index of the idle pair
};

/// A flat region of the contact of two bodies, and its outermost points along the tangent
/// (contact/pruning.cpp).
struct FlatRegion {
  Vec2 normal;
  double height = 0.0;  ///< of the line along the normal [m]
  const ContactPoint* low = nullptr;
  const ContactPoint* high = nullptr;
  double low_at = 0.0, high_at = 0.0;
};

/// Memory of a thread that prunes the contacts of pairs.
struct PruneMemory {
  std::vector<FlatRegion> regions;
  std::vector<std::uint8_t> keeps;  ///< per point, in order
};

/// The forces on a rigid thing beside gravity.
struct Ties {
  bool held = false;    ///< forces that are found by iteration: of contacts or joints
  bool loaded = false;  ///< loads
};

/// How stiffly joints pull a rigid thing back that turns or moves [N m, N/m].
struct TautLink {
  double turning = 0.0, moving = 0.0;
};

/// Memory of a thread that solves islands, or the rows inside collections, one after the other.
struct SweepMemory {
  NncgBuffers nncg;
  WideBlocks wide;
  std::vector<PackedAs> kinds;  ///< per block of an island
  /// Velocities of the bodies, and of the world, in the frame of the collection that is solved.
  std::vector<SolverVelocity> trial_u;
};

/// Memory, instructions and threads of sweeps; the results depend on none of them.
struct SweepTools {
  SweepMemory& memory;
  SweepPath path = kFastestPath;
  TaskPool* tasks = nullptr;  ///< null: the thread of the memory alone
};

/// Lives for one step; its memory is kept.
struct Scratch {
  std::vector<Load> loads;
  std::vector<Kick> kicks;
  std::vector<SpringView> springs;
  std::vector<SpringStretch> stretches;  ///< of those whose body is alive
  std::vector<double> spring_gain;       ///< per body with springs: what these do to its velocity
  std::vector<BodyPair> pairs;           ///< body pairs in contact, ascending
  std::vector<Event> events;
  Notes* notes = nullptr;     ///< null: nobody asks
  TaskPool* tasks = nullptr;  ///< null: one thread
  SweepPath sweep_path = kFastestPath;
  Stats stats;

  // ContactDetection
  std::vector<StartedMotion> start_motions;  ///< of each rigid that is present
  std::vector<RigidId> moved;
  std::vector<std::uint8_t> moved_flag;
  std::vector<ContactKey> candidates;
  std::vector<Contact> touching;   ///< idle pairs that have become contacts
  std::vector<double> ahead;       ///< per contact in order, where several threads follow them [m]
  std::vector<FoundByTask> found;  ///< per task
  std::vector<SeamContact> seams;
  std::vector<LooseSide> loose_sides;    ///< of one toucher after the other
  std::vector<FixedCover> fixed_covers;  ///< of sides that cannot part, of one after the other
  std::vector<std::uint8_t> touchers;    ///< per shape, where seams are listed; else all 0
  std::vector<Cast> casts;               ///< ascending by key
  std::vector<PruneMemory> pruning;      ///< per thread
  std::vector<ActionOrder> kick_order, load_order;  ///< ascending; loads only where one is asked
  std::vector<NearPair> near_candidates;
  std::vector<std::uint8_t> near_refined;  ///< per near pair: paired anew in this step
  /// Per rigid of `near`, for others out of date: with which other ones, by their index modulo 16.
  std::vector<std::uint16_t> paired_with;

  // ContactOrdering: where something new enters
  std::vector<Meeting> meetings;     ///< ascending
  std::vector<std::uint32_t> seeds;  ///< bodies

  /// Bodies for which something is new in this step that is no contact and no impulse: a force
  /// begins or ends, a magnet is switched, a pin is drawn.
  std::vector<BodyId> stirred;
  std::vector<BodyId> started;  ///< scripted bodies that stood still before this step

  // SleepAndWake
  std::vector<std::uint8_t> restless, island_awake;  ///< per rigid that is present

  // WarmStart
  std::vector<OuterLoad> outer_loads;     ///< ascending by slot, then by member
  std::vector<std::uint32_t> load_place;  ///< per body: one more than its place there, or 0
  std::vector<Doubt> doubts;              ///< per collection slot, where welds are decided

  // SingleIterationPGS, where collections are opened: the full solve, with members on their own
  std::vector<OpenRegion> regions;
  std::vector<BodyId> open_members;  ///< those that the solve takes on their own
  std::vector<RowSource> open_rows;  ///< the contacts between them
  std::vector<std::uint8_t> open;    ///< per body: it is in a region
  std::vector<Twist> open_start;     ///< per body of an open collection: its velocity before
  std::vector<RigidId> opened;       ///< collections that were open, and the parts that came out
  bool solved = false;               ///< SolveLCP has nothing left to do

  // SingleIterationPGS
  bool sweeping = false;                ///< some collection is swept
  std::int64_t last_sweep = -1;         ///< step whose velocities are in sweep_u
  std::int64_t last_doubt = -1;         ///< step in which forces inside were sought last
  std::vector<SolverVelocity> sweep_u;  ///< per body
  std::vector<std::uint8_t> swept;      ///< per body: its velocity is there
  std::vector<SweepContact> sweep_contacts;
  std::vector<JointBlock> sweep_joints;       ///< outside collections
  std::vector<std::uint8_t> near_collection;  ///< per body: has a row in sweep_contacts

  // Unmerge
  std::map<CollectionId, NewtonWorkspace> newton;  ///< of direct solves that are under way
  bool split = false;                              ///< some collection was taken apart
  std::vector<std::uint32_t> overloaded_joints;    ///< break after the full solve

  // AccumulateRelativeMotion
  std::vector<Ties> ties;  ///< per rigid that is present

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
  JointMemory joint_memory;
  CorrectionMemory corrections;      ///< of joints
  std::vector<TautLink> taut_links;  ///< per rigid
  std::vector<BlockOrder> block_order;
  std::vector<BlockOrder> by_colour;        ///< as an intermediate order
  std::vector<std::uint32_t> island_roots;  ///< ascending
  std::vector<HitWay> hit_ways;             ///< ascending
  /// Per thread, the caller's first (thread_memory.h).
  std::vector<SweepMemory> sweeps = std::vector<SweepMemory>(1);
  std::vector<SweepChange> island_changes;  ///< per island
};

}  // namespace merge2d
