#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/program.h"
#include "render/png.h"
#include "src2d/trace/snapshot.h"
#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

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

/// Going back begins with another world; names, tables and pictures must not ask the first one.
TEST_F(Step, EverythingCanBeAskedAfterGoingBack) {
  for (const std::string back : {"back 2", "jump 2"}) {
    for (const std::string question : {"table", "why", "body box[0,1]", "pair box[0,0] box[0,1]",
                                       "picture then.png", "stages"}) {
      const Outcome outcome = follow("step 5\n" + back + "\n" + question + "\n");
      EXPECT_EQ(outcome.code, 0) << back << ", " << question << ": " << outcome.err;
      EXPECT_THAT(outcome.err, IsEmpty());
      std::filesystem::remove(folder() / "then.png");
    }
  }
  const std::string forward = follow("step 2\nwhy\n").out,
                    again = follow("step 5\nback 3\nwhy\n").out;
  EXPECT_EQ(forward.substr(forward.find("> why")), again.substr(again.find("> why")));
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

TEST_F(Step, WithJsonEachCommandIsAnsweredByAnObject) {
  const Outcome outcome = follow("step 3\nstage\nset step=0.005\nstep\nstpe\n", {"--json"});
  EXPECT_EQ(outcome.code, kWrongUsage);
  std::vector<nlohmann::json> answers;
  for (const std::string& line : linesOf(outcome.out))
    answers.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(answers.size(), 6U);
  EXPECT_EQ(answers[0]["command"], "");
  EXPECT_THAT(answers[0]["text"].get<std::string>(), HasSubstr("Three boxes"));
  EXPECT_EQ(answers[1]["step"], 3);
  EXPECT_DOUBLE_EQ(answers[1]["time"], 0.03);
  EXPECT_EQ(answers[2]["step"], 4);
  EXPECT_EQ(answers[2]["stage"], "ContactDetection");
  EXPECT_NEAR(answers[4]["time"].get<double>(), 0.045, 1e-12);
  EXPECT_EQ(answers[5]["ok"], false);
}

TEST_F(Step, RenderDrawsTheElevenStagesOfAStep) {
  const Words arguments = {"render", "stack.toml", "--stages",        "--at", "5", "-r", "320x180",
                           "-o",     "out",        "--contact-sheet", "4x3"};
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "out/stages\n");
  const Words names = files("out/stages");
  ASSERT_EQ(names.size(), 13U);
  EXPECT_EQ(names[0], "step_000005.png");
  EXPECT_EQ(names[1], "step_000005.vtt");
  EXPECT_EQ(names[2], "step_000005_01_ContactDetection.png");
  EXPECT_EQ(names[12], "step_000005_11_Merge.png");
  EXPECT_EQ(run({"render", "stack.toml", "--stages"}).code, kWrongUsage);
  EXPECT_EQ(run({"render", "stack.toml", "--at", "5"}).code, kWrongUsage);
}

TEST_F(Step, StagePicturesHaveCaptionsOfASecondEach) {
  const Words arguments = {"render", "stack.toml", "--stages", "--at", "5",
                           "-r",     "160x90",     "-o",       "out"};
  ASSERT_EQ(run(arguments).code, 0);
  const std::string captions = read("out/stages/step_000005.vtt");
  const Words lines = linesOf(captions);
  ASSERT_EQ(lines.size(), 1U + kStages * 3U);
  EXPECT_EQ(lines[0], "WEBVTT");
  for (std::size_t i = 0; i < kStages; ++i) {
    EXPECT_EQ(lines[1 + 3 * i], "");
    EXPECT_EQ(lines[2 + 3 * i], fmt::format("00:00:{:02}.000 --> 00:00:{:02}.000", i, i + 1));
    EXPECT_THAT(lines[3 + 3 * i], HasSubstr(fmt::format("Step 5, stage {} of {}, {}: ", i + 1,
                                                        kStages, name(static_cast<Stage>(i)))));
  }
  // They replace those of an earlier rendering, but nothing else.
  EXPECT_EQ(run(arguments).code, 0);
  write("out/stages/step_000005.vtt", "notes of mine\n");
  EXPECT_NE(run(arguments).code, 0);
  EXPECT_EQ(read("out/stages/step_000005.vtt"), "notes of mine\n");
}

TEST_F(Step, RenderLeavesForeignPicturesAlone) {
  const Words sheet = {"--contact-sheet", "2x1", "-r", "320x180", "-o", "out"};
  Words stages = {"render", "stack.toml", "--stages", "--at", "5"};
  Words frames = {"render", "stack.toml", "--steps", "1"};
  for (Words* arguments : {&stages, &frames}) {
    arguments->insert(arguments->end(), sheet.begin(), sheet.end());
    EXPECT_EQ(run(*arguments).code, 0);
  }
  const Words before = files("out");
  for (const char* file : {"stages/step_000005_11_Merge.png", "stages/step_000005.png"}) {
    const std::string ours = read(std::string("out/") + file);
    write(std::string("out/") + file, "mine");
    EXPECT_EQ(run(stages).code, kWrongUsage) << file;
    EXPECT_EQ(read(std::string("out/") + file), "mine");
    write(std::string("out/") + file, ours);
  }
  write("out/contact_sheet.png", "mine");
  EXPECT_EQ(run(frames).code, kWrongUsage);
  EXPECT_EQ(read("out/contact_sheet.png"), "mine");
  EXPECT_EQ(files("out"), before) << "nor does anything else go";
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
