#pragma once
/// Collections as data: members, welds, and the contacts inside (Section 4).

#include <array>
#include <cstdint>
#include <vector>

#include "src2d/dynamics/contact_block.h"
#include "src2d/dynamics/contact_table.h"
#include "src2d/dynamics/joint.h"
#include "src2d/dynamics/rigid.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

/// A change of a body's velocity.
struct Twist {
  double vx = 0.0, vy = 0.0;  ///< [m/s]
  double omega = 0.0;         ///< [rad/s]
};

/// Normal and tangential impulses of a block's two points.
using Impulses = std::array<double, 4>;

/// A velocity summed over consecutive steps.
struct Drift {
  float sum = 0.0F;  ///< [m/s]
  int steps = 0;
};

struct InternalPoint {
  Vec2 position = Vec2::Zero();           ///< in the collection's frame [m]
  double lambda_n = 0.0, lambda_t = 0.0;  ///< while the contact has no block [N s]
};

/// What is known of a point's limits.
struct PointWatch {
  Drift slip;           ///< along the tangent, over consecutive steps on the edge of the cone
  Drift opening;        ///< along the normal, over consecutive steps without a force
  bool active = false;  ///< has carried a force, so that its loss is a break
  bool lost = false;    ///< has opened since

  bool holds() const { return active && !lost; }
};

/// Directions of a load.
struct LoadRange {
  float from = 1.0F, to = 0.0F;  ///< angles in the frame of what bears it [rad]; empty at first
  int times = 0;                 ///< that it was found to be borne

  bool empty() const { return from > to; }
};

/// Instead of the step of a merge: a contact that may close in this step, and holds nothing.
inline constexpr std::int64_t kExpected = -1;

/// A contact inside a collection: its memory is cold, its block hot. What the tests of a step look
/// at comes first.
struct InternalContact {
  static constexpr std::uint32_t kNoBlock = ~0u;

  std::int64_t since = 0;  ///< step of the merge that brought it in, or kExpected
  std::uint32_t weld = 0;  ///< which one it belongs to
  std::int16_t count = 0;
  std::int16_t vain = 0;  ///< as in Contact
  std::array<PointWatch, 2> watch;
  std::uint32_t block = kNoBlock;  ///< its place among Collection::blocks; kNoBlock: to be made
  std::array<std::uint32_t, 2> feature{};  ///< of each point
  ContactKey key;
  float strayed = 0.0F;         ///< as in Contact
  Vec2 normal = Vec2::UnitX();  ///< from a to b, in the collection's frame
  std::array<InternalPoint, 2> points;
  std::array<double, 2> gap{};  ///< of each point, when the two merged [m]

  InternalPoint& point(int i) { return points[static_cast<std::size_t>(i)]; }
  const InternalPoint& point(int i) const { return points[static_cast<std::size_t>(i)]; }

  /// As a contact of the table.
  Contact released() const {
    Contact contact;
    contact.key = key;
    contact.normal = normal;
    contact.count = count;
    contact.vain = vain;
    contact.strayed = strayed;
    for (std::size_t i = 0; i < 2; ++i) {
      ContactPoint& point = contact.points[i];
      point.position = points[i].position;
      point.gap = gap[i];
      point.feature = feature[i];
      point.lambda_n = points[i].lambda_n;
      point.lambda_t = points[i].lambda_t;
    }
    return contact;
  }
};

/// What a weld holds by.
enum class Grip : std::uint8_t {
  Unknown,  ///< to be found
  None,     ///< no contact of it has carried a force yet
  Lost,     ///< all of them have opened
  Pivot,    ///< one contact
  Several,  ///< more, which may all be in one place
  Firm,     ///< two in different places, or joints worth as much: its bodies cannot turn
};

