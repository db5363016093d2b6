#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

class Run : public ProgramTest {
 protected:
  Run() { write("stack.toml", kStack); }

  /// The lines of a trace.
  static std::vector<Json> parsed(const std::string& trace) {
    std::vector<Json> lines;
    for (const std::string& line : linesOf(trace)) lines.push_back(Json::parse(line));
    return lines;
  }
};

TEST_F(Run, PrintsASummary) {
  const Outcome outcome = run({"run", "stack.toml"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("scene               stack\n"),
                    HasSubstr("steps               50 of 0.01 s\n"), HasSubstr("x real time\n")));
  EXPECT_THAT(outcome.err, IsEmpty()) << "no progress bar without a terminal";
}

TEST_F(Run, GivesTheKeysOfTheContractAsJson) {
  const Json summary = run({"run", "stack.toml", "--json"}).json();
  EXPECT_THAT(
      keysOf(summary),
      ElementsAre("scene", "mode", "steps", "time", "bodies", "active_bodies", "collections",
                  "asleep", "contacts", "internal_contacts", "merges", "unmerges",
                  "max_penetration", "ms_per_step", "real_time_factor", "unmerges_by_reason",
                  "kinetic_energy", "potential_energy", "provenance"));
  EXPECT_THAT(keysOf(summary["ms_per_step"]), ElementsAre("mean", "median"));
  EXPECT_THAT(keysOf(summary["unmerges_by_reason"]),
              ElementsAre("broken", "sliding", "relative-motion", "user"));
  EXPECT_EQ(summary["scene"], "stack");
  EXPECT_EQ(summary["mode"], "merge+sleep");
  EXPECT_EQ(summary["steps"], 50);
  EXPECT_DOUBLE_EQ(summary["time"], 0.5);
  EXPECT_EQ(summary["bodies"], 3);
  EXPECT_GE(summary["merges"], 3) << "each box with what it stands on";
  EXPECT_GT(summary["ms_per_step"]["mean"], 0.0);
  EXPECT_GT(summary["real_time_factor"], 0.0);
}

TEST_F(Run, TheDeepestOverlapIsThatOfAllStepsAndContacts) {
  for (const char* mode : {"reference", "merge", "merge+sleep"}) {
    for (const char* scene : {"wagon", "conveyor"}) {
      SCOPED_TRACE(std::string(scene) + " in mode " + mode);
      const Words arguments = {"run", scene, "--mode", mode, "--steps", "200"};
      Words as_json = arguments, as_trace = arguments;
      as_json.emplace_back("--json");
      as_trace.insert(as_trace.end(), {"--trace", "-", "--quiet"});
      double deepest = 0.0;
      for (const Json& line : parsed(run(as_trace).out)) {
        if (line["type"] != "step") continue;
        deepest = std::max(deepest, line["stats"]["max_penetration"].get<double>());
      }
      EXPECT_GT(deepest, 0.0);
      EXPECT_DOUBLE_EQ(run(as_json).json()["max_penetration"], deepest);
    }
  }
}

TEST_F(Run, SaysWhereItsNumbersComeFrom) {
  const Words arguments = {"run",    "stack.toml", "--steps", "5",
                           "--mode", "merge",      "--set",   "merging.velocity=0.02",
                           "--json"};
  const Json provenance = run(arguments).json()["provenance"];
  EXPECT_THAT(keysOf(provenance), ElementsAre("program", "git", "digest", "seed", "parameters",
                                              "cpu_seconds", "wall_seconds"));
  EXPECT_THAT(provenance["program"].get<std::string>(), StartsWith("merge2d "));
  EXPECT_EQ(provenance["parameters"]["merging"]["velocity"], 0.02);
  EXPECT_EQ(provenance["parameters"]["solver"]["iterations"], 10) << "defaults included";
  EXPECT_GT(provenance["cpu_seconds"], 0.0);
  EXPECT_EQ(run(arguments).json()["provenance"]["digest"], provenance["digest"]);
  Words other = arguments;
  other[7] = "merging.velocity=0.03";
  EXPECT_NE(run(other).json()["provenance"]["digest"], provenance["digest"]);
}

