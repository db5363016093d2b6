/// The example of docs/writing-lessons.md is a lesson, and the tables name what there is.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "lessons/lesson.h"
#include "lessons/page.h"
#include "tests/docs/docs_testing.h"
#include "tests/support/temporary_folder.h"

namespace merge2d::docs {
namespace {

TEST(WritingLessons, TheExampleBecomesAPage) {
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  const Page page = pageOf(read(kRoot / "docs/writing-lessons.md"));
  std::vector<std::string> toml, markdown;
  for (const Block& block : page.blocks) {
    if (block.language == "toml") toml.push_back(block.text);
    if (block.language == "markdown") markdown.push_back(block.text);
  }
  ASSERT_EQ(toml.size(), 2u);
  ASSERT_EQ(markdown.size(), 1u);
  std::ofstream(folder / "text.md") << markdown[0];
  std::ofstream(folder / "scene.toml") << toml[0];
  std::ofstream(folder / "lesson.toml") << toml[1];

  const Lesson lesson = loadLesson(folder);
  std::vector<Recording> recordings = recordLesson(lesson);
  EXPECT_THAT(failures(lesson, recordings), testing::IsEmpty());
  PageContent content{
      .title = lesson.title, .lesson = lessonJson(lesson, recordings), .traces = {}};
  content.traces.push_back({"as it is", std::move(recordings[0])});
  EXPECT_THAT(makePage(content), testing::HasSubstr("<title>Two boxes become one</title>"));
}

}  // namespace
}  // namespace merge2d::docs