/// A pair of bodies held together: by a run of Collection::contacts, joints, or both.
struct Weld {
  BodyId a{}, b{};
  std::uint32_t first = 0, count = 0;
  std::uint32_t node_a = 0,
                node_b = 0;  ///< each body's place among the members; the frame's is last
  Drift turning{};           ///< of a pivot, over consecutive steps
  std::int16_t vain = 0;     ///< welds of the pair before it that were cut in vain
  std::uint8_t joints = 0;   ///< what its joints hold, in contacts: 1 is a pivot, 2 are rigid
  Grip grip = Grip::Unknown;
  bool bridge = false;    ///< its cut would leave two parts
  bool expected = false;  ///< only contacts that may close in this step: no weld yet
  bool cut = false;       ///< found broken, sliding or moving in this step
  EventReason reason = EventReason::None;
};

/// A weld that may turn.
struct Pivot {
  std::uint32_t weld = 0;
  float reach = 0.0F;  ///< from the first body's centre to any corner of the two, at most [m]
};

/// What the tests of a step know of a block before they look at its contact.
struct BlockWatch {
  /// The point has carried a force: PointWatch::active, at hand.
  bool active(int point) const { return ((bits >> point) & 1) != 0; }
  void activate(int point) { bits = static_cast<std::uint8_t>(bits | (1 << point)); }
  /// It is at its limit, or was in the last step.
  bool watched() const { return (bits & kWatched) != 0; }
  void watch(bool on) { bits = static_cast<std::uint8_t>(on ? bits | kWatched : bits & ~kWatched); }

  static constexpr int kWatched = 4;
  std::uint8_t bits = kWatched;
};

/// The load that a frame's motion puts on everything at rest in it: the velocity that it gives at
/// the middle of the members' box, in two directions; the change of that over one size, along and
/// across; and the spin times the size. Linear, so that loads add up [m/s].
using FrameLoad = std::array<double, 5>;

/// Memory of the conjugate gradient (dynamics/nncg.h), kept between calls.
struct NncgBuffers {
  std::vector<Impulses> before, direction;   ///< per block
  std::vector<Twist> u_before, u_direction;  ///< per body
  double previous = 0.0;                     ///< change of the last sweep but one, squared
};

/// A load that the contacts inside were found to carry without relative motion, and their impulses.
struct Witness {
  FrameLoad frame{};
  std::vector<Twist> outer;      ///< per column of the certificate; the spin times the size
  std::vector<Impulses> lambda;  ///< per block, then per joint
};

/// A search for the impulses that carry a load, over several steps.
struct ProofSearch {
  Witness load;               ///< with the impulses found so far
  std::vector<Twist> start;   ///< per member: the velocity that the load gives; empty: no search
  NncgBuffers nncg;           ///< of the sweeps so far
  double way = 0.0;           ///< from where it began, if ahead
  std::int8_t doublings = 0;  ///< of the sweeps that it may take in a step
  bool ahead = false;         ///< beyond the loads that there were: nothing depends on it
};

/// Proofs that a collection holds (merging/load_certificate.h).
struct LoadCertificate {
  static constexpr std::size_t kMost = 8;  ///< witnesses
  using Weights = std::array<double, kMost>;

  std::vector<std::uint32_t> columns;  ///< members on which something outside acts, in any witness
  std::vector<Witness> witnesses;
  std::vector<double> gram;  ///< products of their loads: that of i and j at kMost i + j
  Weights weights{};         ///< of the load that was carried last
  /// Of a floating collection: the member whose rows follow from those of the others.
  std::uint32_t heaviest = ~0u;
  bool lambda_stale = false;  ///< blocks and joints hold other impulses than the weights say
  bool in_doubt = true;       ///< a proof must be sought for any load
  std::int64_t since = 0;     ///< step in which the collection was laid out
  ProofSearch search;
};

/// Bodies simulated as one (Section 4).
struct Collection {
  static constexpr std::int8_t kMostRefusals = 5;  ///< then it waits longest, for 32 steps

