/// Lessons as people write them, with the mistakes that people make.

#include "lessons/lesson.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lessons/markdown.h"
#include "src2d/core/error.h"
#include "tests/support/temporary_folder.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr const char* kScene = R"(
format = 1
duration = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [10, 1]
[[body]]
name = "low"
at = [0, 0.25]
box = [1, 0.5]
[[body]]
name = "high"
at = [0, 0.75]
box = [1, 0.5]
)";

constexpr const char* kHead = R"(format = 1
title = "Two boxes"
scene = "scene.toml"
mode = "merge"
[[part]]
section = "One"
at = "start"
)";

/// Folders of lessons, gone afterwards.
class LessonFolder : public testing::Test {
 protected:
  LessonFolder() : folder_(temporary_.path()) {
    write("scene.toml", kScene);
    write("text.md", "Hello.\n\n## One\nSome *text*.\n");
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  Lesson load(const std::string& more) const {
    write("lesson.toml", kHead + more);
    return loadLesson(folder_);
  }
  std::string errorOf(const std::string& more) const {
    try {
      load(more);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  std::vector<std::string> failuresOf(const std::string& expectation) const {
    const Lesson lesson = load("[[expect]]\n" + expectation);
    return failures(lesson, recordLesson(lesson));
  }

  const TemporaryFolder temporary_;
  const fs::path folder_;
};

TEST_F(LessonFolder, BecomesPartsOfHtml) {
  const Lesson lesson = load("");
  EXPECT_EQ(lesson.title, "Two boxes");
  EXPECT_EQ(lesson.intro, "<p>Hello.</p>\n");
  ASSERT_THAT(lesson.parts, SizeIs(1));
  EXPECT_EQ(lesson.parts[0].html, "<p>Some <em>text</em>.</p>\n");
}

TEST_F(LessonFolder, MistakesAreShownWhereTheyAre) {
  EXPECT_THAT(errorOf("at2 = 1\n"), HasSubstr("lesson.toml:8:1: unknown key 'at2'"));
  EXPECT_THAT(
      errorOf("stage = \"Murge\"\n"),
      HasSubstr("lesson.toml:8:9: Algorithm 1 has no stage 'Murge' (did you mean 'Merge'?)"));
  EXPECT_THAT(errorOf("select = [\"hih\"]\n"),
              HasSubstr("lesson.toml:8:11: the scene has no body 'hih' (did you mean 'high'?)"));
  EXPECT_THAT(errorOf("[part.question]\nask = \"?\"\nthreshold = \"relative-motion\"\n"
                      "pair = [\"low\", \"hih\"]\nreveal = \"end\"\n"),
              HasSubstr("lesson.toml:11:16: the scene has no body 'hih' (did you mean 'high'?)"));
  EXPECT_THAT(errorOf("layers = [\"force\"]\n"), HasSubstr("(did you mean 'forces'?)"));
  EXPECT_THAT(errorOf("[[expect]]\nat = \"end\"\nmeasure = \"hight of low\"\nbetween = [0, 1]\n"),
              HasSubstr("lesson.toml:10:11: 'hight' cannot be measured"));
  EXPECT_THAT(errorOf("[[expect]]\nat = \"end\"\n"), HasSubstr("exactly one of together"));
  EXPECT_THAT(errorOf("[[expect]]\nhappens = \"first murge\"\n"),
              HasSubstr("'murge' is no moment and no event (did you mean 'merge'?)"));
  EXPECT_THAT(errorOf("[[expect]]\nhappens = \"first unmerge by cycle\"\n"),
              HasSubstr("'cycle' is no reason"))
      << "no weld ends by it";
  EXPECT_THAT(errorOf("[part.question]\nask = \"?\"\nreveal = \"end\"\n"),
              HasSubstr("a question has exactly one of choices"));
}

TEST_F(LessonFolder, SectionsAndPartsMustMatch) {
  write("text.md", "## One\n\n## Two\n");
  EXPECT_THAT(errorOf(""),
              HasSubstr("text.md:3:1: lesson.toml has no [[part]] with section = \"Two\""));
  write("text.md", "## On\n");
  EXPECT_THAT(errorOf(""),
              HasSubstr("lesson.toml:6:11: text.md has no section '## One' (did you mean 'On'?)"));
}

TEST_F(LessonFolder, AMissingFileIsNamed) {
  EXPECT_THROW(loadLesson(folder_), InputError);  // no lesson.toml
}

TEST_F(LessonFolder, ExpectationsThatHoldAreSilent) {
  EXPECT_THAT(failuresOf("together = [\"low\", \"high\"]\nat = \"end\"\n"), IsEmpty());
  EXPECT_THAT(failuresOf("apart = [\"low\", \"high\"]\nat = \"start\"\n"), IsEmpty());
  EXPECT_THAT(failuresOf("free = [\"low\"]\nat = \"start\"\n"), IsEmpty());
  EXPECT_THAT(failuresOf("happens = \"first union of low and high\"\nbetween = [0.01, 0.2]\n"),
              IsEmpty());
  EXPECT_THAT(failuresOf("never = \"unmerge\"\n"), IsEmpty());
  EXPECT_THAT(failuresOf("measure = \"y of high\"\nat = \"0.5 s\"\nbetween = [0.74, 0.76]\n"),
              IsEmpty());
}

TEST_F(LessonFolder, AFixedBodyIsTogetherWithWhatIsWeldedToIt) {
  EXPECT_THAT(failuresOf("together = [\"ground\", \"low\"]\nat = \"end\"\n"), IsEmpty());
  EXPECT_THAT(failuresOf("together = [\"high\", \"ground\"]\nat = \"end\"\n"), IsEmpty());
  EXPECT_THAT(failuresOf("together = [\"ground\", \"low\"]\nat = \"start\"\n"),
              ElementsAre(HasSubstr("at step 0 low is in no collection")));
}

TEST_F(LessonFolder, ExpectationsThatDoNotHoldSayWhatIs) {
  EXPECT_THAT(failuresOf("apart = [\"low\", \"high\"]\nat = \"end\"\n"),
              ElementsAre(HasSubstr("low and high are in one collection")));
  EXPECT_THAT(failuresOf("happens = \"first unmerge\"\n"),
              ElementsAre(HasSubstr("it does not happen")));
  EXPECT_THAT(failuresOf("never = \"merge\"\n"), ElementsAre(HasSubstr("it does happen, at step")));
  EXPECT_THAT(failuresOf("asleep = [\"low\"]\nat = \"end\"\n"),
              ElementsAre(HasSubstr("low is awake")));
  EXPECT_THAT(failuresOf("measure = \"collections\"\nat = \"end\"\nbetween = [5, 6]\n"),
              ElementsAre(HasSubstr("it is 1, not between 5 and 6")));
}

constexpr const char* kOther = R"([[trace]]
label = "a fall"
scene = "fall.toml"
seconds = 0.2
mode = "reference"
)";

/// The bodies of one scene are not those of the other.
class LessonOfTwoScenes : public LessonFolder {
 protected:
  LessonOfTwoScenes() {
    write("fall.toml", "format = 1\n[[body]]\nname = \"stone\"\nat = [0, 5]\ncircle = 0.5\n");
    write("text.md", "## One\n## Two\n");
  }
  static std::string partTwo(const std::string& more) {
    return kOther + std::string("[[part]]\nsection = \"Two\"\ntrace = \"a fall\"\n") + more;
  }
};

TEST_F(LessonOfTwoScenes, APartShowsTheSceneOfItsTrace) {
  const Lesson lesson =
      load(partTwo("at = \"end\"\nselect = [\"stone\"]\n"
                   "[[expect]]\ntrace = \"a fall\"\nat = \"0.2 s\"\n"
                   "measure = \"y of stone\"\nbetween = [4.79, 4.8]\n"));
  ASSERT_THAT(lesson.traces, SizeIs(2));
  EXPECT_EQ(lesson.traces[0].world, 0U);
  EXPECT_EQ(lesson.traces[1].world, 1U);
  EXPECT_EQ(lesson.traces[1].scene_name, "fall.toml");
  EXPECT_DOUBLE_EQ(lesson.traces[1].scene.duration, 0.2);
  const auto recordings = recordLesson(lesson);
  EXPECT_THAT(failures(lesson, recordings), IsEmpty()) << "g t² / 2 = 0.196 m, and h g t / 2 more";
  const auto json = nlohmann::json::parse(lessonJson(lesson, recordings));
  EXPECT_EQ(json["parts"][1]["step"], 20);
  EXPECT_EQ(json["parts"][1]["trace"], 1);
}

TEST_F(LessonOfTwoScenes, NamesOfBodiesAreThoseOfItsScene) {
  EXPECT_THAT(errorOf(partTwo("at = \"first impact of low\"\n")),
              HasSubstr("the scene has no body 'low'"));
  EXPECT_THAT(errorOf(partTwo("at = \"end\"\nselect = [\"low\"]\n")),
              HasSubstr("the scene has no body 'low'"));
  EXPECT_THAT(errorOf(partTwo("at = \"end\"\n[[expect]]\nfree = [\"stone\"]\nat = \"end\"\n")),
              HasSubstr("the scene has no body 'stone'"));
  EXPECT_THAT(
      errorOf("[[trace]]\nlabel = \"x\"\nscene = \"bokos\"\n"),
      HasSubstr("lesson.toml:10:9: there is no built-in scene 'bokos' (did you mean 'books'?)"));
  EXPECT_THAT(errorOf("[[trace]]\nlabel = \"x\"\nscene = \"none.toml\"\n"),
              HasSubstr("there is no file 'none.toml' in the lesson's folder"));
}

TEST_F(LessonFolder, AQuestionIsAnsweredByTheSimulation) {
  const Lesson lesson =
      load("[part.question]\nask = \"How many?\"\ncollections = true\nreveal = \"end\"\n");
  const auto json = nlohmann::json::parse(lessonJson(lesson, recordLesson(lesson)));
  const auto& options = json["parts"][0]["questions"][0]["options"];
  EXPECT_FALSE(options[0]["right"]);
  EXPECT_EQ(options[1]["text"], "1");
  EXPECT_TRUE(options[1]["right"]);
}

TEST_F(LessonFolder, ANumberIsMeasuredInTheSimulation) {
  const Lesson lesson = load(
      "[part.question]\nask = \"How high?\"\nmeasure = \"collections\"\ntolerance = 0.5\n"
      "unit = \"of them\"\nreveal = \"end\"\n");
  const auto json = nlohmann::json::parse(lessonJson(lesson, recordLesson(lesson)));
  const auto& question = json["parts"][0]["questions"][0];
  EXPECT_EQ(question["number"]["value"], 1.0);
  EXPECT_EQ(question["number"]["tolerance"], 0.5);
  EXPECT_EQ(question["because"], "It is 1 of them.");
}

TEST_F(LessonFolder, APartAsksSeveralQuestionsInTurn) {
  const Lesson lesson = load(
      "[[part.questions]]\nask = \"First?\"\ncollections = true\nreveal = \"step 2\"\n"
      "[[part.questions]]\nask = \"Second?\"\ncollections = true\nreveal = \"end\"\n");
  const auto json = nlohmann::json::parse(lessonJson(lesson, recordLesson(lesson)));
  const auto& questions = json["parts"][0]["questions"];
  ASSERT_EQ(questions.size(), 2u);
  EXPECT_EQ(questions[0]["ask"], "First?");
  EXPECT_EQ(questions[1]["ask"], "Second?");
}

TEST_F(LessonFolder, AMomentThatDoesNotHappenIsAnErrorWithItsPlace) {
  write("lesson.toml",
        std::string(kHead).replace(std::string(kHead).find("start"), 5, "last unmerge"));
  const Lesson lesson = loadLesson(folder_);
  try {
    lessonJson(lesson, recordLesson(lesson));
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("lesson.toml:7:6: 'last unmerge' does not happen"));
  }
}

TEST(Markdown, RawHtmlIsLeftOut) {
  const std::string html =
      markdownToHtml("Hi <script>alert(1)</script> [x](javascript:alert(1))\n");
  EXPECT_THAT(html, Not(HasSubstr("<script>")));
  EXPECT_THAT(html, Not(HasSubstr("javascript:")));
}

}  // namespace
}  // namespace merge2d
