#include "lessons/player.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src2d/core/error.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class PlayerTest : public testing::Test {
 protected:
  PlayerTest()
      : player(column(2), Mode::MergeSleep, 200,
               [this](const StepRecord* record, Stage stage, const std::string& file) {
                 if (file == "no/such.png") throw IoError("cannot write no/such.png");
                 drawn = file + (record ? " " + std::to_string(record->step) + " " + name(stage)
                                        : std::string(" start"));
                 return std::string("a picture");
               }) {}

  std::string say(const std::string& line) {
    const Answer answer = player.run(line);
    EXPECT_TRUE(answer.ok) << line << ": " << answer.text;
    return answer.text;
  }
  std::string refused(const std::string& line) {
    const Answer answer = player.run(line);
    EXPECT_FALSE(answer.ok) << line << ": " << answer.text;
    return answer.text;
  }

  Player player;
  std::string drawn;
};

TEST_F(PlayerTest, GoesByStepsAndBack) {
  EXPECT_THAT(say("step"), StartsWith("step 1, t = 0.01 s: 2 in B"));
  EXPECT_THAT(say("step 10"), StartsWith("step 11, "));
  EXPECT_THAT(say(""), StartsWith("step 12, "));  // the last motion again
  EXPECT_THAT(say("back 2"), StartsWith("step 10, "));
  EXPECT_THAT(say("back 50"), StartsWith("start: "));
  EXPECT_THAT(refused("back"), HasSubstr("this is the start"));
}

TEST_F(PlayerTest, GoesByStagesThroughAlgorithm1) {
  for (std::size_t i = 0; i < kStages; ++i) {
    say("stage");
    EXPECT_EQ(player.step(), 1);
    EXPECT_EQ(player.stage(), static_cast<Stage>(i));
  }
  EXPECT_THAT(say("stage"), StartsWith("step 2, stage 1 of 11, ContactDetection: "));
  say("unstage 2");
  EXPECT_EQ(player.step(), 1);
  EXPECT_EQ(player.stage(), Stage::AdvancePositions);
  EXPECT_THAT(say("step"), StartsWith("step 1, t = "));  // the end of this step
}

TEST_F(PlayerTest, GoesToEventsAndBack) {
  EXPECT_THAT(say("event merge"), HasSubstr(" merge into C"));
  const std::int64_t first = player.step();
  say("event");
  EXPECT_GT(player.step(), first);
  say("unevent merge");
  EXPECT_EQ(player.step(), first);
  EXPECT_THAT(refused("event impact"), HasSubstr("no such event"));
  EXPECT_THAT(refused("event merg"), HasSubstr("did you mean 'merge'?"));
}

TEST_F(PlayerTest, JumpsIntoAStage) {
  EXPECT_THAT(say("jump 20 unm"), StartsWith("step 20, stage 6 of 11, Unmerge: "));
  EXPECT_THAT(say("jump 20 7"), StartsWith("step 20, stage 7 of 11, SolveLCP: "));
  EXPECT_THAT(refused("jump 201"), HasSubstr("the run ends at step 200"));
  EXPECT_THAT(refused("jump 20 Umerge"), HasSubstr("did you mean 'Unmerge'?"));
  EXPECT_THAT(refused("jump x"), HasSubstr("'x' is not a whole number"));
}

TEST_F(PlayerTest, EveryStageHasATable) {
  say("event merge");
  for (std::size_t i = 1; i <= kStages; ++i) {
    const std::string table = say("table " + std::to_string(i));
    EXPECT_THAT(table, StartsWith(name(static_cast<Stage>(i - 1)))) << table;
    EXPECT_THAT(table, Not(HasSubstr("  \n"))) << "blanks at the end of a line";
  }
  EXPECT_THAT(say("table SolveLCP"), HasSubstr("λ_n [N s]"));
  EXPECT_THAT(say("stages"), HasSubstr("11  Merge "));
}

TEST_F(PlayerTest, ShowsABodyAndAPair) {
  say("step");
  EXPECT_THAT(say("body body1"), StartsWith("body1: free; mass 1.00 kg"));
  EXPECT_THAT(say("pair body2 body1"), HasSubstr("body1 and body2 stayed apart at step 1"));
  EXPECT_THAT(refused("body bdy1"), HasSubstr("did you mean 'body1'?"));
  EXPECT_THAT(refused("pair body1"), HasSubstr("two names"));
}

TEST_F(PlayerTest, ExplainsWhatWasDecided) {
  say("event merge");
  EXPECT_THAT(say("why"), HasSubstr("they passed every test for 3 of 3 steps"));
  EXPECT_THAT(say("why ground body2"), HasSubstr("nothing was tested about ground and body2"));
}

TEST_F(PlayerTest, DrawsTheStageWhereItStands) {
  EXPECT_THAT(say("picture a.png"), HasSubstr("a.png: a picture"));
  EXPECT_EQ(drawn, "a.png start");
  say("jump 7 Unmerge");
  say("picture 'a b.png'");
  EXPECT_EQ(drawn, "a b.png 7 Unmerge");
  EXPECT_THAT(refused("picture no/such.png"), HasSubstr("cannot write"));
  EXPECT_THAT(refused("picture a.gif"), HasSubstr("PNG"));
}

TEST_F(PlayerTest, ExplainsItselfAndRefusesNonsense) {
  EXPECT_THAT(say("help"), HasSubstr("stage [N]"));
  EXPECT_THAT(refused("stp"), HasSubstr("there is no command 'stp' (did you mean 'step'?)"));
  EXPECT_THAT(refused("step 1 2"), HasSubstr("'step' takes [N]"));
  EXPECT_THAT(refused("step 0"), HasSubstr("whole number of 1 or more"));
  EXPECT_EQ(say("# a comment"), "");
  say("quit");
  EXPECT_TRUE(player.done());
}

TEST_F(PlayerTest, EndsWhereTheRunEnds) {
  say("jump 199");
  EXPECT_THAT(say("step 5"), StartsWith("step 200, "));
  EXPECT_THAT(refused("step"), HasSubstr("this is the end"));
  EXPECT_THAT(refused("stage"), HasSubstr("this is the end"));
}

TEST_F(PlayerTest, CompletesCommandsEventsStagesAndBodies) {
  EXPECT_THAT(player.completions("st"), ElementsAre("step", "stage", "stages"));
  EXPECT_THAT(player.completions("event un"), ElementsAre("unmerge"));
  EXPECT_THAT(player.completions("table Un"), ElementsAre("Unmerge"));
  EXPECT_THAT(player.completions("pair body1 b"), Contains("body2"));
}

TEST_F(PlayerTest, ChangesARunByHandAndTakesThatBack) {
  say("jump 20 unm");
  EXPECT_THAT(say("push @1 5 0"), HasSubstr(", from step 21 on"));
  EXPECT_EQ(player.stage(), Stage::Merge);
  const std::string pushed = say("step 5");
  EXPECT_THAT(say("changes"), HasSubstr("after step 20: pushed body1 with (5.00, 0) N s"));
  EXPECT_THAT(say("undo"), HasSubstr("1 change is taken back\nstep 20, "));
  say("step 5");
  EXPECT_EQ(say("changes"), "nothing was changed\n");
  EXPECT_THAT(refused("undo"), HasSubstr("nothing was changed"));
  EXPECT_THAT(refused("push @1"), HasSubstr("it should read: push BODY X Y"));
  EXPECT_THAT(refused("pushh @1 1 0"), HasSubstr("did you mean 'push'?"));
  EXPECT_THAT(say("help"), HasSubstr("set key=value"));
}

}  // namespace
}  // namespace merge2d
