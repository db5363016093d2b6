#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

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

  /// The cells of a table, but for its head.
  std::vector<Words> rowsOf(const std::string& file) const {
    std::vector<Words> rows;
    for (const std::string& line : linesOf(read(file))) {
      std::istringstream cells(line);
      Words& row = rows.emplace_back();
      for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    }
    rows.erase(rows.begin());
    return rows;
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

TEST_F(Compare, WritesLengthsWithoutPowersOfTen) {
  const std::string table = run({"compare", "dominoes", "--no-charts"}).out;
  EXPECT_THAT(table, HasSubstr(" mm "));
  EXPECT_THAT(table, Not(ContainsRegex("[0-9]e[+-]"))) << table;
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
  EXPECT_THAT(keysOf(all), ElementsAre("scene", "title", "h", "steps", "time", "bodies", "modes",
                                       "hits", "charts"));
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

/// Slender boards that fall over one after the other.
std::string boards() {
  std::string scene = R"(
format = 1
title = "Boards"
duration = 2
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [60, 1]
)";
  for (const int k : {1, 2, 3}) {
    scene += fmt::format(R"(
[[body]]
name = "board-{0}"
at = [{1}, 1]
box = [0.4, 2]
[[impulse]]
body = "board-{0}"
at = [{2}, 1.9]
impulse = [1.5, 0]
time = {3}
)",
                         k, 10.0 * k, 10.0 * k - 0.2, 0.3 * k);
  }
  return scene;
}

TEST_F(Compare, ComparesWhenTheKthBodyTips) {
  write("boards.toml", boards());
  const Json all = compared("boards.toml");
  const Json& reference = all["modes"][0]["tipped"];
  ASSERT_THAT(reference["times"], SizeIs(3));
  EXPECT_NEAR(reference["times"][1].get<double>() - reference["times"][0].get<double>(), 0.3, 0.02);
  EXPECT_EQ(reference["difference"], Json({{"compared", 3}, {"mean", 0.0}, {"largest", 0.0}}));
  for (const Json& mode : all["modes"]) {
    const Json& tipped = mode["tipped"];
    ASSERT_THAT(tipped["times"], SizeIs(3)) << mode["mode"];
    EXPECT_EQ(tipped["times"].back(), tipped["last"]);
    double sum = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double difference =
          std::abs(tipped["times"][k].get<double>() - reference["times"][k].get<double>());
      sum += difference;
      largest = std::max(largest, difference);
    }
    EXPECT_NEAR(tipped["difference"]["mean"].get<double>(), sum / 3.0, 1e-12) << mode["mode"];
    EXPECT_EQ(tipped["difference"]["largest"], largest) << mode["mode"];
  }
  EXPECT_THAT(run({"compare", "boards.toml", "--no-charts"}).out,
              AllOf(HasSubstr("\n  the k-th is off by, mean "),
                    HasSubstr("\n                   largest ")));
}

TEST_F(Compare, ComparesNoTimesWhereNothingTipsOver) {
  const Json tipped = compared("stack.toml")["modes"][2]["tipped"];
  EXPECT_EQ(tipped["times"], Json::array());
  EXPECT_EQ(tipped["difference"], Json({{"compared", 0}, {"mean", nullptr}, {"largest", nullptr}}));
}

TEST_F(Compare, TakesItsMaximaOverAllSteps) {
  const Words scene = {"toppled.toml", "--steps", "1100", "--set",
                       "step=0.002"};  // not each sampled
  Words compare = {"compare", "--json", "--no-charts", "--csv", "all.csv"};
  compare.insert(compare.end(), scene.begin(), scene.end());
  const Json all = run(compare).json();
  for (const Json& mode : all["modes"]) {
    Words single = {"run", "--json", "--mode", mode["mode"]};
    single.insert(single.end(), scene.begin(), scene.end());
    EXPECT_EQ(mode["max_penetration"], run(single).json()["max_penetration"]) << mode["mode"];
  }
  double largest = 0.0;
  for (const Words& row : rowsOf("all.csv")) {
    if (row[0] == "merge") largest = std::max(largest, std::stod(row[9]));
  }
  EXPECT_EQ(all["modes"][2]["distance"]["largest_ever"], largest);
}

