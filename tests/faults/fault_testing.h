#pragma once
/// Runs of the program that something goes wrong with.

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <chrono>
#include <thread>

#include "tests/app/program_testing.h"

namespace merge2d {

constexpr int kFine = 0, kWrongUsage = 2, kBadScene = 3, kFailed = 4;

/// Waits until something is so, for a minute at most.
template <class Condition>
bool waitUntil(Condition&& condition) {
  using namespace std::chrono_literals;
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

class FaultTest : public ProgramTest {
 protected:
  FaultTest() { write("stack.toml", kStack); }

  bool exists(const std::string& name) const { return fs::exists(folder() / name); }

  /// All files below the folder but those that are there at first.
  Words leftOver(const Words& at_first = {"stack.toml"}) const {
    Words names = files();
    std::erase_if(names, [&](const std::string& name) {
      return std::ranges::find(at_first, name) != at_first.end();
    });
    return names;
  }

  void clear(const Words& but = {"stack.toml"}) const {
    for (const std::string& name : leftOver(but)) fs::remove_all(folder() / name);
  }

  /// Name and content of every file in a folder; nothing where there is none.
  std::map<std::string, std::string> contents(const std::string& name) const {
    std::map<std::string, std::string> all;
    if (!exists(name)) return all;
    for (const std::string& file : files(name)) {
      if (fs::is_regular_file(folder() / name / file)) all[file] = read(name + "/" + file);
    }
    return all;
  }

  void makePipe(const std::string& name) const {
    ASSERT_EQ(mkfifo((folder() / name).c_str(), 0600), 0);
  }

  /// The reading end of a named pipe. The program that writes to it is in the middle of its work
  /// from here on until all has been read.
  int openPipe(const std::string& name) const {
    const int pipe = open((folder() / name).c_str(), O_RDONLY);
    char first = 0;
    EXPECT_EQ(::read(pipe, &first, 1), 1);
    return pipe;
  }

  static void drain(int pipe) {
    char block[1 << 16];
    while (::read(pipe, block, sizeof block) > 0) {
    }
    close(pipe);
  }

  /// A program that stands in for ffmpeg: a shell script, whose variable $last is the film.
  void installFfmpeg(const std::string& script) {
    fs::create_directories(folder() / "bin");
    std::ofstream(folder() / "bin/ffmpeg") << "#!/bin/sh\nfor last; do :; done\n" << script;
    fs::permissions(folder() / "bin/ffmpeg", fs::perms::all);
    setEnvironment("PATH", (folder() / "bin").string() + ":/usr/bin:/bin");
  }
};

/// The film of the stack: 6 small frames.
inline Words renderStack(const Words& more = {}) {
  Words arguments = {"render", "stack.toml", "-r", "64x48", "--fps", "10"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace merge2d
