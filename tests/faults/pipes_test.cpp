/// Scenes that come out of a pipe, by content: text or picture.

#include "tests/faults/fault_testing.h"

namespace merge2d {
namespace {

class Pipes : public FaultTest {
 protected:
  /// Writes to a named pipe, once, from a process of its own.
  pid_t feed(const std::string& pipe, const std::string& bytes) const {
    const pid_t child = fork();
    if (child != 0) return child;
    const int end = open((folder() / pipe).c_str(), O_WRONLY);
    std::string_view rest = bytes;
    while (!rest.empty()) {
      const ssize_t written = ::write(end, rest.data(), std::min<std::size_t>(rest.size(), 1000));
      if (written <= 0) _exit(1);
      rest.remove_prefix(static_cast<std::size_t>(written));
    }
    _exit(0);
  }

  /// Every command that takes a scene, quick and without a trace of where the scene came from.
  static std::vector<Words> commandsOn(const std::string& scene) {
    return {{"validate", scene},
            {"run", scene, "--no-timings"},
            {"render", scene, "-r", "64x48", "-s", "-o", "out", "--quiet"},
            {"compare", scene, "--no-charts", "--json"},
            {"explain", scene, "--at", "40"},
            {"lesson", scene, "-o", "page.html", "--force"},
            {"step", scene}};
  }
};

TEST_F(Pipes, EveryCommandReadsTheStandardInput) {
  for (const char* name : {"-", "/dev/stdin", "/dev/fd/0"}) {
    for (const Words& arguments : commandsOn(name)) {
      if (arguments[0] == "step") continue;  // whose commands come from there
      sendInput(kStack);
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.code, kFine) << arguments[0] << " " << name << outcome.err;
      fs::remove_all(folder() / "out");
    }
  }
}

TEST_F(Pipes, EveryCommandReadsANamedPipe) {
  makePipe("fifo");
  for (const Words& arguments : commandsOn("fifo")) {
    const pid_t writer = feed("fifo", kStack);
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, kFine) << arguments[0] << outcome.err;
    int status = 0;
    waitpid(writer, &status, 0);
    fs::remove_all(folder() / "out");
  }
}

TEST_F(Pipes, WhatComesOutOfAPipeIsTheSameScene) {
  const std::string from_file = run({"validate", "stack.toml", "--to", "-"}).out;
  sendInput(kStack);
  EXPECT_EQ(run({"validate", "-", "--to", "-"}).out, from_file);
}

TEST_F(Pipes, APictureIsKnownByItsContent) {
  ASSERT_EQ(run({"render", "stack.toml", "-r", "64x48", "-s", "--fps", "10", "-o", "shot"}).code,
            kFine);
  const std::string picture = read("shot/frame_000005.png");
  sendInput(picture);
  const Outcome piped = run({"validate", "-"});
  EXPECT_THAT(piped.err + piped.out, Not(HasSubstr("not valid UTF-8")));
  EXPECT_EQ(piped.code, run({"validate", "shot/frame_000005.png"}).code);
}

TEST_F(Pipes, MistakesHaveTheirPlaceInThem) {
  sendInput("[[body]]\nboks = [1, 1]\n");
  EXPECT_THAT(run({"run", "-"}).err, HasSubstr("<stdin>:2:1: unknown key 'boks'"));
}

TEST_F(Pipes, WhatHasNoEndIsGivenUp) {
  beforeStart([] { alarm(60); });
  const Outcome scene = run({"validate", "/dev/zero"});
  EXPECT_EQ(scene.code, kBadScene) << scene.signal;
  EXPECT_THAT(scene.err, HasSubstr("/dev/zero: a scene file has at most 64 MB"));
  const Outcome snapshot = run({"run", "stack.toml", "--resume", "/dev/zero"});
  EXPECT_EQ(snapshot.code, kBadScene) << snapshot.signal;
  EXPECT_THAT(snapshot.err, HasSubstr("/dev/zero: this is no snapshot of merge2d"));
}

TEST_F(Pipes, ASnapshotComesThroughAPipeToo) {
  ASSERT_EQ(run({"run", "stack.toml", "--steps", "20", "--snapshot", "s.state"}).code, kFine);
  makePipe("fifo");
  const pid_t writer = feed("fifo", read("s.state"));
  EXPECT_EQ(run({"run", "stack.toml", "--resume", "fifo"}).code, kFine);
  int status = 0;
  waitpid(writer, &status, 0);
}

}  // namespace
}  // namespace merge2d