TEST_F(Compare, GivesTheDistanceOverTime) {
  const Json merged = compared("toppled.toml")["modes"][2];
  const Json& over_time = merged["distance_over_time"];
  for (const char* key : {"time", "mean", "largest"}) EXPECT_THAT(over_time[key], SizeIs(300));
  EXPECT_EQ(over_time["time"][0], 0.01);
  EXPECT_EQ(over_time["time"].back(), 3.0);
  EXPECT_EQ(over_time["mean"].back(), merged["distance"]["mean"]);
  const Json longer =
      run({"compare", "toppled.toml", "--steps", "1999", "--json", "--no-charts"}).json();
  const Json& sampled = longer["modes"][2]["distance_over_time"]["time"];
  EXPECT_THAT(sampled, SizeIs(667)) << "every third step, and the last";
  EXPECT_DOUBLE_EQ(sampled.back(), 19.99);
}

TEST_F(Compare, TellsHowFarBodiesCreepOnEachOther) {
  write("slope.toml", R"(
format = 1
title = "A block that slides down a slope of which it has not enough friction"
duration = 4
[[body]]
name = "slope"
motion = "pinned"
angle = -10
box = [80, 1]
friction = 0.1
[[body]]
name = "block"
at = [0.15, 0.98]
angle = -10
box = [1, 1]
friction = 0.1
)");
  const Json sliding = compared("slope.toml")["modes"][0]["creep"];
  const double g = 9.81, slope = 10.0 * std::numbers::pi / 180.0;
  const double a = g * (std::sin(slope) - 0.1 * std::cos(slope));
  EXPECT_EQ(sliding["pairs"], 1);
  EXPECT_NEAR(sliding["largest"].get<double>(), 0.5 * a * (16.0 - 9.0), 0.02);
  EXPECT_EQ(sliding["mean"], sliding["largest"]);
  const Json merged = compared("stack.toml")["modes"][2]["creep"];
  EXPECT_EQ(merged["pairs"], 3) << "boxes, and the ground";
  EXPECT_LT(merged["largest_ever"], 1e-12);
}

TEST_F(Compare, TellsTheTimeOfEachStage) {
  const Json all = compared("stack.toml");
  const Json& reference = all["modes"][0];
  EXPECT_THAT(keysOf(reference["ms_per_stage"]),
              ElementsAre("ContactDetection", "ContactOrdering", "SleepAndWake", "WarmStart",
                          "SingleIterationPGS", "Unmerge", "SolveLCP", "AdvanceVelocities",
                          "AccumulateRelativeMotion", "AdvancePositions", "Merge"));
  double sum = 0.0;
  for (const Json& ms : reference["ms_per_stage"]) sum += ms.get<double>();
  EXPECT_GT(sum, 0.0);
  EXPECT_LT(sum, reference["ms_per_step"]["mean"]);
  const Json without =
      run({"compare", "stack.toml", "--json", "--no-charts", "--no-timings"}).json();
  EXPECT_EQ(without["modes"][0]["ms_per_stage"], nullptr);
}

