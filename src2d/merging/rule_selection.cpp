/// The tables that the settings name. Apart from rule.h, which the rules include.

#include "src2d/merging/default_rule.h"
#include "src2d/merging/paper_rule.h"
#include "src2d/merging/rule.h"

namespace merge2d {

const MergingMethod& mergingMethod(const State& state) {
  switch (state.settings.merging.rule) {
    case MergingRule::Paper:
      return kPaperMerging;
    case MergingRule::Default:
      break;
  }
  return kDefaultMerging;
}

const UnmergingMethod& unmergingMethod(const State& state) {
  switch (state.settings.unmerging.rule) {
    case UnmergingRule::Paper:
      return kPaperUnmerging;
    case UnmergingRule::Default:
      break;
  }
  return kDefaultUnmerging;
}

const CollectionMethod& collectionMethod(const State& state) {
  return unmergingMethod(state).collections;
}

}  // namespace merge2d
