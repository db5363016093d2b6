/// `merge2d lesson`: pages and where they go.

#include <gmock/gmock.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST_F(ProgramTest, LessonWritesAPageOfAScene) {
  write("ball.toml", "format = 1\ntitle = \"A ball\"\n[[body]]\ncircle = 0.5\n");
  const Outcome outcome = run({"lesson", "ball.toml", "--steps", "10"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "frames/ball/lesson.html\n");
  EXPECT_THAT(read("frames/ball/lesson.html"), StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(read("frames/ball/lesson.html"), HasSubstr("<title>A ball</title>"));
}

TEST_F(ProgramTest, LessonReplacesAPageButNoForeignFile) {
  write("ball.toml", "format = 1\n[[body]]\ncircle = 0.5\n");
  EXPECT_EQ(run({"lesson", "ball.toml", "--steps", "1", "-o", "page.html"}).code, 0);
  EXPECT_EQ(run({"lesson", "ball.toml", "--steps", "2", "-o", "page.html"}).code, 0);
  write("page.html", "<!DOCTYPE html>\n<p>Mine.</p>\n");
  EXPECT_EQ(run({"lesson", "ball.toml", "--steps", "1", "-o", "page.html"}).code, 2);
  EXPECT_EQ(read("page.html"), "<!DOCTYPE html>\n<p>Mine.</p>\n");
}

/// The simulation would fail with another message.
TEST_F(ProgramTest, LessonRefusesItsFileBeforeItSimulates) {
  write("flea.toml", kDiverging);
  write("page.html", "mine");
  EXPECT_EQ(run({"lesson", "flea.toml"}).code, 1);
  EXPECT_EQ(run({"lesson", "flea.toml", "-o", "page.html"}).code, 2);
  EXPECT_EQ(run({"lesson", "flea.toml", "-o", "/proc/page.html"}).code, 4);
  EXPECT_EQ(files(), (Words{"flea.toml", "page.html"})) << "nor is a folder left";
}

TEST_F(ProgramTest, LessonSuggestsLessonsAndScenes) {
  const auto refusal = [&](const char* name) {
    const Outcome outcome = run({"lesson", name});
    EXPECT_EQ(outcome.code, 3);
    return outcome.err;
  };
  EXPECT_THAT(refusal("cyclos"), HasSubstr("no built-in lesson or scene is called 'cyclos' "
                                           "(did you mean 'cycles'?)"));
  EXPECT_THAT(refusal("tower-platfrm"), HasSubstr("(did you mean 'tower-platform'?)"));
  EXPECT_THAT(refusal("ball.toml"), HasSubstr("there is no file ball.toml"));
}

TEST_F(ProgramTest, LessonNamesTheLanguagesOfThePage) {
  const Outcome unknown = run({"lesson", "books", "--language", "dd"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("--language must be en, de or fr, but is 'dd'"));
}

TEST_F(ProgramTest, LessonCarriesTheEngineUnlessItIsLeftOut) {
  write("ball.toml", "format = 1\n[[body]]\ncircle = 0.5\n");
  EXPECT_EQ(run({"lesson", "ball.toml", "--steps", "2", "-o", "live.html"}).code, 0);
  EXPECT_EQ(run({"lesson", "ball.toml", "--steps", "2", "-o", "still.html", "--no-live"}).code, 0);
  EXPECT_THAT(read("live.html"), HasSubstr("wasm-unsafe-eval"));
  EXPECT_THAT(read("still.html"), Not(HasSubstr("wasm-unsafe-eval")));
  EXPECT_GT(read("live.html").size(), read("still.html").size() + 500'000);
  EXPECT_LE(read("live.html").size(), 1'600'000u);
}

TEST_F(ProgramTest, LessonsGoByTheirNamesWhereScenesDo) {
  EXPECT_THAT(run({"run", "one-step", "--steps", "5"}).out,
              HasSubstr("scene               one-step"));
  EXPECT_EQ(run({"explain", "cycles", "--at", "20"}).code, 0);
  EXPECT_THAT(run({"validate", "one-step"}).out, HasSubstr("of 5 expectations hold"));
}

TEST_F(ProgramTest, ValidateFindsWhatIsWrongWithALesson) {
  fs::create_directory(*this / "mine");
  write("mine/scene.toml", "format = 1\nduration = 0.5\n[[body]]\nname = \"ball\"\ncircle = 0.5\n");
  write("mine/text.md", "## One\n![a picture](ball.png)\n");
  const std::string lesson =
      "format = 1\ntitle = \"Mine\"\nscene = \"scene.toml\"\n[[part]]\nsection = \"One\"\nat = "
      "\"0.2 s\"\n[part.question]\nask = \"?\"\nchoices = [\"a\", \"b\"]\nanswer = 1\nreveal = "
      "\"0.1 s\"\n";
  write("mine/lesson.toml", lesson);
  const Outcome doubtful = run({"validate", "mine"});
  EXPECT_EQ(doubtful.code, 0) << doubtful.err;
  EXPECT_THAT(doubtful.err, HasSubstr("step 20 is revealed at step 10"));
  EXPECT_THAT(doubtful.err, HasSubstr("no pictures of files"));
  write("mine/lesson.toml", lesson +
                                "[[expect]]\nmeasure = \"y of ball\"\nat = \"end\"\n"
                                "between = [5, 6]\n");
  const Outcome wrong = run({"validate", "mine"});
  EXPECT_EQ(wrong.code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("not between 5 and 6"));
}

TEST_F(ProgramTest, LessonAndFramesShareAFolder) {
  write("ball.toml", "format = 1\n[[body]]\ncircle = 0.5\n");
  EXPECT_EQ(run({"lesson", "ball.toml", "--steps", "5"}).code, 0);
  const Outcome outcome = run({"render", "ball.toml", "--steps", "5", "-q", "l"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(*this / "frames/ball/lesson.html"));
}

}  // namespace
}  // namespace merge2d
