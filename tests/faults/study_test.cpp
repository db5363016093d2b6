/// Studies that are killed, and their continuation.

#include <algorithm>
#include <random>
#include <set>

#include "tests/faults/fault_testing.h"

namespace merge2d {
namespace {

class StudyFault : public FaultTest {
 protected:
  static constexpr int kRuns = 60;

  StudyFault() {
    write("study.toml", "scenes = [\"stack.toml\"]\nsteps = 5\nseeds = { from = 1, to = " +
                            std::to_string(kRuns) + " }\n");
  }

  /// The rows that are kept, by their files.
  std::map<std::string, std::string> keptRows() const { return contents("out/rows"); }

  const Words study_ = {"study", "study.toml", "-o", "out", "-j", "2", "--quiet"};
  pid_t run_ = 0;  ///< a run of the study
};

TEST_F(StudyFault, LosesNoRowWhenKilledAtAnyMoment) {
  std::map<std::string, std::string> rows;
  for (int trial = 0; trial < 20; ++trial) {
    const pid_t child = start(study_);
    usleep(static_cast<useconds_t>(1000 * (20 + 23 * trial)));
    kill(child, SIGKILL);
    wait(child);
    const auto now = keptRows();
    for (const auto& [name, bytes] : rows) {
      ASSERT_TRUE(now.contains(name)) << name << " is still there";
      EXPECT_EQ(now.at(name), bytes) << name << " was not run again";
    }
    for (const auto& [name, bytes] : now) {
      if (name.starts_with(".")) continue;
      EXPECT_FALSE(Json::parse(bytes, nullptr, false).is_discarded()) << name << " is whole";
      rows[name] = bytes;
    }
    if (!exists("out/study.csv")) continue;
    const std::string csv = read("out/study.csv");
    EXPECT_TRUE(csv.empty() || csv.back() == '\n') << "of whole lines";
  }
  const Outcome outcome = run(study_);
  EXPECT_EQ(outcome.code, kFine) << outcome.err;
  EXPECT_EQ(linesOf(read("out/study.csv")).size(), 1U + kRuns);
  for (const auto& [name, bytes] : rows) EXPECT_EQ(keptRows().at(name), bytes) << name;
}

TEST_F(StudyFault, TheRunsOfAKilledStudyEnd) {
  write("study.toml", "scenes = [\"pile\"]\nsteps = 100000000\nreference_error = false\n");
  const pid_t child = start(study_);
  const auto runs = [&] {
    int found = 0;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      std::ifstream stat(entry.path() / "stat");
      std::string text;
      std::getline(stat, text);
      const std::size_t name = text.rfind(") ");
      // "pid (name) state parent": the parent is the study, or, once it is gone, somebody else.
      if (name == std::string::npos) continue;
      std::istringstream rest(text.substr(name + 2));
      std::string state;
      pid_t parent = 0, group = 0;
      rest >> state >> parent >> group;
      if (parent == child && state != "Z") run_ = std::stoi(entry.path().filename());
      if (run_ != 0 && entry.path().filename() == std::to_string(run_) && state != "Z") ++found;
    }
    return found;
  };
  ASSERT_TRUE(waitUntil([&] { return runs() > 0; }));
  kill(child, SIGKILL);
  wait(child);
  EXPECT_TRUE(waitUntil([&] { return kill(run_, 0) != 0 || runs() == 0; }));
}

TEST_F(StudyFault, AnInterruptedStudyKeepsItsRowsAndNoBrokenOnes) {
  const pid_t child = start(study_);
  ASSERT_TRUE(waitUntil([&] { return keptRows().size() > 3; }));
  kill(child, SIGINT);
  const Outcome outcome = wait(child);
  EXPECT_TRUE(outcome.signal == SIGINT || outcome.code == 0);
  std::size_t finished = 0;
  for (const auto& [name, bytes] : keptRows()) {
    EXPECT_EQ(Json::parse(bytes)["exit_code"], 0) << name;
    ++finished;
  }
  EXPECT_EQ(linesOf(read("out/study.csv")).size(), 1 + finished);
}

TEST_F(StudyFault, TwoAtOnceInOneFolderAreRefusedButPartsAreNot) {
  write("study.toml", "scenes = [\"pile\"]\nsteps = 100000000\nreference_error = false\n");
  const pid_t first = start(study_);
  ASSERT_TRUE(waitUntil([&] { return exists("out/study.csv"); }));
  const Outcome second = run(study_);
  EXPECT_EQ(second.code, kFailed);
  EXPECT_THAT(second.err, HasSubstr("writes to out now"));
  kill(first, SIGKILL);
  wait(first);
}

TEST_F(StudyFault, PartsMayBeginAtOnceInAFolderThatIsNotThereYet) {
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<pid_t> parts;
    for (int i = 1; i <= 6; ++i) {
      parts.push_back(
          start({"study", "study.toml", "-o", "out", "--only", std::to_string(i), "--quiet"}));
    }
    for (const pid_t part : parts) {
      const Outcome outcome = wait(part);
      EXPECT_EQ(outcome.code, kFine) << outcome.err;
    }
    EXPECT_EQ(keptRows().size(), 6U);
    fs::remove_all(folder() / "out");
  }
}

TEST_F(StudyFault, AFullDiskIsAnErrorAndLosesNothing) {
  run({"study", "study.toml", "-o", "out", "--only", "1-5", "--quiet"});
  const auto before = keptRows();
  beforeStart([] {
    const rlimit none{.rlim_cur = 0, .rlim_max = 0};
    setrlimit(RLIMIT_FSIZE, &none);
  });
  EXPECT_NE(run(study_).code, kFine);
  beforeStart(nullptr);
  EXPECT_EQ(keptRows(), before);
  EXPECT_EQ(run(study_).code, kFine);
}

class LongStudy : public FaultTest {};

TEST_F(LongStudy, OfTenThousandShortRunsLosesNoRowHoweverOftenItIsKilled) {
  constexpr std::size_t kRuns = 10'000;
  write("study.toml",
        "scenes = [\"stack.toml\"]\nsteps = 2\nreference_error = false\nseeds = { from = 1, to = " +
            std::to_string(kRuns) + " }\n");
  const Words study = {"study", "study.toml", "-o", "out", "--quiet"};
  const auto rows = [&] {
    std::set<std::string> names;
    if (!exists("out/rows")) return names;
    for (const std::string& name : files("out/rows")) {
      if (!name.starts_with(".")) names.insert(name);
    }
    return names;
  };
  std::mt19937 random(1);
  std::set<std::string> before;
  for (int kills = 0; kills < 40 && before.size() < kRuns; ++kills) {
    const pid_t child = start(study);
    usleep(static_cast<useconds_t>(20'000 + random() % 2'000'000));
    kill(child, SIGKILL);
    wait(child);
    const std::set<std::string> now = rows();
    ASSERT_TRUE(std::ranges::includes(now, before)) << "after " << kills << " kills";
    before = now;
  }
  const Outcome outcome = run(study);
  EXPECT_EQ(outcome.code, kFine) << outcome.err;
  const Words lines = linesOf(read("out/study.csv"));
  ASSERT_EQ(lines.size(), 1 + kRuns);
  std::set<std::string> first;  // fields: the number of the run
  for (std::size_t i = 1; i < lines.size(); ++i) {
    first.insert(lines[i].substr(0, lines[i].find(',')));
  }
  EXPECT_EQ(first.size(), kRuns) << "each run has one row";
  EXPECT_EQ(rows().size(), kRuns);
}

}  // namespace
}  // namespace merge2d
