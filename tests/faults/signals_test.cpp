/// Signals: what was ignored stays ignored, and what ends the program leaves nothing behind.

#include "tests/faults/fault_testing.h"

namespace merge2d {
namespace {

class Signals : public FaultTest {
 protected:
  Signals() { makePipe("pipe"); }

  /// A run that writes more into the pipe than fits, so that it waits for its reader.
  pid_t startRun() const {
    return start({"run", "stack.toml", "--seconds", "5", "--trace", "pipe", "--csv", "run.csv",
                  "--snapshot", "run.state", "--quiet"});
  }

  Words leavings() const { return leftOver({"stack.toml", "pipe"}); }
};

std::vector<int> endingSignals() {
  std::vector<int> signals = {SIGINT,  SIGTERM, SIGHUP,  SIGXCPU, SIGQUIT, SIGUSR1,   SIGUSR2,
                              SIGALRM, SIGABRT, SIGSEGV, SIGBUS,  SIGFPE,  SIGILL,    SIGTRAP,
                              SIGSYS,  SIGPOLL, SIGPROF, SIGPWR,  SIGKILL, SIGVTALRM, SIGSTKFLT};
  signals.insert(signals.end(), {SIGRTMIN, SIGRTMAX});
  return signals;
}

TEST_F(Signals, WhatWasIgnoredStaysIgnored) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGQUIT, SIGUSR1, SIGXCPU, SIGALRM}) {
    beforeStart([&] { ::signal(signal, SIG_IGN); });
    const pid_t child = startRun();
    const int pipe = openPipe("pipe");
    kill(child, signal);
    drain(pipe);
    const Outcome outcome = wait(child);
    EXPECT_EQ(outcome.code, kFine) << strsignal(signal) << outcome.err << outcome.signal;
    EXPECT_THAT(leavings(), ElementsAre("run.csv", "run.state"));
  }
}

TEST_F(Signals, TheEndBySignalLeavesNothing) {
  for (const int signal : endingSignals()) {
    beforeStart([] {
      const rlimit none{0, 0};
      setrlimit(RLIMIT_CORE, &none);
    });
    const pid_t child = startRun();
    const int pipe = openPipe("pipe");
    kill(child, signal);
    const Outcome outcome = wait(child);
    close(pipe);
    EXPECT_EQ(outcome.signal, signal) << strsignal(signal) << outcome.code << outcome.err;
    EXPECT_THAT(leavings(), IsEmpty()) << strsignal(signal);
  }
}

TEST_F(Signals, AProgramThatWaitsForAReaderCanBeInterrupted) {
  const pid_t child = start({"run", "stack.toml", "--trace", "pipe", "--csv", "run.csv"});
  usleep(300'000);  // it opens the pipe, which nobody reads
  kill(child, SIGTERM);
  EXPECT_EQ(wait(child).signal, SIGTERM);
  EXPECT_THAT(leavings(), IsEmpty());
}

TEST_F(Signals, OnesThatStopNothingAreHarmless) {
  for (const int signal : {SIGPIPE, SIGXFSZ, SIGCHLD, SIGWINCH, SIGURG, SIGCONT}) {
    const pid_t child = startRun();
    const int pipe = openPipe("pipe");
    kill(child, signal);
    drain(pipe);
    EXPECT_EQ(wait(child).code, kFine) << strsignal(signal);
  }
}

/// "nohup merge2d … &" in a terminal that is closed.
TEST_F(Signals, ARenderingUnderNohupIsFinished) {
  beforeStart([] { signal(SIGHUP, SIG_IGN); });
  const pid_t child = start(renderStack({"--seconds", "5"}));
  ASSERT_TRUE(waitUntil([&] { return exists("frames/stack/frame_000000.png"); }));
  kill(child, SIGHUP);
  EXPECT_EQ(wait(child).code, kFine);
  EXPECT_EQ(Json::parse(read("frames/stack/run.json"))["complete"], true);
}

/// The limit of processor time asks first (SIGXCPU) and kills later.
TEST_F(Signals, ALimitOfProcessorTimeLeavesNothing) {
  beforeStart([] {
    const rlimit limit{1, 60};
    setrlimit(RLIMIT_CPU, &limit);
  });
  const Outcome outcome =
      run({"run", "pile", "--steps", "100000000", "--csv", "run.csv", "--trace", "/dev/null"});
  EXPECT_EQ(outcome.signal, SIGXCPU) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
  EXPECT_THAT(leavings(), IsEmpty());
}

class Film : public FaultTest {
 protected:
  bool filming() const { return exists("started"); }

  /// The process of the program that stands in for ffmpeg.
  pid_t filmer() const { return std::stoi(read("started")); }

  /// Ended, or waiting to be noticed by whoever inherited it.
  static bool gone(pid_t process) {
    std::ifstream in("/proc/" + std::to_string(process) + "/stat");
    std::string number, name, state;
    return !(in >> number >> name >> state) || state == "Z";
  }

  Words temporaries() const {
    Words found;
    for (const std::string& name : files()) {
      if (name.find(".merge2d") != std::string::npos) found.push_back(name);
    }
    return found;
  }
};

constexpr const char* kWaits = "echo half > \"$last\"\necho $$ > started\nexec sleep 100\n";

TEST_F(Film, ASignalIsHandedOnToFfmpeg) {
  installFfmpeg(kWaits);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    fs::remove(folder() / "started");
    const pid_t child = start(renderStack({"--format", "mp4", "--resume"}));
    ASSERT_TRUE(waitUntil([&] { return filming() && read("started").ends_with('\n'); }));
    const pid_t filmer = this->filmer();
    kill(child, signal);
    const Outcome outcome = wait(child);
    EXPECT_EQ(outcome.signal, signal) << outcome.code << outcome.err;
    EXPECT_TRUE(gone(filmer));
    EXPECT_THAT(temporaries(), IsEmpty());
    EXPECT_FALSE(exists("frames/stack/stack.mp4"));
  }
}

