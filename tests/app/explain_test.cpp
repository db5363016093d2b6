#include <gmock/gmock.h>

#include "app/program.h"
#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

class ExplainCommand : public ProgramTest {
 protected:
  ExplainCommand() { write("stack.toml", kStack); }

  void expectError(const Words& arguments, int code, const std::string& what) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(what));
    EXPECT_THAT(outcome.out, IsEmpty());
  }
};

TEST_F(ExplainCommand, TellsWhatAStepDecided) {
  const Outcome outcome = run({"explain", "stack.toml", "--at", "10"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("stack, step 10 (t = 0.1 s), merge+sleep\n"));
  EXPECT_THAT(outcome.out, HasSubstr("Section 5.3"));
}

TEST_F(ExplainCommand, GivesAPairWithEachOfItsTestsAsJson) {
  const Json out =
      run({"explain", "stack.toml", "--at", "10", "--pair", "ground", "box[0,0]", "--json"}).json();
  EXPECT_EQ(out["step"], 10);
  ASSERT_EQ(out["explanations"].size(), 1U);
  const Json& one = out["explanations"][0];
  EXPECT_EQ(one["a"], "ground");
  EXPECT_EQ(one["b"], "box[0,0]");
  ASSERT_THAT(one["tests"], Not(IsEmpty()));
  for (const Json& test : one["tests"]) {
    EXPECT_DOUBLE_EQ(test["margin"], test["threshold"].get<double>() - test["value"].get<double>());
  }
}

TEST_F(ExplainCommand, NamesAllBodiesOfTheGroupThatHoldsAPair) {
  const Words arguments{"explain", "truss-arch", "--at", "6", "--pair", "left-leg", "right-leg"};
  EXPECT_THAT(run(arguments).out, HasSubstr("the rigid group of ground, left-leg and right-leg"));
  Words with_json = arguments;
  with_json.push_back("--json");
  const Json tests = run(with_json).json()["explanations"][0]["tests"];
  EXPECT_EQ(tests.back()["criterion"], "cycle");
  EXPECT_EQ(tests.back()["group"], Json({"ground", "left-leg", "right-leg"}));
}

TEST_F(ExplainCommand, TellsWhatWouldEndAWeldThatIsNotTested) {
  const Outcome outcome = run(
      {"explain", "stack.toml", "--mode", "merge", "--at", "40", "--pair", "ground", "box[0,0]"});
  EXPECT_THAT(outcome.out, HasSubstr("and no motion inside was found in this step. They come apart "
                                     "when their contacts cannot hold them"));
}

TEST_F(ExplainCommand, TellsTheStoryOfAWeld) {
  const Outcome outcome =
      run({"explain", "stack.toml", "--weld", "ground", "box[0,0]", "--steps", "100"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ground and box[0,0] merged at step "));
  EXPECT_THAT(outcome.out, HasSubstr("After step 100 ground and box[0,0] are welded."));
}

TEST_F(ExplainCommand, SaysWhyThereIsNothingToTell) {
  const Outcome outcome =
      run({"explain", "stack.toml", "--at", "10", "--pair", "ground", "box[0,2]"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("ground and box[0,2] do not touch, so nothing was tested."));
}

TEST_F(ExplainCommand, SaysThatNothingMergesInModesWithoutMerging) {
  const Outcome outcome = run({"explain", "stack.toml", "--at", "6", "--mode", "reference"});
  EXPECT_THAT(outcome.out, HasSubstr("In the mode reference nothing merges, so nothing was"));
}

TEST_F(ExplainCommand, SuggestsWhatWasMeant) {
  expectError({"explain", "stack.toml", "--at", "10", "--pair", "ground", "bx[0,0]"}, kWrongUsage,
              "the scene has no body 'bx[0,0]' (did you mean 'box[0,0]'?)");
}

TEST_F(ExplainCommand, NeedsAStepOrAWeldAndNotBoth) {
  expectError({"explain", "stack.toml"}, kWrongUsage, "--at STEP");
  expectError({"explain", "stack.toml", "--at", "51"}, kWrongUsage, "ends at step 50");
  expectError({"explain", "stack.toml", "--at", "0"}, kWrongUsage, "--at must be a whole number");
  expectError({"explain", "stack.toml", "--at", "1", "--weld", "ground", "box[0,0]"}, kWrongUsage,
              "--weld tells of a whole run");
}

}  // namespace
}  // namespace merge2d
