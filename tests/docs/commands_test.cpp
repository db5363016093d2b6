/// Runs what the pages show. Blocks marked `console` are dialogues: after "$ " stands a command,
/// below it what it prints, where "…" stands for anything. Commands in blocks marked `sh` are not
/// run, but merge2d must know them and their options.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>

#include "tests/docs/docs_testing.h"
#include "tests/support/build_dir.h"

namespace merge2d::docs {
namespace {

const fs::path kProgram = buildDir() / "merge2d";

/// What a shell command prints, errors included.
std::string outputOf(const std::string& command) {
  const auto close = [](FILE* pipe) { pclose(pipe); };
  const std::unique_ptr<FILE, decltype(close)> pipe(popen((command + " 2>&1").c_str(), "r"), close);
  std::string output;
  char buffer[4096];
  while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe.get()))
    output.append(buffer, n);
  return output;
}

/// A folder of its own in which `docs/` is the project's and `merge2d` the program just built.
class Commands : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(fs::exists(kProgram)) << "merge2d was not built";
    folder_ = fs::path(testing::TempDir()) / ("merge2d_docs_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::create_directory_symlink(kRoot / "docs", folder_ / "docs");
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  std::string run(const std::string& command) const {
    return outputOf("cd '" + folder_.string() + "' && PATH='" + kProgram.parent_path().string() +
                    "':$PATH && { " + command + "\n}");
  }

 private:
  fs::path folder_;
};

std::vector<Block> blocksOf(const std::string& language) {
  std::vector<Block> found;
  for (const fs::path& page : pages()) {
    for (const Block& block : pageOf(read(page)).blocks) {
      if (block.language == language) found.push_back(block);
    }
  }
  return found;
}

/// A text in which "…" stands for anything.
std::regex pattern(const std::string& text) {
  std::string escaped = std::regex_replace(text, std::regex(R"([.*+?^${}()|[\]\\])"), R"(\$&)");
  return std::regex(std::regex_replace(escaped, std::regex("…"), "[^]*?"));
}

TEST_F(Commands, PrintWhatThePagesShow) {
  int dialogues = 0;
  for (const Block& block : blocksOf("console")) {
    std::string command, expected;
    const auto check = [&] {
      if (command.empty()) return;
      const std::string printed = run(command);
      EXPECT_TRUE(std::regex_match(printed, pattern(expected))) << command << "\nprints\n"
                                                                << printed << "\ninstead of\n"
                                                                << expected;
      ++dialogues;
    };
    for (const std::string& line : linesOf(block.text)) {
      if (line.starts_with("$ ")) {
        check();
        command = line.substr(2);
        expected.clear();
      } else {
        expected += line + "\n";
      }
    }
    check();
  }
  EXPECT_GE(dialogues, 2);
}

TEST_F(Commands, AreKnownWithTheirOptions) {
  const std::string program_help = run("merge2d --help");
  int commands = 0;
  for (const char* language : {"sh", "console"}) {
    for (const Block& block : blocksOf(language)) {
      const std::string text = std::regex_replace(block.text, std::regex("\\\\\n"), " ");
      for (const std::string& call : matches(text, "merge2d ([a-z]+[^|;\n]*)")) {
        const std::string command = call.substr(0, call.find(' '));
        EXPECT_TRUE(std::regex_search(program_help, std::regex("\n +" + command + " ")))
            << "merge2d " << call;
        const std::string help = run("merge2d " + command + " --help");
        for (const std::string& option : matches(call, R"( (--?[a-z][a-z-]*))")) {
          EXPECT_TRUE(std::regex_search(help, std::regex("[ ,]" + option + "[ ,\n]")))
              << "merge2d " << call << ": " << option;
        }
        ++commands;
      }
    }
  }
  EXPECT_GE(commands, 8);
}

}  // namespace
}  // namespace merge2d::docs
