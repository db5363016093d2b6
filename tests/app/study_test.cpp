#include <gmock/gmock.h>

#include <set>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

/// A table as rows of values by their columns.
using Rows = std::vector<std::map<std::string, std::string>>;

/// The fields of a line of CSV.
Words fieldsOf(const std::string& line) {
  Words fields{""};
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

Rows rowsOf(const std::string& csv) {
  const Words lines = linesOf(csv);
  const Words columns = fieldsOf(lines.at(0));
  Rows rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Words fields = fieldsOf(lines[i]);
    EXPECT_EQ(fields.size(), columns.size()) << lines[i];
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < std::min(fields.size(), columns.size()); ++k) {
      row[columns[k]] = fields[k];
    }
  }
  return rows;
}

constexpr const char* kGrid = R"(
scenes = ["stack.toml"]
modes = ["reference", "merge"]
steps = 20
[parameters]
merging.velocity = [0.01, 0.02]
solver.iterations = { from = 10, to = 12 }
)";

class StudyCommand : public ProgramTest {
 protected:
  StudyCommand() {
    write("stack.toml", kStack);
    write("grid.toml", kGrid);
  }

  Rows table(const std::string& folder = "out") const {
    return rowsOf(read(folder + "/study.csv"));
  }

  std::size_t rowFiles() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        files("out/rows"),
        [](const std::string& name) { return name.ends_with(".json") && name[0] != '.'; }));
  }
};

TEST_F(StudyCommand, RunsEveryCombinationAndMakesARowOfEach) {
  const Outcome outcome = run({"study", "grid.toml", "-o", "out", "-j", "2"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("12 runs: 12 finished, 0 failed, 0 missing"));
  const Rows rows = table();
  ASSERT_THAT(rows, SizeIs(12));
  std::set<std::string> combinations;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    EXPECT_EQ(row.at("run"), std::to_string(i + 1));
    EXPECT_EQ(row.at("exit_code"), "0");
    EXPECT_EQ(row.at("steps"), "20");
    combinations.insert(row.at("mode") + row.at("merging.velocity") + row.at("solver.iterations"));
  }
  EXPECT_THAT(combinations, SizeIs(12));
}

TEST_F(StudyCommand, ARowSaysWhereItsNumbersComeFrom) {
  run({"study", "grid.toml", "-o", "out"});
  const auto row = table().back();
  const Json same =
      run({"run", "stack.toml", "--steps", "20", "--mode", "merge", "--set",
           "merging.velocity=0.02", "--set", "solver.iterations=12", "--json", "--reference-error"})
          .json();
  EXPECT_EQ(row.at("scene"), "stack.toml");
  EXPECT_EQ(row.at("mode"), "merge");
  EXPECT_EQ(row.at("digest"), same["provenance"]["digest"]);
  EXPECT_EQ(row.at("program"), same["provenance"]["program"]);
  EXPECT_EQ(row.at("sleeping.velocity"), "1e-05") << "also what is not varied";
  EXPECT_EQ(row.at("seed"), "1");
  EXPECT_EQ(row.at("merges"), same["merges"].dump());
  EXPECT_EQ(row.at("kinetic_energy"), same["kinetic_energy"].dump());
  EXPECT_EQ(row.at("reference_error_mean"), same["reference_error"]["mean"].dump());
  for (const char* column : {"cpu_seconds", "wall_seconds", "process_wall_seconds"}) {
    EXPECT_GT(std::stod(row.at(column)), 0.0) << column;
  }
}

TEST_F(StudyCommand, RunsOnlyWhatIsMissing) {
  run({"study", "grid.toml", "-o", "out"});
  const std::string before = read("out/study.csv");
  const Outcome again = run({"study", "grid.toml", "-o", "out"});
  EXPECT_THAT(again.out, HasSubstr("0 of them ran now"));
  EXPECT_EQ(read("out/study.csv"), before) << "the measured seconds are those of the first time";
  const Words names = files("out/rows");
  fs::remove(folder() / "out/rows" / names[3]);
  EXPECT_THAT(run({"study", "grid.toml", "-o", "out"}).out, HasSubstr("1 of them ran now"));
}

