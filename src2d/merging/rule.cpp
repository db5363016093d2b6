#include "src2d/merging/rule.h"

#include "src2d/merging/decided_rule.h"
#include "src2d/merging/default_rule.h"
#include "src2d/merging/paper_rule.h"

namespace merge2d {

const MergingMethod& mergingMethod(const State& state) {
  switch (state.settings.merging.rule) {
    case Rule::Paper:
      return kPaperMerging;
    case Rule::Default:
    case Rule::Decided:
      break;
  }
  return kDefaultMerging;
}

const UnmergingMethod& unmergingMethod(const State& state) {
  switch (state.settings.unmerging.rule) {
    case Rule::Paper:
      return kPaperUnmerging;
    case Rule::Decided:
      return kDecidedUnmerging;
    case Rule::Default:
      break;
  }
  return kDefaultUnmerging;
}

}  // namespace merge2d
