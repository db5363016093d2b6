#pragma once
/// Collections as data: members, welds, and the contacts inside (Section 4).

#include <array>
#include <cstdint>
#include <vector>

#include "src2d/core/events.h"
#include "src2d/core/index_runs.h"
#include "src2d/dynamics/bounded_impulse.h"
#include "src2d/dynamics/contact_block.h"
#include "src2d/dynamics/contact_table.h"
#include "src2d/dynamics/joint.h"
#include "src2d/dynamics/rigid.h"

namespace merge2d {

/// A change of a body's velocity.
struct Twist {
  double vx = 0.0, vy = 0.0;  ///< [m/s]
  double omega = 0.0;         ///< [rad/s]
};

inline double dot(const Twist& x, const Twist& y) {
  return x.vx * y.vx + x.vy * y.vy + x.omega * y.omega;
}

/// x += s y
inline void addTo(Twist& x, const Twist& y, double s) {
  x.vx += s * y.vx;
  x.vy += s * y.vy;
  x.omega += s * y.omega;
}

/// Normal and tangential impulses of a block's two points.
using Impulses = std::array<double, 4>;

struct InternalPoint {
  Vec2 position = Vec2::Zero();           ///< in the collection's frame [m]
  double lambda_n = 0.0, lambda_t = 0.0;  ///< while the contact has no block [N s]
};

/// The state of a point's limits.
struct PointWatch {
  bool active = false;  ///< has carried a force, so that its loss is a break
  bool lost = false;    ///< has opened since

  bool holds() const { return active && !lost; }
};

/// Instead of the step of a merge: a contact that may close in this step, and holds nothing.
inline constexpr std::int64_t kExpected = -1;

/// A contact inside a collection: its memory is cold, its block hot. The data that the tests
/// of a step look at come first.
struct InternalContact {
  static constexpr std::uint32_t kNoBlock = ~0u;

  std::int64_t since = 0;  ///< step of the merge that brought it in, or kExpected
  std::uint32_t weld = 0;  ///< which one it belongs to
  std::int16_t count = 0;
  std::array<PointWatch, 2> watch;
  std::uint32_t block = kNoBlock;  ///< its place among Collection::blocks; kNoBlock: to be made
  std::array<std::uint32_t, 2> feature{};  ///< of each point
  ContactKey key;
  Vec2 normal = Vec2::UnitX();  ///< from a to b, in the collection's frame
  std::array<InternalPoint, 2> points;
  std::array<double, 2> gap{};  ///< of each point, when the two merged [m]

  InternalPoint& point(int i) { return points[static_cast<std::size_t>(i)]; }
  const InternalPoint& point(int i) const { return points[static_cast<std::size_t>(i)]; }

  /// For a contact that has no block. A rolling moment stands in the place of the second point's
  /// tangent.
  void setImpulses(const Impulses& lambda) {
    for (std::size_t i = 0; i < 2; ++i) {
      points[i].lambda_n = lambda[i];
      points[i].lambda_t = lambda[i + 2];
    }
  }

  Impulses impulses() const {
    return {points[0].lambda_n, points[1].lambda_n, points[0].lambda_t, points[1].lambda_t};
  }

