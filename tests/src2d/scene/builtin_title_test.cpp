#include "src2d/scene/builtin_title.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "src2d/scene/builtin.h"
#include "src2d/scene/toml_parse.h"
#include "tests/support/temporary_folder.h"

namespace merge2d {
namespace {

TEST(BuiltinTitle, IsTheOneThatParsingGives) {
  EXPECT_FALSE(embeddedScenes().empty());
  for (const EmbeddedFile& scene : embeddedScenes()) {
    const toml::table table = parseToml(SourceText(std::string(scene.path), scene.text));
    EXPECT_EQ(table["title"].value<std::string>(), std::string(scene.title)) << scene.path;
  }
}

/// The title beside this text differs from the one in it, so that it shows which of them was used.
constexpr EmbeddedFile kKnown[] = {{"a.toml", "title = \"parsed\"\n", "from the build"},
                                   {"b.toml", "title = \"parsed\" # b\n"},
                                   {"c.toml", "box = 1\n"}};

TEST(BuiltinTitle, OfAnEmbeddedFileComesFromTheBuild) {
  const DataFolder folder("built-in/things", kKnown);
  EXPECT_EQ(titleOf(folder, "a.toml", kKnown), "from the build");
  EXPECT_EQ(titleOf(folder, "b.toml", kKnown), "parsed");
  EXPECT_EQ(titleOf(folder, "c.toml", kKnown), std::nullopt);
}

TEST(BuiltinTitle, OfAFileOnDiskComesFromTheBuildWhileTheirTextsAreEqual) {
  const TemporaryFolder disk;
  const auto titleOfText = [&](const char* text) {
    std::ofstream(disk.path() / "a.toml") << text;
    return titleOf(disk.path(), "a.toml", kKnown);
  };
  EXPECT_EQ(titleOfText("title = \"parsed\"\n"), "from the build");
  EXPECT_EQ(titleOfText("title = \"changed\"\n"), "changed");
  EXPECT_EQ(titleOfText("title = \"tab \\t\"\n"), "tab \t");
  EXPECT_EQ(titleOfText("title = 1\n"), std::nullopt);
  EXPECT_THROW(titleOfText("title = \n"), std::runtime_error);
}

}  // namespace
}  // namespace merge2d
