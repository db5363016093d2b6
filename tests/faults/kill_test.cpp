/// Kills at any moment, and what goes on afterwards.

#include "tests/faults/fault_testing.h"

namespace merge2d {
namespace {

class Kill : public FaultTest {
 protected:
  /// Starts the program and kills it after so many milliseconds. Whether it had ended before.
  bool killed(const Words& arguments, int milliseconds) {
    const pid_t child = start(arguments);
    usleep(static_cast<useconds_t>(1000 * milliseconds));
    kill(child, SIGKILL);
    return wait(child).signal == SIGKILL;
  }
};

const Words kFilm = renderStack({"--seconds", "4", "--quiet", "-o"});

Words filmTo(const std::string& folder, const Words& more = {}) {
  Words arguments = kFilm;
  arguments.push_back(folder);
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(Kill, ARenderingKilledAtAnyMomentContinuesToTheSameBytes) {
  ASSERT_EQ(run(filmTo("whole")).code, kFine);
  const auto whole = contents("whole");
  for (int trial = 0; trial < 24; ++trial) {
    killed(filmTo("film", {"--resume"}), 10 + 17 * trial);
    for (const auto& [name, bytes] : contents("film")) {
      EXPECT_TRUE(!name.ends_with(".png") || bytes == whole.at(name)) << name << " is whole";
    }
    if (trial % 3 != 2) continue;
    const Outcome outcome = run(filmTo("film", {"--resume"}));
    EXPECT_EQ(outcome.code, kFine) << outcome.err;
    EXPECT_TRUE(contents("film") == whole) << "trial " << trial;
    if (trial % 2 == 0) fs::remove_all(folder() / "film");
  }
}

TEST_F(Kill, AFileOfAKilledRunIsWholeOrMissing) {
  const Words arguments = {"run",     "stack.toml", "--csv",   "o.csv",   "--trace",
                           "o.jsonl", "--snapshot", "o.state", "--quiet", "--no-timings"};
  ASSERT_EQ(run(arguments).code, kFine);
  const auto whole = contents(".");
  for (int trial = 0; trial < 30; ++trial) {
    for (const char* name : {"o.csv", "o.jsonl", "o.state"}) fs::remove(folder() / name);
    killed(arguments, trial);
    for (const auto& [name, bytes] : contents(".")) {
      ASSERT_TRUE(whole.contains(name)) << name;
      EXPECT_TRUE(bytes == whole.at(name)) << name;
    }
  }
}

TEST_F(Kill, WhatARenderingLeftBeforeItsFirstRunFileIsNobodysFile) {
  fs::create_directories(folder() / "frames/stack");
  write("frames/stack/.merge2d.lock", "4711");
  write("frames/stack/.merge2d-abcdefghijkl.json", "{");
  for (const Words& more : {Words{"--resume"}, Words{}}) {
    const Outcome outcome = run(renderStack(more));
    EXPECT_EQ(outcome.code, kFine) << outcome.err;
    EXPECT_THAT(files("frames/stack"), Not(Contains(HasSubstr(".merge2d"))));
    EXPECT_EQ(Json::parse(read("frames/stack/run.json"))["complete"], true);
  }
}

TEST_F(Kill, DamagedAndForeignFramesAreDrawnAgain) {
  ASSERT_EQ(run(filmTo("film")).code, kFine);
  const auto whole = contents("film");
  const std::string frame = "film/frame_000007.png";
  std::string turned = whole.at("frame_000007.png");
  turned[turned.size() / 2] ^= 1;
  ASSERT_EQ(run(filmTo("dark", {"--theme", "dark"})).code, kFine);
  for (const std::string& bytes :
       {turned, std::string(), whole.at("frame_000008.png"), read("dark/frame_000007.png")}) {
    write(frame, bytes);
    EXPECT_EQ(run(filmTo("film", {"--resume"})).code, kFine);
    EXPECT_TRUE(contents("film") == whole);
  }
  fs::remove(folder() / frame);
  fs::create_symlink(folder() / "dark/frame_000007.png", folder() / frame);
  EXPECT_EQ(run(filmTo("film", {"--resume"})).code, kFine);
  EXPECT_TRUE(contents("film") == whole) << "a link to another frame";
  EXPECT_FALSE(fs::is_symlink(folder() / frame));
}

TEST_F(Kill, ADamagedRunFileVouchesForNothing) {
  ASSERT_EQ(run(filmTo("film")).code, kFine);
  const auto whole = contents("film");
  Json told = Json::parse(read("film/run.json"));
  told["digests"]["frame_000003.png"] = 7;
  told["digests"]["elsewhere.png"] = "0";
  told["complete"] = false;
  write("film/run.json", told.dump());
  fs::remove(folder() / "film/frame_000004.png");
  EXPECT_EQ(run(filmTo("film", {"--resume"})).code, kFine);
  EXPECT_TRUE(contents("film") == whole);
  told["digests"] = "none";
  write("film/run.json", told.dump());
  EXPECT_EQ(run(filmTo("film", {"--resume"})).code, kFine);
  EXPECT_TRUE(contents("film") == whole);
}

}  // namespace
}  // namespace merge2d
