#pragma once
/// A lesson as its folder says it: `lesson.toml`, `text.md`, and a scene. docs/writing-lessons.md
/// is the manual.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lessons/expectation.h"
#include "lessons/lesson_trace.h"
#include "lessons/question.h"
#include "src2d/scene/data_folder.h"

namespace merge2d {

/// A section of the text, and what the picture shows beside it.
struct LessonPart {
  std::string title;
  std::string html;
  Moment at;
  std::string stage;  ///< of Algorithm 1; empty: the step as a whole
  std::vector<std::string> layers;
  std::vector<BodyId> select;  ///< none, a body, or a pair
  std::size_t trace = 0;
  std::vector<Question> questions;  ///< asked one after the other
};

struct Lesson {
  std::string name;  ///< of the folder, without its number
  std::string title, summary;
  int minutes = 0;
  std::string intro;  ///< HTML
  std::vector<LessonTrace> traces;
  std::vector<LessonPart> parts;
  std::vector<Expectation> expectations;

  struct Source;
  std::shared_ptr<const Source> source;  ///< what the places of errors refer to
};

/// Reads a lesson's folder. Throws InputError with file, line and column; IoError.
Lesson loadLesson(const DataFolder& folder);

/// Simulates everything that the lesson shows.
std::vector<Recording> recordLesson(const Lesson& lesson,
                                    const std::function<void(std::int64_t)>& progress = nullptr);

/// One sentence for each expectation that does not hold.
std::vector<std::string> failures(const Lesson& lesson, const std::vector<Recording>& recordings);

/// The lesson as JSON for the page; questions are answered from the recordings. Throws
/// InputError where a moment does not happen.
std::string lessonJson(const Lesson& lesson, const std::vector<Recording>& recordings);

struct BuiltinLesson {
  std::string name;
  std::string title;
  DataFolder folder;
};
/// The lessons that come with the program and those in the data folders, in the order of their
/// folders.
std::vector<BuiltinLesson> builtinLessons();

}  // namespace merge2d