TEST_F(StudyCommand, RunsADamagedRowAgain) {
  run({"study", "grid.toml", "-o", "out"});
  const Words names = files("out/rows");
  write("out/rows/" + names[0], "{\"format\":\"merge2d-stu");
  write("out/rows/" + names[1], "");
  write("out/rows/" + names[2], "[1, 2]");
  const Outcome outcome = run({"study", "grid.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("3 of them ran now"));
}

TEST_F(StudyCommand, AGridThatGrowsKeepsItsRows) {
  run({"study", "grid.toml", "-o", "out"});
  std::string grown = kGrid;
  grown.replace(grown.find("[0.01, 0.02]"), 12, "[0.005, 0.01, 0.02]");
  write("grid.toml", grown);
  EXPECT_THAT(run({"study", "grid.toml", "-o", "out"}).out,
              AllOf(StartsWith("18 runs: 18 finished"), HasSubstr("6 of them ran now")));
}

TEST_F(StudyCommand, AChangedSceneIsRunAgain) {
  run({"study", "grid.toml", "-o", "out"});
  write("stack.toml", std::string(kStack) + "friction = 0.3\n");
  EXPECT_THAT(run({"study", "grid.toml", "-o", "out"}).out, HasSubstr("12 of them ran now"));
}

TEST_F(StudyCommand, ARunThatFailsIsARowWithItsExitCode) {
  write("grid.toml", R"(
scenes = ["stack.toml"]
steps = 5
[parameters]
solver.iterations = [10, 0]
)");
  const Outcome outcome = run({"study", "grid.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("run 2 failed with exit code 3"), HasSubstr("1 of 2 runs failed")));
  const Rows rows = table();
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_EQ(rows[1].at("exit_code"), "3");
  EXPECT_THAT(rows[1].at("message"), HasSubstr("'iterations' in [solver] must be"));
  EXPECT_THAT(run({"study", "grid.toml", "-o", "out"}).out, HasSubstr("1 of them ran now"))
      << "what failed is tried again";
}

TEST_F(StudyCommand, ARunBeyondItsMemoryOrItsTimeIsARow) {
  write("discs.toml", "[[body]]\ncircle = 0.1\nrepeat = { count = [100, 50], spacing = [1, 1] }\n");
  write("memory.toml", "scenes = [\"discs.toml\"]\nsteps = 1\nmemory_limit = \"1MB\"\n");
  EXPECT_EQ(run({"study", "memory.toml", "-o", "memory"}).code, 1);
  EXPECT_EQ(table("memory").at(0).at("exit_code"), "4");
  EXPECT_THAT(table("memory").at(0).at("message"), HasSubstr("more memory than the limit"));
  write("time.toml", "scenes = [\"pile\"]\nsteps = 1000000\ntime_limit = 0.2\n");
  EXPECT_EQ(run({"study", "time.toml", "-o", "time"}).code, 1);
  EXPECT_EQ(table("time").at(0).at("exit_code"), "137");
  EXPECT_THAT(table("time").at(0).at("message"), HasSubstr("longer than its time limit"));
}

TEST_F(StudyCommand, TheListedCommandsMakeTheSameRows) {
  const Outcome list = run({"study", "grid.toml", "-o", "out", "--list"});
  const Words lines = linesOf(list.out);
  ASSERT_THAT(lines, SizeIs(12));
  EXPECT_THAT(lines[2], StartsWith("merge2d study grid.toml --output out --only 3 --quiet  # "
                                   "merge2d run stack.toml --mode reference --set "
                                   "merging.velocity=0.01 --set solver.iterations=12 --steps 20"));
  EXPECT_FALSE(fs::exists(folder() / "out")) << "a list runs nothing";
  for (const char* part : {"1-5", "6", "7-12"}) {
    const Outcome outcome = run({"study", "grid.toml", "-o", "out", "--only", part});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  EXPECT_FALSE(fs::exists(folder() / "out/study.csv"));
  EXPECT_EQ(rowFiles(), 12U);
  const Outcome collected = run({"study", "grid.toml", "-o", "out", "--collect"});
  EXPECT_THAT(collected.out, AllOf(HasSubstr("12 finished"), HasSubstr("0 of them ran now")));
  EXPECT_THAT(table(), SizeIs(12));
}

TEST_F(StudyCommand, TheListedCommandsCallTheProgramThatListsThem) {
  callAs("/opt/my tools/merge2d");
  const Words lines = linesOf(run({"study", "grid.toml", "-o", "out", "--list"}).out);
  ASSERT_THAT(lines, SizeIs(12));
  EXPECT_THAT(lines[0], StartsWith("'/opt/my tools/merge2d' study grid.toml --output out --only 1 "
                                   "--quiet  # '/opt/my tools/merge2d' run "));
}

TEST_F(StudyCommand, APartMayEndBeyondTheLastRunButNotBeginThere) {
  EXPECT_EQ(run({"study", "grid.toml", "-o", "out", "--only", "11-20"}).code, 0);
  EXPECT_EQ(rowFiles(), 2U);
  const Outcome backwards = run({"study", "grid.toml", "-o", "out", "--only", "2-1"});
  EXPECT_EQ(backwards.code, 2);
  EXPECT_THAT(backwards.err, HasSubstr("--only 2-1: the last run comes before the first"));
  const Outcome beyond = run({"study", "grid.toml", "-o", "out", "--only", "13"});
  EXPECT_EQ(beyond.code, 2);
  EXPECT_THAT(beyond.err, HasSubstr("begins with run 13, but the study has 12"));
}

TEST_F(StudyCommand, DrawsAReportThatNeedsNothingBesideIt) {
  run({"study", "grid.toml", "-o", "out"});
  const Outcome outcome = run({"study", "--report", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string page = read("out/report.html");
  EXPECT_THAT(page, AllOf(StartsWith("<!DOCTYPE html>"), HasSubstr("<h1>grid</h1>"),
                          HasSubstr("12 runs, 0 of them failed"),
                          HasSubstr("Over merging.velocity and solver.iterations, means"),
                          HasSubstr("<h3>Distribution</h3>")));
  for (const char* way : {"src=", "http-equiv", "@import", "url(http"}) {
    EXPECT_THAT(page, Not(HasSubstr(way))) << way;
  }
  EXPECT_EQ(run({"study", "--report", "out"}).code, 0) << "it is one of ours";
}

TEST_F(StudyCommand, AReportNamesTheRunsThatFailed) {
  write("grid.toml",
        "title = \"A <b> & c\"\nscenes = [\"stack.toml\"]\nsteps = 5\n"
        "[parameters]\nsolver.iterations = [10, 0, 20]\n");
  run({"study", "grid.toml", "-o", "out"});
  EXPECT_EQ(run({"study", "--report", "out"}).code, 0);
  EXPECT_THAT(read("out/report.html"),
              AllOf(HasSubstr("<h1>A &lt;b&gt; &amp; c</h1>"), HasSubstr("Runs that failed"),
                    HasSubstr("&#39;iterations&#39; in [solver] must be")));
}

TEST_F(StudyCommand, NoReportOfWhatIsNoStudy) {
  const Outcome outcome = run({"study", "--report", "."});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("is not the folder of a study: it has no study.json"));
}

TEST_F(StudyCommand, CollectTellsWhatIsMissing) {
  run({"study", "grid.toml", "-o", "out", "--only", "2-3"});
  const Outcome collected = run({"study", "grid.toml", "-o", "out", "--collect"});
  EXPECT_EQ(collected.code, 0);
  EXPECT_THAT(collected.out, StartsWith("12 runs: 2 finished, 0 failed, 10 missing"));
  EXPECT_THAT(table(), SizeIs(2));
}

TEST_F(StudyCommand, DrawsTheSameSamplesEachTimeAndKeepsThemWhenThereAreMore) {
  const auto samples = [&](const std::string& design) {
    write("random.toml", "scenes = [\"stack.toml\"]\nsteps = 2\n[design]\n" + design +
                             "\n[parameters]\nmerging.velocity = { from = 0.001, to = 0.1, scale = "
                             "\"log\" }\nsolver.iterations = { from = 5, to = 20 }\n"
                             "merging.cycles = [\"off\", \"rigid\"]\n");
    const Outcome outcome = run({"study", "random.toml", "--list"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    Words commands;
    for (const std::string& line : linesOf(outcome.out)) {
      commands.push_back(line.substr(line.find("# ")));
    }
    return commands;
  };
  const Words few = samples("kind = \"random\"\nsamples = 20");
  EXPECT_THAT(few, SizeIs(20));
  EXPECT_THAT(std::set<std::string>(few.begin(), few.end()), SizeIs(20));
  Words more = samples("kind = \"random\"\nsamples = 30");
  more.resize(20);
  EXPECT_EQ(more, few);
  EXPECT_NE(samples("kind = \"random\"\nsamples = 20\nseed = 2"), few);
  EXPECT_THAT(samples("kind = \"latin\"\nsamples = 20"), SizeIs(20));
}

TEST_F(StudyCommand, ALatinHypercubeCoversEachAxisEvenly) {
  write("latin.toml", R"(
scenes = ["stack.toml"]
steps = 2
[design]
kind = "latin"
samples = 16
[parameters]
solver.iterations = { from = 1, to = 16 }
)");
  const Outcome outcome = run({"study", "latin.toml", "--list"});
  for (int i = 1; i <= 16; ++i) {
    EXPECT_THAT(outcome.out, HasSubstr("solver.iterations=" + std::to_string(i) + " "));
  }
}

TEST_F(StudyCommand, SaysWhatIsWrongInAStudyFileAndWhere) {
  const auto error = [&](const std::string& text) {
    write("bad.toml", text);
    const Outcome outcome = run({"study", "bad.toml", "-o", "bad"});
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_FALSE(fs::exists(folder() / "bad"));
    return outcome.err;
  };
  EXPECT_THAT(error("scene = [\"pile\"]\n"),
              HasSubstr("bad.toml:1:1: unknown key 'scene' in the study (did you mean 'scenes'?)"));
  EXPECT_THAT(error("steps = 1\nscenes = [\"pil\"]\n"),
              AllOf(HasSubstr("bad.toml:2:10: no built-in scene is called 'pil'"),
                    HasSubstr("did you mean 'pile'?")));
  EXPECT_THAT(error("scenes = [\"no/such.toml\"]\n"),
              HasSubstr("bad.toml:1:10: there is no file no/such.toml"));
  EXPECT_THAT(error("scenes = [\"pile\"]\nmodes = [\"merg\"]\n"), HasSubstr("did you mean"));
  EXPECT_THAT(error("scenes = [\"pile\"]\n[parameters]\nmerging.velocty = [1]\n"),
              HasSubstr("bad.toml:3:19: unknown key 'velocty' in [merging] (did you mean "
                        "'velocity'?), in pile"));
  EXPECT_THAT(
      error("scenes = [\"books\"]\n[parameters]\nstep = [0.01]\nbody.diry.mass = [1]\n"),
      HasSubstr("bad.toml:4:18: no body is called 'diry' (did you mean 'diary'?), in books"));
  EXPECT_THAT(error("scenes = [\"pile\"]\n[parameters]\nstep = { from = 1, to = 2.5 }\n"),
              HasSubstr("needs a 'count' or a 'by'"));
  EXPECT_THAT(error("scenes = [\"pile\"]\n[parameters]\nstep = { from = 2, to = 1 }\n"),
              HasSubstr("'to' must not be less than 'from'"));
  EXPECT_THAT(error("scenes = [\"pile\"]\n[design]\nkind = \"random\"\n"),
              HasSubstr("[design] needs the key 'samples'"));
  EXPECT_THAT(error("scenes = [\"pile\"]\nsteps = 1\nseconds = 1\n"),
              HasSubstr("give one of them"));
  EXPECT_THAT(error("scenes = [\"pile\"]\nseeds = { from = 1, to = 99999 }\n[parameters]\nsolver."
                    "iterations = { from = 1, to = 1000 }\n"),
              HasSubstr("a study has at most 1000000"));
}

TEST_F(StudyCommand, LeavesFoldersOfOthersAlone) {
  fs::create_directories(folder() / "thesis");
  write("thesis/chapter1.tex", "precious");
  const Outcome outcome = run({"study", "grid.toml", "-o", "thesis"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("thesis has files in it and no study"));
  EXPECT_THAT(files("thesis"), ElementsAre("chapter1.tex"));
}

TEST_F(StudyCommand, SeedsAreRunsOfTheirOwn) {
  write("seeds.toml", "scenes = [\"stack.toml\"]\nsteps = 2\nseeds = { from = 1, to = 5 }\n");
  EXPECT_EQ(run({"study", "seeds.toml", "-o", "out"}).code, 0);
  Words seeds;
  for (const auto& row : table()) seeds.push_back(row.at("seed"));
  EXPECT_THAT(seeds, ElementsAre("1", "2", "3", "4", "5"));
}

TEST_F(StudyCommand, FindsSceneFilesBesideTheStudy) {
  fs::create_directories(folder() / "inner");
  write("inner/my.toml", kStack);
  write("inner/grid.toml", "scenes = [\"my.toml\"]\nsteps = 2\n");
  EXPECT_EQ(run({"study", "inner/grid.toml", "-o", "out"}).code, 0);
  EXPECT_EQ(table().at(0).at("scene"), "inner/my.toml");
}

TEST_F(StudyCommand, RunsTheSceneOfALesson) {
  write("lesson.toml", "scenes = [\"one-step\"]\nsteps = 2\n");
  const Outcome outcome = run({"study", "lesson.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(table().at(0).at("scene"), "one-step");
}

TEST_F(StudyCommand, GivesItsCountsAsJson) {
  const Json json = run({"study", "grid.toml", "-o", "out", "--json", "--quiet"}).json();
  EXPECT_THAT(keysOf(json), ElementsAre("runs", "finished", "failed", "ran", "csv"));
  EXPECT_EQ(json["finished"], 12);
}

}  // namespace
}  // namespace merge2d