TEST_F(Film, FfmpegEndsWithItsParent) {
  installFfmpeg(kWaits);
  for (const int signal : {SIGKILL, SIGQUIT, SIGUSR1}) {
    fs::remove(folder() / "started");
    const pid_t child = start(renderStack({"--format", "mp4", "--resume"}));
    ASSERT_TRUE(waitUntil([&] { return filming() && read("started").ends_with('\n'); }));
    const pid_t filmer = this->filmer();
    kill(child, signal);
    EXPECT_EQ(wait(child).signal, signal);
    EXPECT_TRUE(waitUntil([&] { return gone(filmer); }));
    EXPECT_TRUE(signal == SIGKILL || temporaries().empty());
  }
  // What SIGKILL left goes with the next rendering.
  installFfmpeg("echo film > \"$last\"\n");
  EXPECT_EQ(run(renderStack({"--format", "mp4", "--resume"})).code, kFine);
  EXPECT_THAT(temporaries(), IsEmpty());
  EXPECT_EQ(read("frames/stack/stack.mp4"), "film\n");
}

TEST_F(Film, AnFfmpegThatDoesNotListenIsKilled) {
  installFfmpeg("trap '' TERM\necho $$ > started\nwhile :; do sleep 1; done\n");
  const pid_t child = start(renderStack({"--format", "mp4"}));
  ASSERT_TRUE(waitUntil([&] { return filming() && read("started").ends_with('\n'); }));
  kill(child, SIGTERM);
  EXPECT_EQ(wait(child).signal, SIGTERM);
  EXPECT_TRUE(gone(filmer()));
}

TEST_F(Film, FfmpegGetsTheSignalsTheProgramWasStartedWith) {
  installFfmpeg("grep SigIgn /proc/self/status > \"$last\"\n");
  EXPECT_EQ(run(renderStack({"--format", "mp4"})).code, kFine);
  const std::string mask = read("frames/stack/stack.mp4");
  EXPECT_EQ(std::stoull(mask.substr(mask.find(':') + 1), nullptr, 16) &
                (1ULL << (SIGPIPE - 1) | 1ULL << (SIGXFSZ - 1)),
            0U);
}

TEST_F(Film, TheReasonOfAFailureIsOneLine) {
  const std::map<std::string, std::string> reasons = {
      {"echo '[libx264 @ 0x55] broken pixels' >&2; echo 'Conversion failed!' >&2; exit 1",
       "stack.mp4: broken pixels; this is its command: ffmpeg"},
      {"printf '\\n\\033[31mbad\\nworse' >&2; exit 1", "stack.mp4: \\u001b[31mbad; this"},
      {"exit 3", "stack.mp4: it returned 3 without a word; this"},
      {"kill -9 $$", "stack.mp4: signal 9 ended it (Killed); this"}};
  for (const auto& [script, reason] : reasons) {
    installFfmpeg(script);
    const Outcome outcome = run(renderStack({"--format", "mp4", "--resume", "--quiet"}));
    EXPECT_EQ(outcome.code, kFailed);
    EXPECT_THAT(outcome.err, HasSubstr("ffmpeg could not write frames/stack/" + reason));
    EXPECT_THAT(linesOf(outcome.err), SizeIs(1)) << outcome.err;
    EXPECT_THAT(temporaries(), IsEmpty());
  }
  installFfmpeg("");
  std::ofstream(folder() / "bin/ffmpeg") << "#!/no/such/shell\n";
  EXPECT_THAT(run(renderStack({"--format", "mp4"})).err, HasSubstr("No such file or directory"));
}

TEST_F(Film, NoPathLooksLikeAnOptionOrAProtocol) {
  installFfmpeg("for a; do echo \"$a\"; done > \"$last\"\n");
  EXPECT_EQ(run(renderStack({"--format", "mp4", "-o", "a:b"})).code, kFine);
  EXPECT_THAT(linesOf(read("a:b/stack.mp4")), Contains("./a:b/frame_%06d.png"));
  EXPECT_THAT(linesOf(read("a:b/stack.mp4")).back(), StartsWith("./a:b/"));
  EXPECT_EQ(run(renderStack({"--format", "gif", "-o", "./-x"})).code, kFine);
  EXPECT_THAT(read("-x/stack.gif"), Not(HasSubstr("\n-x")));
}

}  // namespace
}  // namespace merge2d
