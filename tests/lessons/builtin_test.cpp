/// The lessons tell the truth: what each expects does happen, and its page can be made.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "lessons/folder.h"
#include "lessons/lesson.h"
#include "lessons/page.h"

namespace merge2d {

/// Says in a test's output which lesson it is.
void PrintTo(const BuiltinLesson& lesson, std::ostream* out) { *out << lesson.name; }

namespace {

using ::testing::IsEmpty;

class BuiltinLessons : public testing::TestWithParam<BuiltinLesson> {};

TEST_P(BuiltinLessons, TellTheTruth) {
  const Lesson lesson = loadLesson(GetParam().folder);
  std::vector<Recording> recordings = recordLesson(lesson);
  EXPECT_THAT(failures(lesson, recordings), IsEmpty());
  EXPECT_GE(lesson.expectations.size(), 3u);

  const std::string json = lessonJson(lesson, recordings);
  const auto parsed = nlohmann::json::parse(json);
  int questions = 0;
  for (const auto& part : parsed["parts"]) {
    for (const auto& question : part["questions"]) {
      ++questions;
      EXPECT_GT(question["reveal"], part["step"]) << part["title"];
      int right = question.contains("number") ? 1 : 0;
      for (const auto& option : question["options"]) right += option["right"] ? 1 : 0;
      EXPECT_GT(right, 0) << part["title"];
    }
  }
  EXPECT_GT(questions, 0);

  PageContent content{.title = lesson.title, .lesson = json, .traces = {}};
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    content.traces.push_back({lesson.traces[i].label, std::move(recordings[i])});
  }
  EXPECT_LE(makePage(content, false).size(), kPageBytes);
  EXPECT_LE(makePage(content).size(), kLivePageBytes);
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinLessons, testing::ValuesIn(builtinLessons()),
                         [](const auto& tested) {
                           std::string name = tested.param.name;
                           std::erase_if(name, [](char c) { return !std::isalnum(c); });
                           return name;
                         });

TEST(BuiltinLessonList, HasTwelveInOrderEachWithItsOwnName) {
  const std::vector<BuiltinLesson> lessons = builtinLessons();
  EXPECT_EQ(lessons.size(), 12u);
  std::set<std::string> names;
  for (const BuiltinLesson& lesson : lessons) {
    EXPECT_TRUE(names.insert(lesson.name).second) << lesson.name;
    EXPECT_NE(lesson.title, lesson.name);
  }
  EXPECT_EQ(lessons.front().name, "one-step");
}

/// Titles are taken from the files when the program is built (cmake/embed.cmake).
TEST(BuiltinLessonList, HasTheTitlesThatParsingGives) {
  for (const BuiltinLesson& lesson : builtinLessons()) {
    EXPECT_EQ(lesson.title, loadLesson(lesson.folder).title) << lesson.name;
  }
  for (const EmbeddedFile& file : embeddedLessons()) {
    EXPECT_EQ(file.title.empty(), !file.path.ends_with(".toml")) << file.path;
  }
}

}  // namespace
}  // namespace merge2d