TEST_F(Compare, WritesATableWithARowPerModeAndStep) {
  EXPECT_EQ(run({"compare", "stack.toml", "--csv", "all.csv", "--no-charts"}).code, 0);
  const Words lines = linesOf(read("all.csv"));
  ASSERT_THAT(lines, SizeIs(1 + 4 * 50));
  EXPECT_EQ(lines[0],
            "mode,step,t,active_bodies,contacts,internal_contacts,merges,unmerges,mean_distance,"
            "largest_distance,collections,asleep,broken_joints,max_penetration,ms,ms_"
            "ContactDetection,ms_ContactOrdering,ms_SleepAndWake,"
            "ms_WarmStart,ms_SingleIterationPGS,ms_Unmerge,ms_SolveLCP,ms_AdvanceVelocities,"
            "ms_AccumulateRelativeMotion,ms_AdvancePositions,ms_Merge");
  EXPECT_THAT(lines[1], StartsWith("reference,1,0.01,3,"));
  EXPECT_THAT(lines[200], StartsWith("merge+sleep,50,0.5,"));
  for (const Words& row : rowsOf("all.csv")) {
    EXPECT_THAT(row, AllOf(SizeIs(26), Each(Not(IsEmpty()))));
  }
}

/// Also of the last turn, which is a short one.
TEST_F(Compare, TakesTheTimeOfEveryStep) {
  EXPECT_EQ(
      run({"compare", "toppled.toml", "--steps", "250", "--csv", "all.csv", "--no-charts"}).code,
      0);
  const std::vector<Words> rows = rowsOf("all.csv");
  ASSERT_THAT(rows, SizeIs(4 * 250));
  for (const Words& row : rows) {
    double stages = 0.0;
    for (std::size_t i = 15; i < row.size(); ++i) stages += std::stod(row[i]);
    EXPECT_GT(stages, 0.0) << row[0] << ", step " << row[1];
    EXPECT_LT(stages, std::stod(row[14])) << row[0] << ", step " << row[1];
  }
}

TEST_F(Compare, TellsInItsTableWhatRunTellsOfEachStep) {
  EXPECT_EQ(run({"compare", "toppled.toml", "--csv", "all.csv", "--no-charts"}).code, 0);
  EXPECT_EQ(run({"run", "toppled.toml", "--csv", "one.csv"}).code, 0);
  std::vector<Words> merged = rowsOf("all.csv"), alone = rowsOf("one.csv");
  std::erase_if(merged, [](const Words& row) { return row[0] != "merge+sleep"; });
  ASSERT_EQ(merged.size(), alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(merged[i][10], alone[i][4]) << "collections";
    EXPECT_EQ(merged[i][11], alone[i][5]) << "asleep";
    EXPECT_EQ(merged[i][13], alone[i][10]) << "max_penetration";
  }
}

TEST_F(Compare, CountsBrokenJointsOfASceneThatHasJoints) {
  write("lamp.toml", R"(
format = 1
duration = 0.5
body = [{ name = "lamp", circle = 0.1, mass = 2 }]
joint = [{ kind = "revolute", bodies = ["lamp"], at = [0, 0], break_force = 15 }]
)");
  const Outcome outcome = run({"compare", "lamp.toml", "--no-charts", "--csv", "all.csv"});
  EXPECT_THAT(outcome.out, ContainsRegex("\nbroken joints +1 +1 +1 +1\n"));
  EXPECT_EQ(compared("lamp.toml")["modes"][3]["broken_joints"], 1);
  EXPECT_EQ(std::ranges::count(rowsOf("all.csv"), "1", [](const Words& row) { return row[12]; }),
            4);
  EXPECT_FALSE(compared("stack.toml")["modes"][3].contains("broken_joints"));
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
  for (const char* chart : {"time.png", "counts.png", "distance.png"}) {
    const std::string bytes = read(std::string("charts/") + chart);
    EXPECT_EQ(bytes.substr(18, 2), "\x07\x80")
        << chart << ": 1920 pixels wide, so of one text size";
    EXPECT_THAT(bytes, HasSubstr("pHYs"));
  }
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
  const Outcome mode = run({"compare", "stack.toml", "--mode", "merge"});
  EXPECT_EQ(mode.code, 2);
  EXPECT_THAT(mode.err, AllOf(HasSubstr("compare simulates all four modes and has no --mode"),
                              HasSubstr("'merge2d run SCENE --mode merge'")));
  EXPECT_THAT(run({"compare", "--help"}).out, Not(HasSubstr("--mode MODE")));
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
