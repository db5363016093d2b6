#pragma once
/// The decisions of one step about each pair of bodies, with their reasons: the decision records
/// put into sentences. Nothing is tested anew here.

#include <string>
#include <vector>

#include "lessons/words.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

/// In the order in which they are told.
enum class Outcome {
  CameApart,  ///< a weld ended
  Merged,     ///< a pair was welded
  Hit,        ///< a pair met
  Woke,
  Slept,
  Cut,      ///< a weld is cut, but others hold the pair together
  Loose,    ///< a weld on its way to be cut
  Waiting,  ///< a pair passed all tests, but not for long enough, or its group is not rigid
  Apart,    ///< a pair failed a test
  Awake,    ///< something could not fall asleep
  Held,     ///< a weld holds
  Opened,   ///< a collection of which members take part in the full solve of this step
  Sought,   ///< a collection about whose load nothing is known yet
  Carried,  ///< a collection whose load its contacts are known to carry
};
inline constexpr std::size_t kOutcomes = 14;

/// "came-apart", "merged", … as in the JSON.
const char* name(Outcome outcome);
/// "came apart", … as a heading over several.
const char* heading(Outcome outcome);

struct Explanation {
  BodyId a{}, b{};  ///< the pair; equal where one thing is meant
  Outcome outcome = Outcome::Held;
  EventReason reason = EventReason::None;  ///< of a weld that ended
  std::string text{};                      ///< one sentence or two
  std::vector<Decision> tests{};           ///< behind it, in the order they were made
  std::vector<Group> groups{};  ///< of which the tests tell: what Decision::members indexes
};

/// Explains all decisions of the step after which `after` was captured; by outcome, and
/// within one what lost its count or is near its threshold first.
std::vector<Explanation> explainStep(const Words& words, const Snapshot& after);

/// How far a test is above its threshold: 1 is just there; 0 for waits and times, which are no
/// measure of motion.
double closeness(const Decision& test);

/// The test with the largest value / threshold. Null when there is none.
const Decision* nearestTest(const std::vector<Decision>& tests);

}  // namespace merge2d
