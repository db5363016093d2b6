#pragma once
/// The pairs that were ready to merge for long enough, as the edges of a graph, and those of them
/// about which there is something new.

#include <vector>

#include "src2d/cycles/pins.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// Rigid things as nodes; everything fixed to one frame is one node.
class MergeGraph {
 public:
  explicit MergeGraph(const State& state) : state_(state) {}

  std::uint32_t node(BodyId b) const {
    const Rigid& r = state_.rigid(b);
    return r.floating() ? static_cast<std::uint32_t>(state_[b].rigid)
                        : rigids() + static_cast<std::uint32_t>(r.anchor);
  }
  bool isFrame(std::uint32_t node) const { return node >= rigids(); }
  std::uint32_t nodes() const {
    return rigids() + static_cast<std::uint32_t>(state_.bodies.size() + 1);
  }

  /// The active contacts of pairs, about one of them: far from the origin nothing is lost.
  std::vector<Pin> pinsOf(const std::vector<ReadyPair>& ready) const;

 private:
  std::uint32_t rigids() const { return static_cast<std::uint32_t>(state_.rigids.size()); }

  const State& state_;
};

/// Collects the pairs that were ready for long enough: Scratch::ready.
void listReadyPairs(const State& state, Scratch& scratch, const MergeGraph& graph);

/// The ready pairs about which there is something new. One contact more can only make a group more
/// rigid, one less only less: pairs that were refused are looked at again when they hang together
/// with one that is new, other than through a frame.
std::vector<ReadyPair> pairsToJudge(const State& state, const Scratch& scratch,
                                    const MergeGraph& graph);

/// Records the pairs whose bodies are fixed to two frames: those stay apart however calm they are.
/// For the end of the stage, as some came there by the welds of this step.
void recordTwoFrames(const State& state, Scratch& scratch);

/// Records a criterion about a pair that is ready, or may be soon, if somebody asks: "merge" where
/// it holds. Returns the record, or null.
Decision* recordMerge(const State& state, Notes* notes, const BodyPair& pair,
                      const Criterion& test);

}  // namespace merge2d
