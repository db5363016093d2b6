/// Whose files are touched, and what is left in a folder.

#include <grp.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include "tests/faults/fault_testing.h"

namespace merge2d {
namespace {

constexpr mode_t kUmask = 022;

class Files : public FaultTest {
 protected:
  Files() {
    beforeStart([] { umask(kUmask); });
  }

  mode_t modeOf(const std::string& name) const {
    struct stat file {};
    EXPECT_EQ(stat((folder() / name).c_str(), &file), 0) << name;
    return file.st_mode & 0777U;
  }
};

/// Every output of the program, and the command that writes it.
const std::map<std::string, Words>& outputs() {
  static const std::map<std::string, Words> all = {
      {"o.csv", {"run", "stack.toml", "--csv", "o.csv"}},
      {"o.jsonl", {"run", "stack.toml", "--trace", "o.jsonl"}},
      {"o.state", {"run", "stack.toml", "--snapshot", "o.state"}},
      {"o.toml", {"validate", "stack.toml", "--to", "o.toml", "--force"}},
      {"o.html", {"lesson", "stack.toml", "-o", "o.html"}},
      {"modes.csv", {"compare", "stack.toml", "--no-charts", "--csv", "modes.csv"}},
      {"graph.png", {"cycles", "graph.txt", "--render", "graph.png"}},
      {"charts/counts.png", {"compare", "stack.toml", "-o", "charts"}},
      {"f/run.json", renderStack({"-o", "f"})},
      {"f/stack.apng", renderStack({"-o", "f", "--format", "apng"})},
      {"f/contact_sheet.png", renderStack({"-o", "f", "--contact-sheet", "2x2"})},
      {"f/stages/step_000002.vtt",
       {"render", "stack.toml", "-r", "64x48", "-o", "f", "--stages", "--at", "2"}}};
  return all;
}

TEST_F(Files, NobodysFilesOfOldTemporaryNamesAreTouched) {
  write("graph.txt", "A B 2\n");
  for (const auto& [output, command] : outputs()) {
    const fs::path file = folder() / output;
    fs::create_directories(file.parent_path());
    if (!output.starts_with("f/")) {
      write(output + ".part", "mine");
      EXPECT_EQ(run(command).code, kFine) << output;
      EXPECT_EQ(read(output + ".part"), "mine");
      // A link in its place leads nobody to another's file.
      write("precious", "mine");
      fs::remove(file.string() + ".part");
      fs::create_symlink(folder() / "precious", file.string() + ".part");
      EXPECT_EQ(run(command).code, kFine) << output;
      EXPECT_EQ(read("precious"), "mine") << output;
    }
    EXPECT_EQ(run(command).code, kFine) << output;
    for (const std::string& name : files()) EXPECT_EQ(name.find(".merge2d"), std::string::npos);
  }
}

TEST_F(Files, PermissionsOfWhatIsReplacedAreKept) {
  write("graph.txt", "A B 2\n");
  for (const auto& [output, command] : outputs()) {
    EXPECT_EQ(run(command).code, kFine) << output;
    EXPECT_EQ(modeOf(output), 0666U & ~kUmask) << output << " is new";
    for (const mode_t mode : {0640U, 0600U, 0664U}) {
      chmod((folder() / output).c_str(), mode);
      EXPECT_EQ(run(command).code, kFine) << output;
      EXPECT_EQ(modeOf(output), mode) << output;
    }
  }
}

TEST_F(Files, FoldersOfAnOutputAreMadeAndGoAgainWhereItFails) {
  for (const char* option : {"--csv", "--trace", "--snapshot"}) {
    const std::string file = std::string("new/folder/of") + option;
    EXPECT_EQ(run({"run", "stack.toml", option, file}).code, kFine);
    EXPECT_TRUE(exists(file));
  }
  EXPECT_EQ(run({"lesson", "stack.toml", "-o", "new/page/of.html"}).code, kFine);
  EXPECT_EQ(run({"validate", "stack.toml", "--to", "new/scene/of.toml"}).code, kFine);
  clear();
  write("wild.toml", kDiverging);
  EXPECT_EQ(run({"run", "wild.toml", "--snapshot", "new/folder/of.state"}).code, 1);
  EXPECT_THAT(leftOver({"stack.toml", "wild.toml"}), IsEmpty());
}

TEST_F(Files, OneOutputNamedTwiceIsRefusedBeforeAnythingIsWritten) {
  fs::create_directory(folder() / "d");
  fs::create_symlink("o", folder() / "link");
  fs::create_symlink("d", folder() / "e");
  const std::vector<Words> commands = {
      {"run", "stack.toml", "--csv", "o", "--trace", "o"},
      {"run", "stack.toml", "--csv", "o", "--trace", "./o"},
      {"run", "stack.toml", "--csv", "o", "--trace", (folder() / "o").string()},
      {"run", "stack.toml", "--csv", "d/../o", "--snapshot", "o"},
      {"run", "stack.toml", "--snapshot", "link", "--trace", "o"},
      {"run", "stack.toml", "--snapshot", "d/o", "--trace", "e/o"},
      {"run", "stack.toml", "--snapshot", "new/o", "--trace", "new//o"},
      {"run", "stack.toml", "--csv", "-", "--trace", "-"},
      {"run", "stack.toml", "--csv", "-", "--trace", "/dev/stdout"},
      {"compare", "stack.toml", "--csv", "d/time.png", "-o", "d"},
      {"compare", "stack.toml", "--csv", "e/counts.png", "-o", "d", "--force"}};
  for (const Words& command : commands) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, kWrongUsage) << testing::PrintToString(command) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("two different files"));
    EXPECT_THAT(leftOver({"stack.toml", "d", "e", "link"}), IsEmpty());
  }
  EXPECT_EQ(run({"run", "stack.toml", "--csv", "/dev/null", "--trace", "/dev/null"}).code, kFine);
}

