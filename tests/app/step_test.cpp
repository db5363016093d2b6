#include <gmock/gmock.h>

#include "app/program.h"
#include "render/png.h"
#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Step : public ProgramTest {
 protected:
  Step() { write("stack.toml", kStack); }

  Outcome follow(const std::string& script, Words arguments = {}) {
    sendInput(script);
    arguments.insert(arguments.begin(), {"step", "stack.toml"});
    return run(arguments);
  }
};

TEST_F(Step, FollowsAScriptAndRepeatsItsLines) {
  const Outcome outcome = follow("step 3\nstage\ntable\nback\n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("Three boxes: 4 bodies, 50 steps of 0.01 s, merge+sleep."));
  EXPECT_THAT(outcome.out, HasSubstr("\nstart > step 3\nstep 3, t = 0.03 s: "));
  EXPECT_THAT(outcome.out, HasSubstr("\nstep 4 ContactDetection > table\nContactDetection: "));
  EXPECT_THAT(outcome.out, HasSubstr("\nstep 4 ContactDetection > back\nstep 3, "));
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(Step, TheSameScriptGivesTheSameText) {
  const std::string script = "event\ntable\nwhy\nstages\n";
  EXPECT_EQ(follow(script).out, follow(script).out);
}

TEST_F(Step, DrawsAStage) {
  const Outcome outcome = follow("jump 5 SolveLCP\npicture solve.png\njump 0\npicture start.png\n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* file : {"solve.png", "start.png"}) {
    const PngSummary summary = inspectPng(readFileBytes(*this / file));
    EXPECT_TRUE(summary.complete);
    EXPECT_EQ(summary.width, 1280);
  }
}

TEST_F(Step, LeavesForeignFilesAlone) {
  write("notes.png", "not a picture");
  const Outcome outcome = follow("step\npicture notes.png\n");
  EXPECT_EQ(outcome.code, kWrongUsage);
  EXPECT_THAT(outcome.out, HasSubstr("notes.png is there already and is no picture"));
  EXPECT_EQ(read("notes.png"), "not a picture");
  EXPECT_EQ(follow("step\npicture notes.png\n", {"--force"}).code, 0);
}

TEST_F(Step, ALineThatIsNotUnderstoodEndsWithAnError) {
  const Outcome outcome = follow("stp\nstep\n");
  EXPECT_EQ(outcome.code, kWrongUsage);
  EXPECT_THAT(outcome.out, HasSubstr("did you mean 'step'?"));
  EXPECT_THAT(outcome.out, HasSubstr("step 1, t = 0.01 s"));
  EXPECT_THAT(outcome.err, HasSubstr("a command could not be done"));
}

TEST_F(Step, RenderDrawsTheElevenStagesOfAStep) {
  const Words arguments = {"render", "stack.toml", "--stages",        "--at", "5", "-r", "320x180",
                           "-o",     "out",        "--contact-sheet", "4x3"};
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "out/stages\n");
  const Words names = files("out/stages");
  ASSERT_EQ(names.size(), 12U);
  EXPECT_EQ(names[0], "step_000005.png");
  EXPECT_EQ(names[1], "step_000005_01_ContactDetection.png");
  EXPECT_EQ(names[11], "step_000005_11_Merge.png");
  EXPECT_EQ(run({"render", "stack.toml", "--stages"}).code, kWrongUsage);
  EXPECT_EQ(run({"render", "stack.toml", "--at", "5"}).code, kWrongUsage);
}

TEST_F(Step, RenderMakesAContactSheet) {
  const Outcome outcome = run({"render", "stack.toml", "-r", "320x180", "--fps", "20", "-o", "out",
                               "--contact-sheet", "3x2"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const PngSummary sheet = inspectPng(readFileBytes(*this / "out/contact_sheet.png"));
  EXPECT_EQ(sheet.width, 3 * 320 + 2 * 8);
  EXPECT_EQ(sheet.height, 2 * 180 + 8);
  EXPECT_EQ(run({"render", "stack.toml", "--contact-sheet", "3"}).code, kWrongUsage);
  // Another rendering replaces it like the frames.
  EXPECT_EQ(run({"render", "stack.toml", "-r", "320x180", "-o", "out"}).code, 0);
}

}  // namespace
}  // namespace merge2d
