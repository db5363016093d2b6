/// Standard streams that are closed, full, or read by nobody: no message fails a command, and none
/// is written into a file.

#include "tests/faults/fault_testing.h"

namespace merge2d {
namespace {

/// How a standard stream can be of no use.
struct Broken {
  const char* how;
  void (*break_it)(int stream);
};

void closeIt(int stream) { close(stream); }

void fill(int stream) { dup2(open("/dev/full", O_WRONLY), stream); }

void closeItsReader(int stream) {
  int ends[2];
  if (pipe(ends) != 0) _exit(127);
  dup2(ends[1], stream);
  close(ends[0]);
  close(ends[1]);
}

constexpr Broken kBroken[] = {
    {"closed", closeIt}, {"full", fill}, {"a pipe that nobody reads", closeItsReader}};

class Streams : public FaultTest {
 protected:
  /// Runs the program with some of its standard streams broken in one way.
  Outcome runWith(const Broken& broken, const std::vector<int>& streams, const Words& arguments) {
    beforeStart([&] {
      for (const int stream : streams) broken.break_it(stream);
    });
    return run(arguments);
  }
};

TEST_F(Streams, AMessageThatNobodyGetsChangesNoExitCode) {
  const std::vector<std::pair<Words, int>> commands = {
      {{"run", "nosuch"}, kBadScene},
      {{"render", "stack.toml", "--nosuch"}, kWrongUsage},
      {{"run", "stack.toml", "--csv", "no/such/folder/"}, kFailed},
      {{"run", "stack.toml", "--verbose", "--steps", "3"}, kFine},
      {{"run", "stack.toml", "--seed", "7", "--trace", "-", "--steps", "3"}, kFine},
      {{"render", "stack.toml", "-r", "64x48", "--fps", "10"}, kFine},
      {{"render", "stack.toml", "-r", "64x48", "-s", "--format", "png", "--force"}, kFine},
      {{"compare", "stack.toml", "--csv", "modes.csv", "--no-charts"}, kFine},
      {{"validate", "stack.toml", "--to", "copy.toml", "--verbose"}, kFine},
      {{"doctor", "--verbose"}, kFine}};
  for (const Broken& broken : kBroken) {
    for (const auto& [arguments, code] : commands) {
      for (const std::string& made : files()) {
        if (made != "stack.toml") fs::remove_all(folder() / made);
      }
      const Outcome outcome = runWith(broken, {STDERR_FILENO}, arguments);
      EXPECT_EQ(outcome.code, code)
          << arguments[0] << ", stderr " << broken.how << ", signal " << outcome.signal;
    }
  }
}

TEST_F(Streams, ARenderingWithoutStderrIsComplete) {
  for (const Broken& broken : kBroken) {
    const Outcome outcome =
        runWith(broken, {STDERR_FILENO}, {"render", "stack.toml", "-r", "64x48", "--fps", "10"});
    EXPECT_EQ(outcome.code, kFine) << broken.how;
    EXPECT_THAT(outcome.out, StartsWith("frames/stack\n"));
    EXPECT_EQ(Json::parse(read("frames/stack/run.json"))["complete"], true);
    fs::remove_all(folder() / "frames");
  }
}

/// The lowest free descriptor goes to the next file that is opened.
TEST_F(Streams, NoMessageIsWrittenIntoAFile) {
  write("warned.toml", std::string(kStack) + "[merging]\nsteps = 3\nvelocity = 0.03\n");
  const std::map<std::string, Words> outputs = {
      {"page.html", {"lesson", "warned.toml", "-o", "page.html"}},
      {"copy.toml", {"validate", "warned.toml", "--to", "copy.toml"}},
      {"run.csv", {"run", "warned.toml", "--csv", "run.csv", "--no-timings", "--verbose"}},
      {"run.jsonl", {"run", "warned.toml", "--trace", "run.jsonl", "--no-timings", "--verbose"}},
      {"run.state", {"run", "warned.toml", "--snapshot", "run.state", "--verbose"}}};
  for (const auto& [file, arguments] : outputs) {
    beforeStart({});
    run(arguments);
    const std::string expected = read(file);
    for (const std::vector<int>& closed :
         {std::vector<int>{0}, {1}, {2}, {0, 1}, {0, 2}, {1, 2}, {0, 1, 2}}) {
      fs::remove(folder() / file);
      const Outcome outcome = runWith(kBroken[0], closed, arguments);
      EXPECT_EQ(outcome.signal, 0) << file;
      EXPECT_TRUE(read(file) == expected)
          << file << " with closed descriptors " << testing::PrintToString(closed);
    }
  }
}

/// Data that cannot be written is an error, unlike a message.
TEST_F(Streams, AResultThatCannotBeWrittenFails) {
  const std::vector<Words> commands = {{"list"},
                                       {"--version"},
                                       {"run", "--help"},
                                       {"run", "stack.toml"},
                                       {"run", "stack.toml", "--json"},
                                       {"run", "stack.toml", "--trace", "-"},
                                       {"validate", "stack.toml", "--to", "-"},
                                       {"lesson", "stack.toml", "-o", "-"},
                                       {"compare", "stack.toml", "--csv", "-", "--no-charts"},
                                       {"render", "stack.toml", "-r", "64x48", "-s"},
                                       {"explain", "stack.toml", "--at", "3"},
                                       {"step", "stack.toml"},
                                       {"doctor"}};
  sendInput("event merge\n");
  for (const Words& arguments : commands) {
    const Outcome closed = runWith(kBroken[0], {STDOUT_FILENO}, arguments);
    EXPECT_EQ(closed.code, kFailed) << arguments[0] << closed.err << closed.signal;
    EXPECT_THAT(closed.err, HasSubstr("cannot write to the standard output: Bad file descriptor"));
    const Outcome full = runWith(kBroken[1], {STDOUT_FILENO}, arguments);
    EXPECT_EQ(full.code, kFailed) << arguments[0] << full.err << full.signal;
    EXPECT_THAT(full.err,
                HasSubstr("cannot write to the standard output: No space left on device"));
  }
}

TEST_F(Streams, AReaderThatLeavesEndsTheProgramSilently) {
  for (const Words& arguments :
       {Words{"list"}, {"run", "stack.toml", "--trace", "-", "--csv", "run.csv"}}) {
    const Outcome outcome = runWith(kBroken[2], {STDOUT_FILENO}, arguments);
    EXPECT_EQ(outcome.signal, SIGPIPE) << outcome.code << outcome.err;
    EXPECT_THAT(outcome.err, Not(HasSubstr("error")));
    EXPECT_THAT(files(), ElementsAre("stack.toml"));
  }
  beforeStart([] {
    signal(SIGPIPE, SIG_IGN);
    closeItsReader(STDOUT_FILENO);
  });
  EXPECT_EQ(run({"list"}).code, kFailed) << "where SIGPIPE is ignored";
}

TEST_F(Streams, AllThreeMayBeClosed) {
  const Outcome outcome =
      runWith(kBroken[0], {0, 1, 2}, {"run", "stack.toml", "--csv", "run.csv", "--trace", "t"});
  EXPECT_EQ(outcome.code, kFailed) << "for the sake of the summary";
  EXPECT_THAT(read("run.csv"), StartsWith("step,t,"));
  EXPECT_THAT(read("t"), StartsWith("{\"type\":\"header\""));
  EXPECT_THAT(outcome.err, IsEmpty());
}

}  // namespace
}  // namespace merge2d
