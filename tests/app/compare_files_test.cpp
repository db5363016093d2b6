/// What a comparison writes, and what it leaves alone.

#include <gmock/gmock.h>

#include "tests/app/program_testing.h"

namespace merge2d {
namespace {

class CompareFiles : public ProgramTest {
 protected:
  CompareFiles() { write("stack.toml", kStack); }
};

TEST_F(CompareFiles, RefusesToOverwriteWhatIsNotOurs) {
  const Words command = {"compare", "stack.toml", "-o", "charts", "--csv", "all.csv"};
  fs::create_directory(folder() / "charts");
  const std::string photo = "\x89PNG\r\n\x1a\n and somebody's holidays";
  for (const std::string& foreign : {std::string("notes of mine"), photo}) {
    write("charts/counts.png", foreign);
    const Outcome refused = run(command);
    EXPECT_EQ(refused.code, 2) << refused.err;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("charts/counts.png is there already"),
                                   HasSubstr("say --force to replace it")));
    EXPECT_THAT(refused.out, IsEmpty());
    EXPECT_EQ(read("charts/counts.png"), foreign);
    EXPECT_THAT(files(), ElementsAre("charts", "charts/counts.png", "stack.toml"))
        << "nothing half written";
  }
  Words forced = command;
  forced.push_back("--force");
  EXPECT_EQ(run(forced).code, 0);
  EXPECT_EQ(run(command).code, 0) << "those of ours are drawn again";
}

/// The simulation would fail with another message.
TEST_F(CompareFiles, RefusesItsFilesBeforeItSimulates) {
  write("flea.toml", kDiverging);
  write("charts", "a file");
  for (const char* folder : {"/proc/x", "/proc", "charts", "charts/of/mine"}) {
    const Outcome refused = run({"compare", "flea.toml", "-o", folder});
    EXPECT_EQ(refused.code, 4) << folder;
    EXPECT_THAT(refused.err, StartsWith("error: cannot write ")) << folder;
  }
}

TEST_F(CompareFiles, LeavesNoFolderWithoutCharts) {
  write("flea.toml", kDiverging);
  EXPECT_EQ(run({"compare", "flea.toml", "-o", "some/charts"}).code, 1);
  EXPECT_THAT(files(), ElementsAre("flea.toml", "stack.toml"));
}

}  // namespace
}  // namespace merge2d
