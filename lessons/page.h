#pragma once
/// One HTML file that holds everything: program, style, text and recordings. It asks the network
/// for nothing.

#include <string>
#include <vector>

#include "lessons/recording.h"

namespace merge2d {

/// A recording under the name by which the page offers it.
struct NamedRecording {
  std::string label;
  Recording recording;
};

struct PageContent {
  std::string title;
  std::string lesson;  ///< a JSON object: text, parts and questions; "null" for a plain scene
  std::vector<NamedRecording> traces;  ///< the first is the one that is shown
};

/// Built-in pages stay below this size [bytes].
inline constexpr std::size_t kPageBytes = 3'000'000;

/// The page, as fine as fits into kPageBytes. With the engine in it one can take over a run; its
/// size counts extra.
std::string makePage(const PageContent& content, bool live = true);

/// The text with the characters that mean something to HTML written as references.
std::string escapedHtml(std::string_view text);

}  // namespace merge2d
