#include "bench/judging_time.h"

#include <chrono>

#include "src2d/cycles/held_groups.h"
#include "src2d/merging/ready_pairs.h"

namespace merge2d {
namespace {

using Clock = std::chrono::steady_clock;

JudgingTime total;
int depth = 0;  // one of the functions calls another

/// Adds its life to the total.
class Timed {
 public:
  Timed() : start_(Clock::now()) { ++depth; }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;
  ~Timed() {
    if (--depth == 0) total.seconds += std::chrono::duration<double>(Clock::now() - start_).count();
  }

 private:
  Clock::time_point start_;
};

}  // namespace

JudgingTime judgingTime() { return total; }

}  // namespace merge2d

// ld --wrap=F: calls of F become calls of __wrap_F, and __real_F is F.
using merge2d::Collection, merge2d::CycleCriterion, merge2d::Groups, merge2d::MergeGraph,
    merge2d::Pin, merge2d::ReadyPair, merge2d::Scratch, merge2d::State, merge2d::Timed;

#define MERGE2D_HELD_GROUPS(prefix) \
  prefix##_ZN7merge2d10heldGroupsEjSt4spanIKNS_3PinELm18446744073709551615EENS_14CycleCriterionE
#define MERGE2D_PAIRS_TO_JUDGE(prefix) \
  prefix##_ZN7merge2d12pairsToJudgeERKNS_5StateERKNS_7ScratchERKNS_10MergeGraphE
#define MERGE2D_PINS_OF(prefix) \
  prefix##_ZNK7merge2d10MergeGraph6pinsOfERKSt6vectorINS_9ReadyPairESaIS2_EE

extern "C" {
Groups MERGE2D_HELD_GROUPS(__real_)(std::uint32_t, std::span<const Pin>, CycleCriterion);
Groups MERGE2D_HELD_GROUPS(__wrap_)(std::uint32_t nodes, std::span<const Pin> pins,
                                    CycleCriterion criterion) {
  const Timed timed;
  ++merge2d::total.calls;
  return MERGE2D_HELD_GROUPS(__real_)(nodes, pins, criterion);
}

std::vector<ReadyPair> MERGE2D_PAIRS_TO_JUDGE(__real_)(const State&, const Scratch&,
                                                       const MergeGraph&);
std::vector<ReadyPair> MERGE2D_PAIRS_TO_JUDGE(__wrap_)(const State& state, const Scratch& scratch,
                                                       const MergeGraph& graph) {
  const Timed timed;
  return MERGE2D_PAIRS_TO_JUDGE(__real_)(state, scratch, graph);
}

std::vector<Pin> MERGE2D_PINS_OF(__real_)(const MergeGraph*, const std::vector<ReadyPair>&);
std::vector<Pin> MERGE2D_PINS_OF(__wrap_)(const MergeGraph* graph,
                                          const std::vector<ReadyPair>& ready) {
  const Timed timed;
  return MERGE2D_PINS_OF(__real_)(graph, ready);
}
}