  /// As a contact of the table.
  Contact released() const {
    Contact contact;
    contact.key = key;
    contact.normal = normal;
    contact.count = count;
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

/// A pair of bodies held together: by a run of Collection::contacts, joints, or both.
struct Weld {
  BodyId a{}, b{};
  std::uint32_t first = 0, count = 0;
  std::uint32_t node_a = 0,
                node_b = 0;  ///< each body's place among the members; the frame's is last
  float motion = 0.0F;       ///< with which it was cut [m/s]
  std::uint16_t moving = 0;  ///< steps in a row for which the paper's rule has seen it move
  std::uint8_t joints = 0;   ///< what its joints hold, in contacts: 1 is a pivot, 2 are rigid
  bool expected = false;     ///< only contacts that may close in this step: no weld yet
  bool cut = false;          ///< found broken, sliding or moving in this step
  EventReason reason = EventReason::None;
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

/// Where a direct solve stands that goes on in the next step (dynamics/newton.h).
struct NewtonIterate {
  std::vector<BoundedImpulse> unknowns;  ///< empty: it has not begun
  std::vector<Twist> u;                  ///< of the bodies [m/s]
  double exact = 0.0;                    ///< velocity by which equations may miss [m/s]
  int steps = 0;                         ///< so far
};

/// A load that the contacts inside were found to carry without relative motion, and their impulses.
struct Witness {
  FrameLoad frame{};
  std::vector<Twist> outer;      ///< per column of the certificate; the spin times the size
  std::vector<Impulses> lambda;  ///< per block, then per joint
  double motion = 0.0;           ///< of the members that these impulses leave [m/s]
};

/// A search for the impulses that carry a load, over several steps.
struct ProofSearch {
  /// With the impulses found so far where it looks ahead, and else with those before the search.
  Witness load;
  std::vector<Twist> start;  ///< per member: the velocity that the load gives; empty: no search
  NncgBuffers nncg;          ///< of the sweeps so far
  NewtonIterate newton;      ///< of a direct solve that is under way
  /// Per weld, where the search has found motion: whether its bodies move there. Empty: not known.
  std::vector<std::uint8_t> movers;
  double way = 0.0;        ///< from where it began, if ahead
  std::int16_t steps = 0;  ///< that it has taken so far
  bool ahead = false;      ///< beyond the loads that there were: nothing depends on it

  bool isUnderWay() const { return !start.empty(); }
  /// For the load of a step: until it ends nothing is known of the collection.
  bool isNeeded() const { return isUnderWay() && !ahead; }
  /// The full solve of the same step finds the welds that part.
  bool hasFoundMotion() const { return !movers.empty(); }
  /// Newton's method has more to do than one step may spend, and goes on in the next.
  bool isSuspended() const { return !newton.unknowns.empty(); }
  /// Its sweeps have come to take all rows, as more than a part of them had a residual.
  bool isInAllRows() const { return nncg.previous > 0.0; }
};

inline constexpr std::int64_t kNever = -1000;  ///< a step long before the first

/// Proofs that a collection holds (load_certificate.h).
struct LoadCertificate {
  static constexpr std::size_t kMost = 8;  ///< witnesses
  using Weights = std::array<double, kMost>;

  std::vector<BodyId> columns;  ///< members on which something outside acts, in any witness
  std::vector<Witness> witnesses;
  std::size_t inherited = 0;  ///< the first ones: found before the layout
  std::vector<double> gram;   ///< products of their n loads: that of i and j at n i + j
  Weights weights{};          ///< of the load that was carried last
  /// Of a floating collection: the member whose rows follow from those of the others.
  BodyId heaviest{~0u};
  bool lambda_stale = false;         ///< blocks and joints hold other impulses than the weights say
  bool in_doubt = true;              ///< a proof must be sought for any load
  std::int64_t since = 0;            ///< step in which the collection was laid out
  std::int64_t last_doubt = kNever;  ///< step in which its blocks were needed last
  ProofSearch search;

  /// Blocks and joints hold other impulses than `impulses` gives.
  bool areRowsStale() const { return lambda_stale && !witnesses.empty(); }

  /// Of the block or joint at a place, by the weights.
  Impulses impulses(std::size_t at) const {
    Impulses lambda{};
    for (std::size_t i = 0; i < witnesses.size(); ++i) {
      if (weights[i] == 0.0) continue;
      const Impulses& of = witnesses[i].lambda[at];
      for (std::size_t r = 0; r < lambda.size(); ++r) lambda[r] += weights[i] * of[r];
    }
    return lambda;
  }
};

/// When something hit a collection, and the steps without a break in which hits of other bodies
/// opened it.
struct HitRun {
  std::int64_t blow = kNever;  ///< step in which something hit it last
  std::int64_t met = kNever;   ///< step in which a body did
  std::int64_t first = kNever, last = kNever;

  void endRun() { met = first = last = kNever; }
};

/// The velocities that the impulses inside give the members. A writer of impulses that last calls
/// `forget`, or `renewPush` for a few members (inner_push.h); one that puts them back in the same
/// step need not.
struct InnerPush {
  std::vector<Twist> of;  ///< per member, in the frame; empty: to be laid out anew
  /// Members that are faster than `tolerance` under the push and this motion of the frame, and
  /// perhaps some that are not; ascending.
  std::vector<std::uint32_t> unbalanced;
  FrameLoad frame{};
  double tolerance = -1.0;  ///< negative: they are not listed [m/s]
  double fastest = 0.0;     ///< of the others [m/s]

  void forget() {
    of.clear();
    forgetUnbalanced();  // there may be fewer members from now on
  }
  void forgetUnbalanced() {
    unbalanced.clear();
    tolerance = -1.0;
  }
};

/// Numbers of the last layout. A collection that has grown by little goes on in the layout that it
/// had: later members, contacts, welds and blocks stand behind the others, in the order in which
/// they joined (collections/layout.h).
struct LaidOut {
  std::uint32_t members = 0;        ///< all that had come in until then; 0: their places change
  std::uint32_t sorted_welds = 0;   ///< the first ones: ascending by pair
  std::uint32_t active_blocks = 0;  ///< the first ones; the others carried nothing at the merge.
                                    ///< Of the paper's rule, whose collections are always sorted
  int points = 0;                   ///< contact points of all blocks
};

/// Bodies simulated as one (Section 4).
struct Collection {
  CollectionId id = kNoCollection;  ///< kNoCollection: the slot is free
  RigidId rigid{};
  BodyId anchor{};  ///< when its rigid is not floating: a body of that frame
  /// The lowest first; pinned and scripted bodies are never members.
  std::vector<BodyId> members;
  std::vector<InternalContact> contacts;  ///< those of a weld in a row, ascending by key
  /// One per contact, in the order of a sweep; none while nothing is sought inside
  /// (collection.h).
  std::vector<ContactBlock> blocks;
  /// Which contact a block is; empty when contacts have left since.
  std::vector<std::uint32_t> block_contact;
  LaidOut laid_out;
  bool stale = false;              ///< contacts changed: welds and blocks must be laid out anew
  std::vector<Weld> welds;         ///< of one pair each
  IndexRuns welds_of;              ///< per member; empty until it is opened
  std::vector<JointBlock> joints;  ///< those that act inside; λ is live here
  InnerPush push;
  float residual = 0.0F;  ///< largest of its rows, when last solved [m/s]
  bool settled = false;   ///< the forces inside are known
  HitRun hits;
  std::vector<LoadCertificate> certificate;  ///< one, or none where no rule asks for proofs

  /// Of a block: by the weights while the rows are stale, else from there, or from its contact
  /// where it is put away.
  Impulses impulsesOf(std::size_t block) const {
    if (!certificate.empty() && certificate.front().areRowsStale()) {
      return certificate.front().impulses(block);
    }
    return blocks.empty() ? contacts[block_contact[block]].impulses() : blocks[block].lambda;
  }
  const Weld& weldOf(std::size_t block) const { return welds[contacts[block_contact[block]].weld]; }
};

/// Its blocks were put away (collection.h).
inline bool areBlocksAway(const Collection& c) {
  return c.blocks.empty() && !c.block_contact.empty();
}

/// A pair of bodies that is ready to merge, as an edge between two nodes: rigid things, or frames.
struct ReadyPair {
  BodyPair pair;
  std::uint32_t node_a = 0, node_b = 0;
  int contacts = 0;              ///< active ones, or what joints are worth
  Vec2 joint_at = Vec2::Zero();  ///< where there are no contacts
};

}  // namespace merge2d