TEST_F(Files, AnOutputOptionIsGivenOnce) {
  for (const Words& command :
       std::vector<Words>{{"render", "stack.toml", "-o", "a", "-o", "b"},
                          {"render", "stack.toml", "-o", "a", "--output=a"},
                          {"lesson", "stack.toml", "-o", "a", "-o", "b"},
                          {"run", "stack.toml", "--csv", "a", "--csv", "b"},
                          {"validate", "stack.toml", "--to", "a", "--to", "a"},
                          {"compare", "stack.toml", "-o", "a", "-o", "b"}}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, kWrongUsage) << testing::PrintToString(command) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("name one output"));
    EXPECT_THAT(leftOver(), IsEmpty());
  }
}

/// Runs the program with little room for files, and nothing of it left.
TEST_F(Files, AFullDiskIsSaidAndLeavesNothing) {
  write("graph.txt", "A B 2\n");
  beforeStart([] {
    const rlimit limit{300, 300};  // [bytes]
    setrlimit(RLIMIT_FSIZE, &limit);
  });
  for (const auto& [output, command] : outputs()) {
    // Messages go into files, too, and are short.
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, kFailed) << output << outcome.err << outcome.signal;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("cannot write "), HasSubstr(": File too large")));
    EXPECT_THAT(leftOver({"stack.toml", "graph.txt"}), IsEmpty()) << output;
  }
}

