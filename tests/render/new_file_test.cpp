#include "render/new_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "src2d/core/error.h"
#include "tests/support/temporary_folder.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

std::span<const std::uint8_t> bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// With a temporary name and without one.
class NewFiles : public testing::TestWithParam<bool> {
 protected:
  NewFileOptions options() const { return {.has_name = GetParam()}; }
  const TemporaryFolder folder;
  const fs::path target = folder.path() / "target.txt";
};

INSTANTIATE_TEST_SUITE_P(Both, NewFiles, testing::Bool());

TEST_P(NewFiles, AppearAtTheEnd) {
  NewFile file(target, options());
  file.write(bytes("half "));
  EXPECT_FALSE(fs::exists(target));
  file.write(bytes("whole"));
  file.finish();
  EXPECT_EQ(contentOf(target), "half whole");
  EXPECT_EQ(folder.count(), 1U);
}

TEST_P(NewFiles, ReplaceWhatIsThereAtOnce) {
  std::ofstream(target) << "old";
  NewFile file(target, options());
  file.write(bytes("new"));
  EXPECT_EQ(contentOf(target), "old");
  file.finish();
  EXPECT_EQ(contentOf(target), "new");
  EXPECT_EQ(folder.count(), 1U);
}

TEST_P(NewFiles, LeaveNothingWhenTheyAreGivenUp) {
  std::ofstream(target) << "old";
  {
    NewFile file(target, options());
    file.write(bytes("new"));
  }
  EXPECT_EQ(contentOf(target), "old");
  EXPECT_EQ(folder.count(), 1U);
}

TEST_P(NewFiles, KeepThePermissionsOfWhatTheyReplace) {
  std::ofstream(target) << "old";
  fs::permissions(target, fs::perms(0640));
  NewFile file(target, options());
  file.finish();
  EXPECT_EQ(fs::status(target).permissions(), fs::perms(0640));
}

TEST_P(NewFiles, ReplaceALinkAndNotWhereItLeads) {
  std::ofstream(folder.path() / "precious") << "mine";
  fs::create_symlink("precious", target);
  NewFile file(target, options());
  file.write(bytes("new"));
  file.finish();
  EXPECT_EQ(contentOf(folder.path() / "precious"), "mine");
  EXPECT_EQ(contentOf(target), "new");
}

TEST_P(NewFiles, CanBeCorrectedBeforeTheyAppear) {
  NewFile file(target, options());
  file.write(bytes("0 frames"));
  EXPECT_EQ(file.size(), 8U);
  file.writeAt(0, bytes("7"));
  file.write(bytes(" in all"));
  file.finish();
  EXPECT_EQ(contentOf(target), "7 frames in all");
}

TEST_P(NewFiles, FailWithTheReason) {
  try {
    NewFile(folder.path() / "no" / "folder", options());
    FAIL();
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("/no/folder: No such file or directory"),
              std::string::npos)
        << error.what();
  }
  fs::create_directory(target);
  NewFile file(target, options());
  EXPECT_THROW(file.finish(), IoError) << "a folder is in the way";
}

TEST(TemporaryNames, AreRemovedByHandlersOfSignals) {
  const TemporaryFolder folder;
  NewFile file(folder.path() / "film.mp4", {.has_name = true});
  EXPECT_TRUE(isTemporaryName(file.temporary().filename().string())) << file.temporary();
  EXPECT_EQ(file.temporary().extension(), ".mp4");
  EXPECT_TRUE(fs::exists(file.temporary()));
  removeTemporaryFiles();
  EXPECT_FALSE(fs::exists(file.temporary()));
}

TEST(TemporaryNames, AreNotTakenForOthers) {
  EXPECT_TRUE(isTemporaryName(".merge2d-abcdefgh0123"));
  for (const char* other : {".merge2d-abcdefgh012", ".merge2d-abcdefgh01234", ".merge2d.lock",
                            "merge2d-abcdefgh0123", ".merge2d-ABCDEFGH0123", "o.csv.part"}) {
    EXPECT_FALSE(isTemporaryName(other)) << other;
  }
}

TEST(TemporaryNames, MayBeMoreThanHandlersKnow) {
  const TemporaryFolder folder;
  {
    std::vector<std::unique_ptr<NewFile>> files;
    for (int i = 0; i < 100; ++i) {
      files.push_back(std::make_unique<NewFile>(folder.path() / std::to_string(i),
                                                NewFileOptions{.has_name = true}));
    }
    EXPECT_EQ(folder.count(), 100U);
  }
  EXPECT_EQ(folder.count(), 0U);
}

}  // namespace
}  // namespace merge2d