TEST_F(Run, TheTableSaysWhereItComesFromInEachRow) {
  run({"run", "stack.toml", "--csv", "no/such/dir/stack.csv", "--set", "merging.velocity=0.02",
       "--set", "solver.iterations=12"});
  const Words rows = linesOf(read("no/such/dir/stack.csv"));
  EXPECT_THAT(rows[0], testing::EndsWith(",scene,mode,seed,digest,parameters,program,git"));
  const Json provenance = run({"run", "stack.toml", "--set", "merging.velocity=0.02", "--set",
                               "solver.iterations=12", "--json"})
                              .json()["provenance"];
  const std::string digest = provenance["digest"];
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_THAT(rows[i], HasSubstr(",stack,merge+sleep,1," + digest +
                                   ",duration=0.5;solver.iterations=12;merging.velocity=0.02,"));
  }
}

TEST_F(Run, TellsHowFarItEndsFromTheReference) {
  const auto error = [&](const std::string& mode, const Words& more = {}) {
    Words arguments = {"run", "tower-platform", "--seconds",        "1.5", "--mode",
                       mode,  "--json",         "--reference-error"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments).json()["reference_error"];
  };
  EXPECT_EQ(error("reference"), Json({{"mean", 0.0}, {"max", 0.0}}));
  const Json alone = error("merge");
  EXPECT_GT(alone["mean"], 0.0);
  EXPECT_GE(alone["max"], alone["mean"]);
  const Words kept = {"--reference-folder", "ends"};
  EXPECT_EQ(error("merge", kept), alone);
  EXPECT_THAT(files("ends"), SizeIs(1));
  EXPECT_EQ(error("merge", kept), alone) << "from the folder";
  error("merge", {"--reference-folder", "ends", "--set", "merging.velocity=0.02"});
  EXPECT_THAT(files("ends"), SizeIs(1)) << "the thresholds do not change the reference";
  error("merge", {"--reference-folder", "ends", "--set", "material.friction=0.3"});
  EXPECT_THAT(files("ends"), SizeIs(2));
}

TEST_F(Run, CountsBrokenJointsOfASceneThatHasJoints) {
  write("lamp.toml", R"(
format = 1
duration = 0.5
[[body]]
name = "lamp"
circle = 0.1
mass = 2
[[joint]]
kind = "revolute"
bodies = ["lamp"]
at = [0, 0]
break_force = 15
)");
  EXPECT_EQ(run({"run", "lamp.toml", "--json"}).json()["broken_joints"], 1);
  EXPECT_THAT(run({"run", "lamp.toml"}).out, HasSubstr("broken joints       1\n"));
  const Outcome traced = run({"run", "lamp.toml", "--trace", "-", "--quiet"});
  EXPECT_THAT(traced.out, HasSubstr(R"({"type":"break")"));
}

TEST_F(Run, WithoutTimingsTheSummaryIsTheSameEachTime) {
  const std::string first = run({"run", "stack.toml", "--json", "--no-timings"}).out;
  EXPECT_EQ(run({"run", "stack.toml", "--json", "--no-timings"}).out, first);
  EXPECT_TRUE(Json::parse(first)["real_time_factor"].is_null());
}

TEST_F(Run, MeasuresStagesWhereTheirTimesAreWritten) {
  run({"run", "stack.toml", "--steps", "2", "--trace", "stack.jsonl"});
  double sum = 0.0;
  const Json last = parsed(read("stack.jsonl")).back();
  for (const Json& seconds : last["stats"]["seconds"]) sum += seconds.get<double>();
  EXPECT_GT(sum, 0.0);
  run({"run", "stack.toml", "--steps", "2", "--csv", "stack.csv"});
  EXPECT_THAT(read("stack.csv"), Not(HasSubstr(",0,stack,")));
}