  CollectionId id = kNoCollection;  ///< kNoCollection: the slot is free
  RigidId rigid{};
  BodyId anchor{};              ///< when its rigid is not floating: a body of that frame
  std::vector<BodyId> members;  ///< ascending; pinned and scripted bodies are never members
  std::vector<InternalContact> contacts;  ///< ascending by key
  std::vector<ContactBlock> blocks;       ///< one per contact, in the order of an undisturbed sweep
  /// Which contact a block is; empty when contacts have left since.
  std::vector<std::uint32_t> block_contact;
  std::vector<BlockWatch> watches;       ///< per block
  std::vector<Pivot> pivots;             ///< Lost or Pivot: the only ones that can turn in 2D
  std::vector<std::uint32_t> leaning;    ///< bridges with a contact that now carries nothing
  std::vector<std::uint32_t> cut_welds;  ///< in the last step
  /// Welds without which, all at once, it was found to hold together.
  std::vector<std::uint32_t> spare;
  /// Such a `cut_welds` of a step since which no contact has opened.
  std::vector<std::uint32_t> stood;
  /// Other welds that have lost a contact since.
  std::vector<std::uint32_t> loosened;
  bool judged = false;  ///< asked since it was laid out whether it holds together
  bool pivots_stale = true;
  bool stale = false;               ///< contacts changed: welds and blocks must be laid out anew
  int points = 0;                   ///< contact points of all blocks
  std::uint32_t active_blocks = 0;  ///< the first ones; the others are swept in disturbed steps
  float residual = 0.0F;    ///< largest change of a member's velocity in the last sweep [m/s]
  std::vector<Weld> welds;  ///< ascending by pair
  /// Welds of node n, a member or at last the frame: weld_of[weld_at[n] … weld_at[n + 1]].
  std::vector<std::uint32_t> weld_at, weld_of;
  std::vector<JointBlock> joints;  ///< those that act inside; λ is live here
  std::vector<Twist> push;         ///< per member: Δu by the inner forces, in the frame
  Vec2 frame_v = Vec2::Zero(), frame_gain = Vec2::Zero();  ///< velocity, and its last gain [m/s]
  std::int16_t frame_known = 0;                            ///< steps since it was formed, up to 2
  std::int16_t follow_up = 0;  ///< steps for which a disturbance is still followed
  std::int16_t struck = 0;     ///< the same, since something hit it: kFollowed now
  std::int16_t stirred = 0;    ///< the same, since something else was new: Scratch::stirred
  std::int8_t refusals = 0;  ///< times in a row that nothing which seemed to part would have moved
  std::int8_t patience = 0;  ///< steps before that is asked again
  std::int16_t hastened_in = 0;     ///< steps before slow sweeps are hastened (slow_sweep.h)
  std::int16_t hastened_every = 0;  ///< and how many there were the last time
  float lingering = 0.0F;           ///< what the last refinement did not quieten [m/s]
  bool settled = false;             ///< inner forces did not change in the last sweep
  std::int8_t calm = 0;             ///< steps for which it has been so, in a round (sweep.cpp)
  bool refuted = false;             ///< a closer look found that nothing parts, and nothing is new
  std::uint8_t jolted = 0;          ///< the most of its members': Body::jolted
  std::int16_t since_blow = 1000;   ///< steps since something touched or hit it, at most 1,000
  LoadRange borne;                  ///< that its parts were found to stand in (footing.h)
  std::vector<LoadCertificate> certificate;  ///< one, or none where no rule asks for proofs

  bool waitsLong() const { return patience > 0 && refusals == kMostRefusals; }
};

/// A pair of bodies that is ready to merge, as an edge between two nodes: rigid things, or frames.
struct ReadyPair {
  BodyPair pair;
  std::uint32_t node_a = 0, node_b = 0;
  int contacts = 0;              ///< active ones, or what joints are worth
  Vec2 joint_at = Vec2::Zero();  ///< where there are no contacts
};

}  // namespace merge2d
