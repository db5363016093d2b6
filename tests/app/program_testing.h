#pragma once
/// Runs the real program in a folder of its own, as a shell would.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/build_dir.h"
#include "tests/support/temporary_folder.h"

namespace merge2d {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

// What is said of an output.
using testing::AllOf;
using testing::Contains;
using testing::ContainsRegex;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

/// What a run of the program left.
struct Outcome {
  int code = -1;    ///< what it returned; -1 when a signal ended it
  int signal = 0;   ///< that ended it
  std::string out;  ///< standard output
  std::string err;  ///< standard error

  Json json() const { return Json::parse(out); }
};

inline std::string contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << "there is no file " << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

inline Words linesOf(const std::string& text) {
  std::istringstream in(text);
  Words lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The keys of an object, in order.
inline Words keysOf(const Json& object) {
  Words keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

/// A test in an empty folder, which is gone afterwards; the program runs in there.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest() : root_(pathOfThisTest()) {
    fs::remove_all(root_);
    fs::create_directories(folder());
  }
  ~ProgramTest() override {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }

  /// Where the program runs.
  fs::path folder() const { return root_ / "here"; }
  fs::path operator/(const std::string& name) const { return folder() / name; }
  std::string read(const std::string& name) const { return contentOf(folder() / name); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder() / name, std::ios::binary) << text;
  }

  /// All files and folders below the folder, by their names from there.
  Words files(const std::string& below = ".") const {
    Words names;
    for (const auto& entry : fs::recursive_directory_iterator(folder() / below)) {
      names.push_back(fs::relative(entry.path(), folder() / below).string());
    }
    std::ranges::sort(names);
    return names;
  }

  /// Variables of the environment for the runs that follow; an empty value unsets.
  void setEnvironment(const std::string& name, const std::string& value) {
    environment_[name] = value;
  }

  /// The first word of the command lines of the runs that follow.
  void callAs(const std::string& name) { called_ = name; }

  /// Starts the program and does not wait.
  pid_t start(const Words& arguments) const {
    // Also of a run that is killed before it has begun.
    for (const char* name : {"out", "err"}) std::ofstream(root_ / name, std::ios::trunc);
    const pid_t child = fork();
    if (child != 0) return child;
    redirect(STDIN_FILENO, input_.empty() ? fs::path("/dev/null") : input_, O_RDONLY);
    redirect(STDOUT_FILENO, stdout_.empty() ? root_ / "out" : fs::path(stdout_), kWrite);
    redirect(STDERR_FILENO, root_ / "err", kWrite);
    for (const auto& [name, value] : environment_) {
      value.empty() ? unsetenv(name.c_str()) : setenv(name.c_str(), value.c_str(), 1);
    }
    if (prepare_) prepare_();
    std::vector<char*> argv{const_cast<char*>(called_.c_str())};
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    const fs::path program = buildDir() / "merge2d";
    if (chdir(folder().c_str()) == 0) execv(program.c_str(), argv.data());
    _exit(127);
  }

  Outcome wait(pid_t child) const {
    int status = 0;
    waitpid(child, &status, 0);
    Outcome outcome;
    if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    if (stdout_.empty()) outcome.out = contentOf(root_ / "out");
    outcome.err = contentOf(root_ / "err");
    return outcome;
  }

  Outcome run(const Words& arguments) const { return wait(start(arguments)); }

  /// What the runs that follow read from their standard input.
  void sendInput(const std::string& text) {
    input_ = root_ / "in";
    std::ofstream(input_, std::ios::binary) << text;
  }

  /// Changes the circumstances of the runs that follow: closes descriptors, sets limits, ignores
  /// signals. Called in the child before the program begins.
  void beforeStart(std::function<void()> prepare) { prepare_ = std::move(prepare); }

  /// Sends the standard output of the runs that follow to a device instead.
  void sendOutputTo(const std::string& device) { stdout_ = device; }

 private:
  static constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;

  static void redirect(int stream, const fs::path& file, int flags) {
    const int opened = open(file.c_str(), flags, 0600);
    if (opened < 0 || dup2(opened, stream) < 0) _exit(127);
  }

  fs::path root_;
  std::string called_ = "merge2d";
  std::map<std::string, std::string> environment_;
  fs::path input_;
  std::string stdout_;
  std::function<void()> prepare_;
};

/// Three boxes that fall on top of each other and merge.
inline constexpr const char* kStack = R"(
format = 1
title = "Three boxes"
duration = 0.5
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [10, 1]
[[body]]
name = "box"
at = [0, 0.5]
box = [1, 1]
repeat = { count = [1, 3], spacing = [1, 1] }
)";

/// Two hinges at one place, about which a body turns 10⁸ times in a step: their rows are solved
/// where they have long ceased to be.
inline constexpr const char* kDiverging = R"(
format = 1
step = 0.1
duration = 500
[[body]]
name = "flea"
mass = 1
box = [0.1, 0.1]
at = [0, 0]
velocity = [0, 5e10]
[[body]]
name = "dog"
mass = 10
box = [1, 1]
at = [3, 0]
[[joint]]
kind = "revolute"
bodies = ["flea", "dog"]
at = [10, 0]
[[joint]]
kind = "revolute"
bodies = ["flea"]
at = [10, 0]
)";

}  // namespace merge2d
