#pragma once
/// Why two bodies are one or not, and the change that would alter it: for pages and terminals.

#include <string>

#include "lessons/explain.h"
#include "src2d/trace/json_text.h"
#include "src2d/trace/recorder.h"

namespace merge2d {

/// The condition of the other outcome: "They merge when …". Empty where the step says nothing about
/// it.
std::string outlook(const Explanation& explanation);

/// Everything about a pair that the step says, also where nothing was tested: they do not touch,
/// are welded by way of others, sleep.
struct PairReason {
  std::string heading;  ///< "Came apart", "Stayed apart", …
  std::string text, outlook;
  std::vector<Decision> tests;
  std::vector<Group> groups;
};
PairReason reasonFor(const Words& words, const Snapshot& after, BodyId a, BodyId b);

/// An object with these, each test with its name, value, threshold, verdict and sentence.
void writeReason(JsonText& out, const Words& words, const PairReason& reason);

}  // namespace merge2d
