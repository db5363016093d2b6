#pragma once
/// The way of a load through a collection to the frame that it is fixed to.
///
/// Where the contacts on the way can take their parts, nothing moves: admissible impulses form a
/// convex cone, and those of the load are added to those that there are.

#include <span>
#include <utility>
#include <vector>

#include "src2d/dynamics/state.h"
#include "src2d/relaxation/cone_impulses.h"
#include "src2d/relaxation/imbalance.h"

namespace merge2d {

/// Passes loads on members from body to body, each farther along a direction than the one before.
class LoadPath {
 public:
  /// Members of open regions take nothing. The welds must be listed by member.
  LoadPath(const State& state, const Scratch& scratch, const Collection& c);

  /// Whether the contacts can pass a change of velocity of a member on to the frame, along it, or
  /// against it where impulses end, so that no body on the way keeps more than the velocity
  /// `tolerance` [m/s]. False tells nothing: there may be other ways.
  bool find(const MemberLoad& load, double tolerance);

  /// The same for several loads at once, along the one that the frame's motion gives.
  bool find(std::span<const MemberLoad> loads, const FrameLoad& frame, double tolerance);

  /// Adds the impulses of the way that was found to the blocks, for the next load to meet.
  void apply(Collection& c);

  /// The members on that way and beside it, ascending.
  std::vector<std::uint32_t> members() const;

  /// Puts the impulses back that the blocks had before all ways were added.
  void restore(Collection& c);

 private:
  /// A member, when something is passed on to it.
  struct Node {
    std::uint32_t member = 0;
    Wrench load;
    double depth = 0.0;                 ///< of its centre along the way [m]
    double size = 1.0;                  ///< by which moments are divided [m]
    double inv_mass = 0.0, turn = 0.0;  ///< speed at its corners that a wrench gives [1/kg]
    bool waits = false;                 ///< has a load that it has not passed on
  };
  struct Change {
    std::uint32_t block = 0;
    int point = 0;
    double n = 0.0, t = 0.0;
  };

  bool find(std::span<const MemberLoad> loads, const Vec2& along);
  void forgetNodes();
  bool passOn(std::uint32_t member);
  void add(std::uint32_t member, const Wrench& load);
  std::uint32_t takeFirst();
  void listEdges(std::uint32_t member);
  void listEdges(std::uint32_t block, std::uint32_t member, std::uint32_t other);
  /// Valid until the next one is looked at.
  Node& nodeOf(std::uint32_t member);
  const Node& known(std::uint32_t member) const { return nodes_[place_[member] - 1]; }
  bool isOpen(std::uint32_t member) const {
    return !scratch_.open.empty() && scratch_.open[index(c_.members[member])] != 0;
  }
  bool isBefore(std::uint32_t a, std::uint32_t b) const {
    const double depth_a = known(a).depth, depth_b = known(b).depth;
    return depth_a < depth_b || (depth_a == depth_b && a < b);
  }

  const State& state_;
  const Scratch& scratch_;
  const Collection& c_;
  double tolerance_ = 0.0;
  Vec2 along_ = Vec2::UnitX();
  std::vector<Node> nodes_;           ///< of the members that were looked at
  std::vector<std::uint32_t> place_;  ///< per member: one more than its place there, or 0
  std::vector<std::uint32_t> front_;  ///< a heap: members that have not passed their load on
  std::vector<ConeEdge> edges_;       ///< of the body in question
  std::vector<Change> changes_;       ///< of the way that was found
  std::vector<std::pair<std::uint32_t, Impulses>> before_;  ///< of blocks, as they were changed
};

}  // namespace merge2d
