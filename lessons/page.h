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
  std::size_t world = 0;  ///< the same for recordings of the same scene
};

/// Where a lesson stands in a course: one page leads to the next.
struct CoursePlace {
  int number = 0, of = 0;
  std::string next_title, next_file;  ///< empty after the last one
};

struct PageContent {
  std::string title;
  std::string lesson;  ///< a JSON object: text, parts and questions; "null" for a plain scene
  std::vector<NamedRecording> traces;  ///< the first is the one that is shown
  CoursePlace course{};                ///< number 0: it stands alone
  std::string language = "en";         ///< of the page's own words: en, de or fr
  bool embed = false;                  ///< compact, for slides, notebooks and frames in other pages
};

/// Built-in pages stay below this size [bytes].
inline constexpr std::size_t kPageBytes = 3'000'000;
/// The same for a page with the engine.
inline constexpr std::size_t kLivePageBytes = 4'000'000;

/// The page, as fine as fits into kPageBytes, or into kLivePageBytes with the engine in it, by
/// which one can take over a run.
std::string makePage(const PageContent& content, bool live = true);

/// The list of a course's pages.
struct CourseEntry {
  std::string title, summary, file;
  int minutes = 0;
};
std::string makeCourseIndex(const std::vector<CourseEntry>& entries);

/// The text with the characters that mean something to HTML written as references.
std::string escapedHtml(std::string_view text);

}  // namespace merge2d