TEST_F(Run, TakesAsManyStepsAsAskedFor) {
  EXPECT_EQ(run({"run", "stack.toml", "--json", "--steps", "7"}).json()["steps"], 7);
  EXPECT_EQ(run({"run", "stack.toml", "--json", "--seconds", "0.3"}).json()["steps"], 30);
  EXPECT_EQ(run({"run", "stack.toml", "--json", "--steps", "0"}).json()["steps"], 0);
  EXPECT_EQ(run({"run", "stack.toml", "--json", "--set", "step=0.001"}).json()["steps"], 500);
}

TEST_F(Run, RefusesARunThatWouldNeverEnd) {
  const Outcome outcome = run({"run", "stack.toml", "--seconds", "1e300"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("take fewer with --steps"));
}

TEST_F(Run, SimulatesInEachMode) {
  for (const char* mode : {"reference", "sleep", "merge", "merge+sleep"}) {
    const Json summary = run({"run", "stack.toml", "--json", "--mode", mode}).json();
    EXPECT_EQ(summary["mode"], mode);
    const bool merges = std::string(mode).starts_with("merge");
    EXPECT_EQ(summary["collections"] > 0, merges) << mode;
  }
}

TEST_F(Run, SetChangesAnyParameter) {
  const auto header = [&](const Words& options) {
    Words arguments = {"run", "stack.toml", "--steps", "1", "--trace", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return parsed(run(arguments).out)[0];
  };
  const Json parameters = header({"--set", "merging.velocity=0.02", "--seed", "7", "--set",
                                  "gravity=[0, -1.5]"})["parameters"];
  EXPECT_EQ(parameters["merging"]["velocity"], 0.02);
  EXPECT_EQ(parameters["seed"], 7);
  EXPECT_EQ(parameters["gravity"], Json({0, -1.5}));
  EXPECT_EQ(header({"--set", "body.ground.motion=scripted", "--set",
                    "body.ground.script={velocity=[1,0]}"})["bodies"][0]["motion"],
            "scripted");
}

TEST_F(Run, WritesATraceWithALineForEachStep) {
  const Outcome outcome = run({"run", "stack.toml", "--trace", "stack.jsonl"});
  EXPECT_EQ(outcome.code, 0);
  const std::vector<Json> lines = parsed(read("stack.jsonl"));
  ASSERT_THAT(lines, SizeIs(51));
  EXPECT_EQ(lines[0]["type"], "header");
  EXPECT_EQ(lines[0]["scene"], "stack");
  EXPECT_EQ(lines[50]["step"], 50);
  EXPECT_DOUBLE_EQ(lines[50]["t"], 0.5);
  EXPECT_FALSE(lines[50].contains("decisions"));
  EXPECT_THAT(files(), ElementsAre("stack.jsonl", "stack.toml")) << "nothing temporary is left";
}

TEST_F(Run, AddsDecisionsWhenAskedTo) {
  run({"run", "stack.toml", "--trace", "stack.jsonl", "--decisions"});
  const std::vector<Json> lines = parsed(read("stack.jsonl"));
  std::size_t decisions = 0;
  for (std::size_t k = 1; k < lines.size(); ++k) decisions += lines[k]["decisions"].size();
  EXPECT_GT(decisions, 0U);
}

TEST_F(Run, TheSameRunGivesTheSameTrace) {
  for (const char* file : {"a.jsonl", "b.jsonl"}) {
    run({"run", "pile", "--steps", "150", "--trace", file, "--no-timings", "--decisions"});
  }
  EXPECT_EQ(read("a.jsonl"), read("b.jsonl"));
  EXPECT_THAT(read("a.jsonl"), Not(HasSubstr("seconds")));
}

TEST_F(Run, DecisionsDoNotChangeTheRun) {
  run({"run", "pile", "--steps", "150", "--trace", "a.jsonl", "--no-timings", "--decisions"});
  run({"run", "pile", "--steps", "150", "--trace", "b.jsonl", "--no-timings"});
  const auto with = parsed(read("a.jsonl")), without = parsed(read("b.jsonl"));
  EXPECT_EQ(with.back()["bodies"], without.back()["bodies"]);
}

TEST_F(Run, WritesATableWithARowForEachStep) {
  EXPECT_EQ(run({"run", "stack.toml", "--csv", "stack.csv"}).code, 0);
  const Words rows = linesOf(read("stack.csv"));
  ASSERT_THAT(rows, SizeIs(51));
  const auto columns = std::ranges::count(rows[0], ',');
  for (const std::string& row : rows) EXPECT_EQ(std::ranges::count(row, ','), columns);
  EXPECT_THAT(rows[50], StartsWith("50,0.5,3,"));
}

TEST_F(Run, SendsATraceToTheStandardOutputAndTheRestElsewhere) {
  const Outcome outcome = run({"run", "stack.toml", "--trace", "-"});
  EXPECT_THAT(linesOf(outcome.out), AllOf(SizeIs(51), Each(StartsWith("{\"type\":"))));
  EXPECT_THAT(outcome.err, HasSubstr("scene               stack\n"));
  EXPECT_THAT(run({"run", "stack.toml", "--trace", "-", "--quiet"}).err, IsEmpty());
}

TEST_F(Run, ReplacesATraceButNothingElse) {
  write("notes.txt", "precious");
  for (const char* option : {"--trace", "--csv"}) {
    const Outcome refused = run({"run", "stack.toml", option, "notes.txt"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("notes.txt exists and would be overwritten; say --force"));
    EXPECT_EQ(read("notes.txt"), "precious");
    EXPECT_EQ(run({"run", "stack.toml", option, "ours"}).code, 0);
    EXPECT_EQ(run({"run", "stack.toml", option, "ours"}).code, 0) << "it is one of ours";
    fs::remove(folder() / "ours");
  }
  EXPECT_EQ(run({"run", "stack.toml", "--trace", "notes.txt", "--force"}).code, 0);
  EXPECT_THAT(read("notes.txt"), StartsWith("{\"type\":\"header\""));
}

TEST_F(Run, WritesThroughALink) {
  fs::create_directory(folder() / "far");
  fs::create_symlink("far/trace.jsonl", folder() / "link.jsonl");
  EXPECT_EQ(run({"run", "stack.toml", "--trace", "link.jsonl"}).code, 0);
  EXPECT_TRUE(fs::is_symlink(folder() / "link.jsonl"));
  EXPECT_THAT(read("far/trace.jsonl"), StartsWith("{\"type\":\"header\""));
}

TEST_F(Run, FailsWhereItCannotWrite) {
  for (const char* file : {"/proc/nowhere/file", ".", "no/such/folder/"}) {
    const Outcome outcome = run({"run", "stack.toml", "--trace", file});
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("cannot write " + fs::path(file).parent_path().string()));
  }
  const Outcome full = run({"run", "stack.toml", "--trace", "/dev/full"});
  EXPECT_EQ(full.code, 4);
  EXPECT_THAT(full.err, HasSubstr("No space left on device"));
  EXPECT_THAT(files(), ElementsAre("stack.toml"));
}

TEST_F(Run, LeavesNothingBehindWhenTheSceneIsBad) {
  write("bad.toml", "format = 1\nbodies = 3\n");
  EXPECT_EQ(run({"run", "bad.toml", "--trace", "bad.jsonl"}).code, 3);
  EXPECT_THAT(files(), ElementsAre("bad.toml", "stack.toml"));
}

TEST_F(Run, WritesWhatItHasWhenTheSimulationFails) {
  write("wild.toml", kDiverging);
  const Outcome outcome = run({"run", "wild.toml", "--trace", "wild.jsonl", "--json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(StartsWith("error: "), HasSubstr("'flea'")));
  const std::vector<Json> lines = parsed(read("wild.jsonl"));
  EXPECT_EQ(lines.back()["step"], outcome.json()["steps"]);
  EXPECT_THAT(read("wild.jsonl"), Not(HasSubstr("nan")));
  EXPECT_THAT(files(), ElementsAre("stack.toml", "wild.jsonl", "wild.toml"));
}

TEST_F(Run, AnInterruptLeavesNoFileAndEndsByItsSignal) {
  ASSERT_EQ(mkfifo((folder() / "pipe").c_str(), 0600), 0);
  const pid_t child =
      start({"run", "pile", "--steps", "1000000000", "--csv", "pile.csv", "--trace", "pipe"});
  const int pipe = open((folder() / "pipe").c_str(), O_RDONLY);  // waits for the program
  kill(child, SIGINT);
  const Outcome outcome = wait(child);
  EXPECT_EQ(outcome.signal, SIGINT);
  close(pipe);
  EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
  EXPECT_THAT(files(), ElementsAre("pipe", "stack.toml"));
}

TEST_F(Run, WarnsOnStderrUnlessQuiet) {
  write("empty.toml", "format = 1\nduration = 0.1\n");
  const Outcome outcome = run({"run", "empty.toml", "--json"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, StartsWith("warning: "));
  EXPECT_EQ(outcome.json()["bodies"], 0);
  EXPECT_THAT(run({"run", "empty.toml", "--quiet"}).err, IsEmpty());
}

TEST_F(Run, RulesThatContradictEachOtherAreWarnedOf) {
  const auto warnings = [&](const std::string& merging, const std::string& unmerging) {
    return run({"run", "books", "--steps", "1", "--set", "merging.rule=" + merging, "--set",
                "unmerging.rule=" + unmerging})
        .err;
  };
  EXPECT_THAT(warnings("paper", "default"), HasSubstr("one cuts the welds of the other"));
  EXPECT_EQ(warnings("default", "default"), "");
  EXPECT_THAT(warnings("default", "paper"), HasSubstr("set both to one rule"));
  EXPECT_EQ(warnings("paper", "paper"), "");
}

TEST_F(Run, ContinuesFromASnapshotWithTheSameBytes) {
  run({"run", "pile", "--steps", "120", "--trace", "whole.jsonl", "--no-timings"});
  EXPECT_EQ(run({"run", "pile", "--steps", "70", "--snapshot", "70.state"}).code, 0);
  EXPECT_EQ(run({"run", "pile", "--steps", "120", "--resume", "70.state", "--trace", "rest.jsonl",
                 "--no-timings"})
                .code,
            0);
  Words whole = linesOf(read("whole.jsonl"));
  const Words rest = linesOf(read("rest.jsonl"));
  whole.erase(whole.begin() + 1, whole.begin() + 71);  // after the header
  EXPECT_TRUE(rest == whole);
}

TEST_F(Run, RefusesASnapshotThatDoesNotFit) {
  ASSERT_EQ(run({"run", "stack.toml", "--steps", "20", "--snapshot", "a.state"}).code, 0);
  Outcome outcome = run({"run", "books", "--resume", "a.state"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("a.state: the snapshot is of another scene than 'books'"));
  outcome = run({"run", "stack.toml", "--mode", "reference", "--resume", "a.state"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("made with --mode merge+sleep, not reference"));
  write("short.state", read("a.state").substr(0, 500));
  outcome = run({"run", "stack.toml", "--resume", "short.state"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("short.state: the snapshot is incomplete"));
  EXPECT_EQ(run({"run", "stack.toml", "--resume", "none.state"}).code, 4);
  outcome = run({"run", "stack.toml", "--steps", "20", "--resume", "a.state"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("taken after step 20"));
}

TEST_F(Run, ASnapshotReplacesOnlySnapshots) {
  write("notes.txt", "mine");
  EXPECT_EQ(run({"run", "stack.toml", "--snapshot", "notes.txt"}).code, 2);
  EXPECT_EQ(read("notes.txt"), "mine");
  EXPECT_EQ(run({"run", "stack.toml", "--snapshot", "a.state"}).code, 0);
  EXPECT_EQ(run({"run", "stack.toml", "--snapshot", "a.state"}).code, 0);
  EXPECT_EQ(run({"run", "stack.toml", "--snapshot", "-"}).code, 2);
}

}  // namespace
}  // namespace merge2d
