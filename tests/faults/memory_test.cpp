/// Memory: a command that needs more than the limit ends with a sentence.

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "tests/faults/fault_testing.h"

namespace merge2d {
namespace {

/// Bodies of which each overlaps some dozens of others: allowed, and expensive.
constexpr const char* kDense = R"(
[[body]]
name = "ball"
circle = 0.5
repeat = { count = [100, 100], spacing = [0.12, 0.12] }
)";

class Memory : public FaultTest {
 protected:
  Memory() { write("dense.toml", kDense); }

  /// Runs the program with so much memory for its addresses [MB].
  Outcome runWithin(std::size_t megabytes, const Words& arguments) {
    beforeStart([megabytes] {
      const rlimit limit{megabytes << 20, megabytes << 20};
      setrlimit(RLIMIT_AS, &limit);
    });
    return run(arguments);
  }
};

TEST_F(Memory, EveryCommandThatSimulatesKeepsToTheLimit) {
  const std::vector<Words> commands = {{"run", "dense.toml"},
                                       {"render", "dense.toml", "-r", "64x48"},
                                       {"compare", "dense.toml", "--no-charts"},
                                       {"lesson", "dense.toml"},
                                       {"step", "dense.toml"},
                                       {"explain", "dense.toml", "--at", "1"},
                                       {"validate", "dense.toml"}};
  sendInput("event merge\n");  // to step, which does nothing else
  for (Words arguments : commands) {
    arguments.insert(arguments.end(), {"--memory-limit", "60MB"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, kFailed) << arguments[0] << outcome.signal;
    EXPECT_EQ(outcome.err,
              "error: this needs more memory than the limit of 60 MB; --memory-limit changes it\n")
        << arguments[0];
    fs::remove_all(folder() / "frames");  // a rendering may go on from its frames
    EXPECT_THAT(leftOver({"dense.toml", "stack.toml"}), IsEmpty()) << arguments[0];
  }
}

/// A limit that any of several threads meets, wherever in a step.
TEST_F(Memory, ThreadsThatMeetTheLimitEndWithTheSentence) {
  std::string walls =
      "[[body]]\nname = \"ground\"\nmotion = \"pinned\"\nbox = [400, 1]\nat = [0, -0.5]\n";
  for (int wall = 0; wall < 8; ++wall) {
    walls += fmt::format(
        "[[body]]\nname = \"wall{}\"\nbox = [1, 0.5]\nat = [{}, 0.25]\n"
        "repeat = {{ count = [20, 20], spacing = [1, 0.5] }}\n",
        wall, 24 * wall - 96);
  }
  write("walls.toml", walls);
  int refused = 0;
  for (double megabytes = 8; megabytes <= 16; megabytes += 0.5) {
    const std::string limit = fmt::format("{}MB", megabytes);
    const Outcome outcome =
        run({"run", "walls.toml", "--steps", "20", "--threads", "3", "--memory-limit", limit});
    EXPECT_EQ(outcome.signal, 0) << limit;
    if (outcome.code == kFine) continue;
    EXPECT_EQ(outcome.code, kFailed) << limit;
    EXPECT_THAT(outcome.err, StartsWith("error: this needs more memory than the limit of"))
        << limit;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << limit;
    ++refused;
  }
  EXPECT_GT(refused, 0) << "none of the limits was low enough to tell";
}

TEST_F(Memory, ALimitIsASizeOrAPartOfTheMachine) {
  for (const char* size : {"1GB", "1.5G", "2000M", "50%", "900000KB"}) {
    EXPECT_EQ(run({"run", "stack.toml", "--memory-limit", size}).code, kFine) << size;
  }
  for (const char* size : {"", "12", "0GB", "-1GB", "GB", "1 GB", "many", "1e99GB"}) {
    const Outcome outcome = run({"run", "stack.toml", "--memory-limit", size});
    EXPECT_EQ(outcome.code, kWrongUsage) << size;
    EXPECT_THAT(outcome.err, HasSubstr("--memory-limit must be a size such as 500MB, 2GB or 50%"));
  }
}

TEST_F(Memory, TheDefaultIsThreeQuartersOfTheMachine) {
  EXPECT_THAT(run({"run", "--help"}).out, HasSubstr("75% of the machine"));
}

#ifndef MERGE2D_SANITIZED  // which takes terabytes of addresses
/// A driver of OpenGL that is refused memory ends the process: it is not asked to draw then.
TEST_F(Memory, ARenderingWithLittleMemoryEndsWithASentence) {
  constexpr std::size_t kEnough = 760;
  int refused = 0;
  for (std::size_t megabytes = 60; megabytes <= kEnough; megabytes += 100) {
    const Outcome outcome =
        runWithin(megabytes, {"render", "stack.toml", "-r", "640x480", "--fps", "10", "--force"});
    EXPECT_EQ(outcome.signal, 0) << megabytes << " MB";
    if (outcome.code == kFine) continue;
    EXPECT_EQ(outcome.code, kFailed) << megabytes << " MB";
    EXPECT_THAT(outcome.err, HasSubstr("there is not enough memory")) << megabytes << " MB";
    ++refused;
  }
  EXPECT_GT(refused, 0) << "none of the limits was low enough to tell";
}
#endif

TEST_F(Memory, ACrowdIsFoundBeforeItTakesAnything) {
  write(
      "crowd.toml",
      "[[body]]\nname = \"brick\"\nbox = [1, 1]\nrepeat = { count = [3000, 1], spacing = [0, 0] }");
  for (const char* command : {"validate", "run", "render"}) {
    const Outcome outcome = run({command, "crowd.toml", "--memory-limit", "50MB"});
    EXPECT_EQ(outcome.code, kBadScene) << command;
    EXPECT_THAT(outcome.err, HasSubstr("2,999 bodies lie in the place of brick[0,0]"));
  }
}

}  // namespace
}  // namespace merge2d
