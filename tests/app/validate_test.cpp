#include <gmock/gmock.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Validate : public ProgramTest {
 protected:
  Validate() { write("stack.toml", kStack); }
};

TEST_F(Validate, TellsWhatIsInAScene) {
  const Outcome outcome = run({"validate", "stack.toml"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, StartsWith("stack: Three boxes\n"));
  EXPECT_THAT(outcome.out, HasSubstr("bodies    4: 3 dynamic, 1 pinned\n"));
  EXPECT_THAT(outcome.out, HasSubstr("shapes    4: 0 discs, 4 polygons\n"));
  EXPECT_THAT(outcome.out, HasSubstr("time      0.5 s, 50 steps of 0.01 s\n"));
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(Validate, TellsTheSameAsJson) {
  const Json found = run({"validate", "--json", "stack.toml", "--set", "step=0.005"}).json();
  EXPECT_EQ(found["bodies"], 4);
  EXPECT_EQ(found["dynamic"], 3);
  EXPECT_EQ(found["pinned"], 1);
  EXPECT_EQ(found["scripted"], 0);
  EXPECT_EQ(found["mass"], 3.0);
  EXPECT_EQ(found["steps"], 100);
  EXPECT_THAT(found["warnings"], IsEmpty());
}

TEST_F(Validate, WarnsOfBodiesThatOverlapFromTheStart) {
  const Outcome outcome = run({"validate", "stack.toml", "--set", "body.ground.at=[0, -0.4]"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("warning: 'ground' and 'box[0,0]' overlap by 0.1 m"));
}

TEST_F(Validate, WarnsOfWhatComesAfterTheEnd) {
  write("late.toml", std::string(kStack) + R"(
[[impulse]]
body = "box[0,0]"
at = [0, 0]
impulse = [1, 0]
time = 0.4
[[impulse]]
body = "box[0,1]"
at = [0, 0]
impulse = [1, 0]
time = 20
[[force]]
body = "box[0,0]"
force = [1, 0]
from = 0.5
[[magnet]]
body = "ground"
on = [[0, 0.2], [3, 4]]
[[emitter]]
name = "rain"
at = [0, 8]
circle = 0.2
every = 1
start = 7.5
count = 2
)");
  const Words expected = {"impulse[1] of 'box[0,1]' is due at 20 s, but the scene ends at 0.5 s",
                          "force[0] of 'box[0,0]' is due at 0.5 s, but the scene ends at 0.5 s",
                          "magnet[0] of 'ground' is due at 3 s, but the scene ends at 0.5 s",
                          "emitter[0] of 'rain' is due at 7.5 s, but the scene ends at 0.5 s"};
  EXPECT_EQ(run({"validate", "late.toml", "--json"}).json()["warnings"], Json(expected));
  EXPECT_THAT(run({"validate", "late.toml"}).out, HasSubstr("warning: " + expected[0] + "\n"));
  EXPECT_THAT(run({"validate", "late.toml", "--set", "duration=30", "--json"}).json()["warnings"],
              IsEmpty());
}

TEST_F(Validate, WritesATextSceneThatMeansTheSame) {
  EXPECT_EQ(run({"validate", "stack.toml", "--to", "copy.toml"}).code, 0);
  EXPECT_THAT(files(), ElementsAre("copy.toml", "stack.toml"));
  const Words options = {"--steps", "20", "--no-timings", "--trace", "-"};
  Words original = {"run", "stack.toml"}, copy = {"run", "copy.toml"};
  original.insert(original.end(), options.begin(), options.end());
  copy.insert(copy.end(), options.begin(), options.end());
  EXPECT_EQ(linesOf(run(original).out).back(), linesOf(run(copy).out).back());
}

TEST_F(Validate, WritesToTheStandardOutputAsWell) {
  const Outcome outcome = run({"validate", "stack.toml", "--to", "-"});
  EXPECT_THAT(outcome.out, StartsWith("format = 1\n"));
  EXPECT_THAT(outcome.err, StartsWith("stack: Three boxes\n"));
}

TEST_F(Validate, NeverOverwritesASceneWithoutForce) {
  write("mine.toml", "# by hand\n");
  const Outcome refused = run({"validate", "stack.toml", "--to", "mine.toml"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("say --force"));
  EXPECT_EQ(read("mine.toml"), "# by hand\n");
  EXPECT_EQ(run({"validate", "stack.toml", "--to", "mine.toml", "--force"}).code, 0);
  EXPECT_THAT(read("mine.toml"), StartsWith("format = 1\n"));
}

TEST_F(Validate, FailsWhereItCannotWrite) {
  const Outcome outcome = run({"validate", "stack.toml", "--to", "no/such/folder.toml"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("cannot write no/such/folder.toml: No such file"));
}

}  // namespace
}  // namespace merge2d
