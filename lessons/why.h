#pragma once
/// Why two bodies are one or not, and the change that would alter it: for pages and terminals.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lessons/explain.h"
#include "src2d/recorder.h"
#include "src2d/trace/json_text.h"

namespace merge2d {

/// The condition of the other outcome, for sentences in any language.
struct Condition {
  enum class Kind : std::uint8_t {
    None,          ///< the step says nothing about it
    PassAll,       ///< they merge when they pass every test for `steps`
    Below,         ///< … when `measure` stays below `limit` for `steps`
    BelowMore,     ///< … for `steps` more
    CalmMore,      ///< … when all stays calm for `steps` more
    Wait,          ///< they may merge after `steps` more
    Hold,          ///< they merge when a second contact, or a rigid group, holds them
    Touch,         ///< only bodies that touch can merge
    BreakOrSlide,  ///< they come apart when their contacts cannot hold them
    Above,  ///< … when `measure` is above `limit` for `steps`, they slide, or nothing presses
    CutBetween,  ///< … when a weld on the way between them is cut
    OneFrame,    ///< they may merge once one of them comes free of its frame
  };
  Kind kind = Kind::None;
  std::string_view measure{};  ///< a criterion: "relative-motion"
  double limit = 0.0;          ///< in the unit of the criterion
  int steps = 0;
};
/// "below-more", … as in the JSON.
const char* name(Condition::Kind kind);
/// "They merge when …", or nothing.
std::string sentence(const Condition& condition);

Condition conditionOf(const Explanation& explanation);

/// Everything about a pair that the step says, also where nothing was tested: they do not touch,
/// are welded by way of others, sleep.
struct PairReason {
  /// The name of an Outcome; or of a pair without tests "absent", "one", "one-asleep",
  /// "by-others", "no-touch", "asleep" or "untested".
  std::string_view outcome{};
  std::string heading{};  ///< "Came apart", "Stayed apart", …
  std::string text{};
  Condition condition{};
  std::vector<Decision> tests{};
  std::vector<Group> groups{};
};
PairReason reasonFor(const Words& words, const Snapshot& after, BodyId a, BodyId b);

/// An object with these, each test with its name, value, threshold, verdict and sentence.
void writeReason(JsonText& out, const Words& words, const PairReason& reason);

}  // namespace merge2d