#ifdef MERGE2D_CAN_MOUNT
/// A file system of 64 KB, 12 of them free.
TEST_F(Files, NoSpaceOnTheDeviceIsTheReasonGiven) {
  fs::create_directory(folder() / "disk");
  const auto mountDisk = [this] {
    const bool mounted = unshare(CLONE_NEWNS) == 0 &&
                         mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                         mount("none", (folder() / "disk").c_str(), "tmpfs", 0, "size=64k") == 0;
    if (!mounted) _exit(77);
    const std::string ballast(52 << 10, 'x');
    std::ofstream(folder() / "disk/ballast") << ballast;
  };
  beforeStart(mountDisk);
  const std::vector<Words> commands = {
      {"run", "stack.toml", "--seconds", "20", "--csv", "disk/o.csv"},
      {"run", "stack.toml", "--trace", "disk/o.jsonl"},
      {"run", "pile", "--steps", "1", "--snapshot", "disk/o.state"},
      {"lesson", "stack.toml", "-o", "disk/o.html"},
      {"render", "stack.toml", "-r", "640x480", "-o", "disk/f"},
      {"compare", "stack.toml", "-o", "disk/c"}};
  for (const Words& command : commands) {
    const Outcome outcome = run(command);
    ASSERT_NE(outcome.code, 77) << "nothing can be mounted here";
    EXPECT_EQ(outcome.code, kFailed) << testing::PrintToString(command) << outcome.err;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("cannot write disk/"), HasSubstr(": No space left on device")));
  }
}
#endif

TEST_F(Files, WithoutPermissionTheReasonIsGiven) {
  write("graph.txt", "A B 2\n");
  fs::create_directory(folder() / "theirs");
  ASSERT_EQ(run({"run", "stack.toml", "--csv", "theirs/read-only.csv"}).code, kFine);
  fs::permissions(folder() / "theirs/read-only.csv", fs::perms(0444));
  fs::permissions(folder() / "theirs", fs::perms(0555));
  beforeStart([] {
    constexpr uid_t kNobody = 65534;
    if (geteuid() == 0 && setresuid(kNobody, kNobody, kNobody) != 0) _exit(77);
  });
  const std::vector<Words> commands = {{"run", "stack.toml", "--csv", "theirs/o.csv"},
                                       {"run", "stack.toml", "--csv", "theirs/read-only.csv"},
                                       {"run", "stack.toml", "--trace", "theirs/new/o.jsonl"},
                                       {"run", "stack.toml", "--snapshot", "theirs/o.state"},
                                       {"lesson", "stack.toml", "-o", "theirs/o.html"},
                                       {"validate", "stack.toml", "--to", "theirs/o.toml"},
                                       {"cycles", "graph.txt", "--render", "theirs/graph.png"},
                                       {"compare", "stack.toml", "-o", "theirs"},
                                       {"compare", "stack.toml", "-o", "theirs/charts"},
                                       renderStack({"-o", "theirs", "--force"}),
                                       renderStack({"-o", "theirs/frames"}),
                                       renderStack({"-o", "theirs", "--stages", "--at", "1"})};
  for (const Words& command : commands) {
    const Outcome outcome = run(command);
    ASSERT_NE(outcome.code, 77) << "root cannot become another user here";
    EXPECT_EQ(outcome.code, kFailed) << testing::PrintToString(command) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("cannot write "), HasSubstr(": Permission denied")));
    EXPECT_THAT(files("theirs"), ElementsAre("read-only.csv"));
  }
  fs::permissions(folder() / "theirs", fs::perms(0755));
}

/// No words of a library stand where a user looks for a reason.
TEST_F(Files, FoldersInTheWayAreCalledThat) {
  for (const char* name : {"o.csv", "o.state", "f/run.json", "f/frame_000001.png"}) {
    fs::create_directories(folder() / name);
  }
  const std::vector<std::pair<Words, int>> commands = {
      {{"run", "stack.toml", "--csv", "o.csv"}, kFailed},
      {{"run", "stack.toml", "--resume", "o.state"}, kFailed},
      {{"run", "o.state"}, kBadScene},
      {{"cycles", "o.state"}, kBadScene},
      {renderStack({"-o", "f"}), kWrongUsage},
      {renderStack({"-o", "f", "--force"}), kFailed}};
  for (const auto& [command, code] : commands) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, code) << testing::PrintToString(command) << outcome.err;
    for (const char* word : {"filesystem error", "basic_", "iostream", "std::", "vector"}) {
      EXPECT_THAT(outcome.err, Not(HasSubstr(word)));
    }
  }
}

}  // namespace
}  // namespace merge2d
