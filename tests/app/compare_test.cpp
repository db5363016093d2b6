#include <gmock/gmock.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

/// A column of boxes of which the uppermost is pushed down after they have merged.
constexpr const char* kToppled = R"(
format = 1
title = "A column that loses its head"
duration = 3
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [40, 1]
[[body]]
name = "box"
at = [0, 1]
box = [0.4, 2]
[[impulse]]
body = "box"
at = [-0.2, 1.9]
impulse = [1.5, 0]
time = 1.0
)";

class Compare : public ProgramTest {
 protected:
  Compare() {
    write("stack.toml", kStack);
    write("toppled.toml", kToppled);
  }

  Json compared(const std::string& scene) const {
    return run({"compare", scene, "--json", "--no-charts"}).json();
  }
};

TEST_F(Compare, PutsTheFourModesIntoOneTable) {
  const Outcome outcome = run({"compare", "stack.toml", "--no-charts"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(StartsWith("stack: Three boxes\n50 steps of 0.01 s, 0.5 s\n"),
                                 HasSubstr("reference        sleep        merge  merge+sleep\n"),
                                 HasSubstr("\ntime per step, mean"), HasSubstr("\nmerges  "),
                                 HasSubstr("\ndistance from the reference\n")));
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(files(), ElementsAre("stack.toml", "toppled.toml"));
}

TEST_F(Compare, TellsTheMeansOfAWindow) {
  const Words command = {"compare", "toppled.toml", "--no-charts", "--window", "0.6,0.99"};
  EXPECT_THAT(run(command).out, HasSubstr("\nfrom 0.6 s to 0.99 s\ntime per step, mean"));
  Words as_json = command;
  as_json.push_back("--json");
  const Json all = run(as_json).json();
  EXPECT_EQ(all["window"], Json({0.6, 0.99}));
  const Json& merged = all["modes"][2];
  EXPECT_EQ(merged["window"]["contacts"]["mean"], 0.0) << "merged, before the push";
  EXPECT_GT(merged["contacts"]["mean"], 0.0) << "in the whole run";
  EXPECT_GT(merged["window"]["ms_per_step"]["mean"], 0.0);
  EXPECT_EQ(all["modes"][1]["window"]["speedup"]["sleep"], 1.0);
}

TEST_F(Compare, RefusesAWindowThatIsNone) {
  for (const char* window : {"1", "2,1", "1,1", "a,b", "-1,2", "0,3.1"}) {
    const Outcome outcome = run({"compare", "toppled.toml", "--no-charts", "--window", window});
    EXPECT_EQ(outcome.code, 2) << window;
    EXPECT_THAT(outcome.err, HasSubstr("--window")) << window;
  }
}

TEST_F(Compare, GivesAllOfItAsJson) {
  const Json all = compared("stack.toml");
  EXPECT_THAT(keysOf(all),
              ElementsAre("scene", "title", "h", "steps", "time", "bodies", "modes", "charts"));
  EXPECT_EQ(all["steps"], 50);
  EXPECT_EQ(all["bodies"], 3);
  ASSERT_THAT(all["modes"], SizeIs(4));
  const Json &reference = all["modes"][0], &merged = all["modes"][2];
  EXPECT_EQ(reference["mode"], "reference");
  EXPECT_EQ(reference["merges"], 0);
  EXPECT_EQ(reference["active_bodies"]["mean"], 3.0);
  EXPECT_EQ(reference["distance"]["largest_ever"], 0.0);
  EXPECT_EQ(reference["speedup"]["reference"], 1.0);
  EXPECT_EQ(merged["mode"], "merge");
  EXPECT_GE(merged["merges"], 3);
  EXPECT_EQ(merged["unmerges"], 0);
  EXPECT_LT(merged["active_bodies"]["mean"], 3.0);
  EXPECT_LT(merged["distance"]["largest_ever"], 1e-3);
  EXPECT_EQ(merged["late_events"], 0);
  EXPECT_EQ(merged["flicker"], 0);
  EXPECT_GT(merged["ms_per_step"]["mean"], 0.0);
}

TEST_F(Compare, TellsWhenBodiesTipOver) {
  const Json all = compared("toppled.toml");
  for (const Json& mode : all["modes"]) {
    EXPECT_EQ(mode["tipped"]["bodies"], 1) << mode["mode"];
    EXPECT_GT(mode["tipped"]["first"], 1.0) << mode["mode"];
    EXPECT_NEAR(mode["tipped"]["first"].get<double>(),
                all["modes"][0]["tipped"]["first"].get<double>(), 0.03)
        << mode["mode"];
  }
  EXPECT_GE(all["modes"][3]["unmerges"], 1);
}

TEST_F(Compare, WritesATableWithARowPerModeAndStep) {
  EXPECT_EQ(run({"compare", "stack.toml", "--csv", "all.csv", "--no-charts"}).code, 0);
  const Words lines = linesOf(read("all.csv"));
  ASSERT_THAT(lines, SizeIs(1 + 4 * 50));
  EXPECT_EQ(lines[0],
            "mode,step,t,active_bodies,contacts,internal_contacts,merges,unmerges,mean_distance,"
            "largest_distance,ms");
  EXPECT_THAT(lines[1], StartsWith("reference,1,0.01,3,"));
  EXPECT_THAT(lines[200], StartsWith("merge+sleep,50,0.5,"));
}

TEST_F(Compare, DrawsItsCharts) {
  const Outcome outcome = run({"compare", "stack.toml", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.json()["charts"],
              ElementsAre("frames/stack/compare/time.png", "frames/stack/compare/counts.png",
                          "frames/stack/compare/distance.png"));
  EXPECT_THAT(files("frames/stack/compare"), ElementsAre("counts.png", "distance.png", "time.png"));
  EXPECT_EQ(run({"render", "stack.toml", "--steps", "1"}).code, 0) << "frames may stand beside";
  EXPECT_EQ(run({"compare", "stack.toml", "-o", "charts", "--theme", "print"}).code, 0);
  EXPECT_THAT(files("charts"), SizeIs(3));
}

TEST_F(Compare, WithoutTimingsTwoRunsGiveTheSameBytes) {
  const Words command = {"compare", "toppled.toml", "--no-timings", "--csv", "-", "-o", "charts"};
  const Outcome first = run(command);
  const std::string chart = read("charts/counts.png");
  const Outcome second = run(command);
  EXPECT_EQ(first.out, second.out);
  EXPECT_EQ(read("charts/counts.png"), chart);
  EXPECT_THAT(files("charts"), SizeIs(2)) << "no chart of times";
}

TEST_F(Compare, SaysInWhichModeASimulationFailed) {
  write("flea.toml", kDiverging);
  const Outcome outcome = run({"compare", "flea.toml", "--no-charts"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, StartsWith("error: in mode reference: "));
}

TEST_F(Compare, RefusesOptionsThatMakeNoSense) {
  EXPECT_EQ(run({"compare", "stack.toml", "--mode", "merge"}).code, 2);
  EXPECT_EQ(run({"compare", "stack.toml", "--json", "--csv", "-"}).code, 2);
  EXPECT_EQ(run({"compare", "stack.toml", "--no-charts", "-o", "charts"}).code, 2);
  EXPECT_EQ(run({"compare", "stack.toml", "--theme", "lite"}).code, 2);
  EXPECT_EQ(run({"compare", "missing.toml"}).code, 3);
}

TEST_F(Compare, TakesNoStepsWhenNoneAreAskedFor) {
  const Outcome outcome = run({"compare", "stack.toml", "--steps", "0", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["steps"], 0);
}

}  // namespace
}  // namespace merge2d
