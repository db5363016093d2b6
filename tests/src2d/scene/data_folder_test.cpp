#include "src2d/scene/data_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>

#include "src2d/core/error.h"
#include "src2d/scene/builtin.h"
#include "src2d/scene/load.h"
#include "tests/support/build_dir.h"
#include "tests/support/temporary_folder.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr EmbeddedFile kFiles[] = {{"b.toml", "of b"}, {"one/text.md", "# One"}, {"a.toml", ""}};

TEST(DataFolder, ListsEmbeddedFilesAndFoldersByName) {
  const DataFolder top("built-in/things", kFiles);
  EXPECT_THAT(top.entries(), ElementsAre("a.toml", "b.toml", "one"));
  EXPECT_THAT(top.folder("one").entries(), ElementsAre("text.md"));
  EXPECT_THAT(top.folder("two").entries(), IsEmpty());
}

TEST(DataFolder, ReadsEmbeddedFiles) {
  const DataFolder top("built-in/things", kFiles);
  EXPECT_EQ(top.read("b.toml"), "of b");
  EXPECT_EQ(top.folder("one").read("text.md"), "# One");
  EXPECT_TRUE(top.holds("a.toml"));
  EXPECT_FALSE(top.holds("one"));
  EXPECT_FALSE(top.folder("on").holds("e/text.md"));
  EXPECT_THROW(top.read("c.toml"), IoError);
  EXPECT_EQ(top.folder("one").pathOf("text.md"), "built-in/things/one/text.md");
}

TEST(DataFolder, ReadsAFolderOnDiskInTheSameWay) {
  const TemporaryFolder disk;
  fs::create_directory(disk.path() / "one");
  std::ofstream(disk.path() / "one" / "text.md") << "# One";
  std::ofstream(disk.path() / "b.toml") << "of b";
  const DataFolder top(disk.path());
  EXPECT_THAT(top.entries(), ElementsAre("b.toml", "one"));
  EXPECT_EQ(top.folder("one").read("text.md"), "# One");
  EXPECT_FALSE(top.holds("one"));
  EXPECT_THROW(top.read("c.toml"), IoError);
  EXPECT_THAT(DataFolder(disk.path() / "missing").entries(), IsEmpty());
}

using Variables = std::map<std::string, std::string>;

/// Sets variables of the environment until the end of a test.
class Environment {
 public:
  explicit Environment(const Variables& variables) {
    for (const auto& [name, value] : variables) {
      const char* old = std::getenv(name.c_str());
      before_[name] = old != nullptr ? std::optional<std::string>(old) : std::nullopt;
      setenv(name.c_str(), value.c_str(), 1);
    }
  }
  ~Environment() {
    for (const auto& [name, value] : before_) {
      value ? setenv(name.c_str(), value->c_str(), 1) : unsetenv(name.c_str());
    }
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  std::map<std::string, std::optional<std::string>> before_;
};

std::vector<fs::path> pathsOf(const std::vector<DataFolder>& folders) {
  std::vector<fs::path> paths;
  for (const DataFolder& folder : folders) paths.push_back(folder.path());
  return paths;
}

TEST(DataFolders, AreBesideTheProgramThenOfXdgThenBuiltIn) {
  const Environment set(Variables{
      {"HOME", "/home/x"}, {"XDG_DATA_HOME", ""}, {"XDG_DATA_DIRS", "/opt/share:relative::/s"}});
  EXPECT_THAT(
      pathsOf(dataFolders("scenes", "NO_SUCH_VARIABLE", kFiles)),
      ElementsAre(buildDir() / "share/merge2d/scenes", "/home/x/.local/share/merge2d/scenes",
                  "/opt/share/merge2d/scenes", "/s/merge2d/scenes", "built-in/scenes"));
}

TEST(DataFolders, AreThoseOfTheSystemWhereNoneAreSet) {
  const Environment set(Variables{{"HOME", ""}, {"XDG_DATA_HOME", "/data"}, {"XDG_DATA_DIRS", ""}});
  EXPECT_THAT(pathsOf(dataFolders("scenes", "NO_SUCH_VARIABLE", kFiles)),
              ElementsAre(buildDir() / "share/merge2d/scenes", "/data/merge2d/scenes",
                          "/usr/local/share/merge2d/scenes", "/usr/share/merge2d/scenes",
                          "built-in/scenes"));
}

TEST(DataFolders, AreOnlyTheOneThatTheEnvironmentNames) {
  const Environment set(Variables{{"SOME_VARIABLE", "/mine"}});
  EXPECT_THAT(pathsOf(dataFolders("scenes", "SOME_VARIABLE", kFiles)), ElementsAre("/mine"));
}

TEST(DataFolders, OfAUserAddToAndReplaceTheBuiltInScenes) {
  const TemporaryFolder disk;
  const fs::path scenes = disk.path() / "merge2d" / "scenes";
  fs::create_directories(scenes);
  std::ofstream(scenes / "of-the-user.toml") << "title = \"Mine\"\n";
  std::ofstream(scenes / "books.toml") << "title = \"Other books\"\n";
  const Environment set(Variables{{"XDG_DATA_HOME", disk.path().string()}});
  EXPECT_EQ(loadScene("of-the-user").title, "Mine");
  EXPECT_EQ(loadScene("books").title, "Other books");
  EXPECT_FALSE(loadScene("pile").bodies.empty());
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtinScenes()) names.push_back(scene.name);
  EXPECT_THAT(names, Contains("of-the-user"));
  EXPECT_THAT(names, Contains("books").Times(1));
}

TEST(DataFolders, AreNotNeededForTheBuiltInScenes) {
  const Environment set(Variables{{"XDG_DATA_HOME", "/nowhere"}, {"XDG_DATA_DIRS", "/nowhere"}});
  const auto books = builtinScene("books");
  ASSERT_TRUE(books);
  EXPECT_TRUE(books->folder.isEmbedded());
  EXPECT_FALSE(loadScene("books").bodies.empty());
}

}  // namespace
}  // namespace merge2d
