/// Two processes that write to one place.

#include <iomanip>

#include "src2d/core/digest.h"
#include "tests/faults/fault_testing.h"

namespace merge2d {
namespace {

class Rivals : public FaultTest {
 protected:
  /// Every frame in the folder is the one that its run.json tells of.
  void expectOneFilm(const std::string& name) const {
    const Json told = Json::parse(read(name + "/run.json"));
    std::size_t frames = 0;
    for (const auto& [file, bytes] : contents(name)) {
      if (!file.ends_with(".png")) continue;
      ++frames;
      std::ostringstream digest;
      digest << std::hex << std::setw(16) << std::setfill('0') << digestOf(bytes);
      EXPECT_EQ(told["digests"].value(file, ""), digest.str()) << file;
    }
    EXPECT_TRUE(told["complete"] == false || told["frames"]["last"] == frames - 1);
  }
};

TEST_F(Rivals, TheSecondInAFolderIsToldWhoIsThere) {
  makePipe("pipe");
  write("scene.toml", kStack);
  const std::string expected = "error: another merge2d (process ";
  const std::vector<Words> commands = {
      {"render", "pile", "-r", "64x48", "--seconds", "10000", "-o", "d"},
      {"compare", "pile", "--seconds", "10000", "-o", "d"},
  };
  for (const Words& first : commands) {
    const pid_t child = start(first);
    ASSERT_TRUE(
        waitUntil([&] { return exists("d/.merge2d.lock") && !read("d/.merge2d.lock").empty(); }));
    const auto before = contents("d");
    for (const Words& second :
         {renderStack({"-o", "d"}), renderStack({"-o", "d", "--force"}),
          renderStack({"-o", "d", "--resume"}), renderStack({"-o", "./d/", "--force", "-s"}),
          Words{"compare", "stack.toml", "-o", "d", "--force"}}) {
      Outcome outcome;
      outcome.err = "";
      const pid_t rival = start(second);
      outcome = wait(rival);
      EXPECT_EQ(outcome.code, kFailed) << testing::PrintToString(second);
      EXPECT_THAT(outcome.err, HasSubstr(expected + std::to_string(child) + ") writes to "));
    }
    for (const auto& [name, bytes] : before) {
      EXPECT_TRUE(name == "run.json" || read("d/" + name) == bytes) << name;
    }
    kill(child, SIGTERM);
    wait(child);
    EXPECT_FALSE(exists("d/.merge2d.lock"));
    fs::remove_all(folder() / "d");
  }
}

TEST_F(Rivals, TheLockOfAKilledProcessHoldsNobodyUp) {
  const pid_t child = start({"render", "pile", "-r", "64x48", "--seconds", "10000", "-o", "d"});
  ASSERT_TRUE(waitUntil([&] { return exists("d/frame_000001.png"); }));
  kill(child, SIGKILL);
  wait(child);
  EXPECT_EQ(run(renderStack({"-o", "d"})).code, kFine);
  EXPECT_FALSE(exists("d/.merge2d.lock"));
  expectOneFilm("d");
}

TEST_F(Rivals, TwoAtOnceNeverMixTheirFrames) {
  write("other.toml", std::string(kStack) + "[[body]]\ncircle = 1\nat = [3, 4]\n");
  for (int round = 0; round < 6; ++round) {
    const pid_t first = start(renderStack({"-o", "d"}));
    const pid_t second = start({"render", "other.toml", "-r", "64x48", "--fps", "10", "-o", "d"});
    const int one = wait(first).code, two = wait(second).code;
    EXPECT_TRUE(one == kFine || two == kFine) << one << two;
    for (const int code : {one, two}) EXPECT_TRUE(code == kFine || code == kFailed) << code;
    EXPECT_EQ(Json::parse(read("d/run.json"))["complete"], true);
    expectOneFilm("d");
  }
}

TEST_F(Rivals, AFileOfTwoIsTheWholeFileOfOne) {
  const auto command = [](const std::string& steps) {
    return Words{"run",   "stack.toml", "--steps", steps,     "--csv",
                 "o.csv", "--trace",    "o.jsonl", "--quiet", "--no-timings"};
  };
  std::vector<std::map<std::string, std::string>> whole;
  for (const char* steps : {"100", "130"}) {
    ASSERT_EQ(run(command(steps)).code, kFine);
    whole.push_back(contents("."));
    clear();
  }
  for (int round = 0; round < 10; ++round) {
    const pid_t first = start(command("100")), second = start(command("130"));
    EXPECT_EQ(wait(first).code, kFine);
    EXPECT_EQ(wait(second).code, kFine);
    for (const auto& [name, bytes] : contents(".")) {
      EXPECT_TRUE(bytes == whole[0].at(name) || bytes == whole[1].at(name)) << name;
    }
  }
}

}  // namespace
}  // namespace merge2d
