/// What the pages name must exist: files, tests, settings, commands, options. Deviations from the
/// paper must name what guards them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>

#include "src2d/scene/load.h"
#include "src2d/scene/names.h"
#include "src2d/scene/settings_list.h"
#include "tests/docs/docs_testing.h"

namespace merge2d::docs {
namespace {

TEST(Pages, EveryPathExists) {
  for (const fs::path& page : pages()) {
    for (const std::string& word : codeIn(pageOf(read(page)).prose)) {
      if (!looksLikePath(word)) continue;
      EXPECT_TRUE(fs::exists(kRoot / word)) << nameOf(page) << ": " << word;
    }
  }
}

/// To a file of the project, or to one that ./demo makes.
TEST(Pages, EveryLinkLeadsSomewhere) {
  const std::string demo = read(kRoot / "demo");
  for (const fs::path& page : pages()) {
    for (const std::string& link : matches(pageOf(read(page)).prose, R"(\]\(([^)#]+)[^)]*\))")) {
      if (link.starts_with("http")) continue;
      const bool made = page == kRoot / "README.md" && demo.find("=" + link) != std::string::npos;
      EXPECT_TRUE(made || fs::exists(page.parent_path() / link)) << nameOf(page) << ": " << link;
    }
  }
}

/// The anchor that GitHub gives a heading: small letters, no punctuation, a hyphen for each space.
std::string anchorOf(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ') {
      anchor += '-';
    } else if (std::isalnum(byte) || c == '-' || c == '_' || byte >= 0x80) {
      anchor += static_cast<char>(std::tolower(byte));
    }
  }
  return anchor;
}

TEST(Pages, EveryAnchorOfALinkIsAHeading) {
  int anchors = 0;
  for (const fs::path& page : pages()) {
    for (const std::string& link : matches(pageOf(read(page)).prose, R"(\]\(([^):]*#[^)]+)\))")) {
      const std::string file = link.substr(0, link.find('#'));
      const fs::path target = file.empty() ? page : page.parent_path() / file;
      std::set<std::string> headings;
      for (const std::string& heading : matches(pageOf(read(target)).prose, R"(#+ ([^\n]+)\n)")) {
        headings.insert(anchorOf(heading));
      }
      EXPECT_TRUE(headings.contains(link.substr(link.find('#') + 1)))
          << nameOf(page) << ": " << link;
      ++anchors;
    }
  }
  EXPECT_GE(anchors, 3);
}

TEST(Pages, EveryTestExists) {
  int tests = 0;
  for (const fs::path& page : pages()) {
    for (const std::string& word : codeIn(pageOf(read(page)).prose)) {
      if (!looksLikeTest(word)) continue;
      EXPECT_TRUE(allTests().contains(word)) << nameOf(page) << ": there is no test " << word;
      ++tests;
    }
  }
  EXPECT_GT(tests, 80);
}

/// What `./check` leaves out by name: a test that is called otherwise by now would be run again.
TEST(Check, LeavesOutTestsThatExist) {
  for (const char* list : {"tests/open_targets.txt", "tests/measurements.txt"}) {
    for (const std::string& name : matches(read(kRoot / list), R"(([^\n]+)\n)")) {
      const std::string test = name.substr(0, name.find('/', name.find('.')));  // no parameter
      EXPECT_TRUE(allTests().contains(test.substr(test.find('/') + 1)))
          << list << ": there is no test " << name;
    }
  }
}

TEST(Pages, TellOfOpenTargetsThatAreOpen) {
  const std::string open = read(kRoot / "tests/open_targets.txt");
  for (const fs::path& page : pages()) {
    for (const std::string& test :
         matches(read(page), R"(`([\w./]+)`\s+is\s+an\s+open\s+target)")) {
      EXPECT_THAT(open, testing::HasSubstr(test + "\n")) << nameOf(page);
    }
  }
}

TEST(Scenarios, EachBuiltInSceneHasAPartWithATableAndAPicture) {
  const std::string page = read(kRoot / "docs/scenarios.md");
  for (const BuiltinScene& scene : builtinScenes()) {
    EXPECT_THAT(page, testing::HasSubstr("## " + scene.name + "\n![")) << scene.name;
    EXPECT_THAT(page, testing::HasSubstr("(pictures/" + scene.name + ".png)")) << scene.name;
    EXPECT_THAT(page, testing::HasSubstr("<!-- begin " + scene.name + " -->\n")) << scene.name;
    EXPECT_THAT(page, testing::HasSubstr("<!-- end " + scene.name + " -->\n")) << scene.name;
  }
}

/// "merging.rule", and what it is when nobody says otherwise, as it is written in a scene.
std::map<std::string, std::string> defaultSettings() {
  std::map<std::string, std::string> found;
  const Settings settings;
  forEachSetting(
      settings, [&](std::string_view table, std::string_view key, const auto& value, const Range&) {
        using T = std::remove_cvref_t<decltype(value)>;
        std::ostringstream text;
        if constexpr (HasNames<T>) {
          text << '"' << merge2d::nameOf(value) << '"';
        } else {
          text << std::boolalpha << value;
        }
        found[std::string(table) + "." + std::string(key)] = text.str();
      });
  return found;
}

TEST(Pages, EverySettingExists) {
  const std::regex pattern(
      R"(((solver|merging|unmerging|sleeping|material|drawing)\.(\w+))( = .*)?)");
  const auto settings = defaultSettings();
  for (const fs::path& page : pages()) {
    for (const std::string& word : codeIn(pageOf(read(page)).prose)) {
      std::smatch match;
      if (!std::regex_match(word, match, pattern)) continue;
      EXPECT_TRUE(settings.contains(match[1])) << nameOf(page) << ": " << word;
    }
  }
}

/// The text of each block of comment lines of a file.
std::vector<std::string> comments(const fs::path& file) {
  std::vector<std::string> blocks;
  bool inside = false;
  for (const std::string& line : linesOf(read(file))) {
    const std::size_t first = line.find_first_not_of(' ');
    const bool comment = first != std::string::npos && line.compare(first, 2, "//") == 0;
    if (comment && !inside) blocks.emplace_back();
    if (comment)
      blocks.back() += line.substr(line.find_first_not_of("/ ", first) == std::string::npos
                                       ? line.size()
                                       : line.find_first_not_of("/ ", first)) +
                       " ";
    inside = comment;
  }
  return blocks;
}

TEST(Deviations, EachNamesATestThatExists) {
  int deviations = 0;
  for (const fs::path& file : filesBelow("src2d", {".h", ".cpp"})) {
    for (const std::string& comment : comments(file)) {
      // Those from Box2D's own routines are not from the paper.
      if (!std::regex_search(comment, std::regex(R"(\bDeviations?\b(?!\s+from b2))"))) continue;
      ++deviations;
      bool guarded = false;
      for (const std::string& word : matches(comment, R"(([\w./]+\w))")) {
        if (looksLikeTest(word)) {
          EXPECT_TRUE(allTests().contains(word)) << nameOf(file) << ": there is no test " << word;
          guarded = true;
        } else if (looksLikePath(word) && word.starts_with("tests/")) {
          EXPECT_TRUE(fs::exists(kRoot / word)) << nameOf(file) << ": there is no " << word;
          guarded = true;
        }
      }
      EXPECT_TRUE(guarded) << nameOf(file) << ": no test guards this:\n" << comment;
    }
  }
  EXPECT_GE(deviations, 6);
}

TEST(Reliability, EachPromiseIsHeldByTestsThatExist) {
  int promises = 0;
  for (const auto& row : tableRows(pageOf(read(kRoot / "docs/reliability.md")).prose)) {
    ASSERT_EQ(row.size(), 2u) << row[0];
    const std::vector<std::string> tests = codeIn(row[1]);
    EXPECT_FALSE(tests.empty()) << row[0];
    for (const std::string& test : tests) {
      EXPECT_TRUE(allTests().contains(test)) << row[0] << ": there is no test " << test;
    }
    ++promises;
  }
  EXPECT_GE(promises, 15);
}

TEST(Decisions, EachIsListedAndHasItsFourParts) {
  const std::string list = read(kRoot / "docs/decisions/README.md");
  for (const fs::path& page : filesBelow("docs/decisions", {".md"})) {
    const std::string name = page.filename();
    if (name == "README.md") continue;
    EXPECT_NE(list.find("](" + name + ")"), std::string::npos) << name << " is not listed";
    EXPECT_THAT(matches(read(page), "\n## ([^\n]+)"),
                testing::ElementsAre("Question", "Decision", "Why", "What it costs"))
        << name;
  }
}

TEST(Decisions, TheirScenesLoadWithoutWarnings) {
  for (const fs::path& scene : filesBelow("docs/scenes", {".toml"})) {
    EXPECT_THAT(loadScene(scene.string()).warnings, testing::IsEmpty()) << scene;
  }
}

TEST(Changelog, BeginsWithTheVersionThatIsBuilt) {
  const auto built =
      matches(read(kRoot / "CMakeLists.txt"), R"(project\(merge2d VERSION ([\d.]+))");
  const auto told = matches(read(kRoot / "CHANGELOG.md"), "\n## ([\\d.]+)");
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.front(), built.at(0));
}

// ---- docs/scene-format.md ----

/// All TOML of the page, one after the other, is one scene.
TEST(SceneFormat, TheExamplesMakeOneScene) {
  std::string toml;
  for (const Block& block : pageOf(read(kRoot / "docs/scene-format.md")).blocks) {
    if (block.language == "toml") toml += block.text;
  }
  const Scene scene = parseScene(toml, "scene-format.toml");
  EXPECT_THAT(scene.warnings, testing::IsEmpty());
  EXPECT_FALSE(scene.bodies.empty());
  EXPECT_FALSE(scene.springs.empty());
  EXPECT_FALSE(scene.impulses.empty());
  EXPECT_FALSE(scene.forces.empty());
  EXPECT_FALSE(scene.magnets.empty());
  EXPECT_FALSE(scene.emitters.empty());
}

TEST(SceneFormat, TheTableHasEverySettingWithItsDefault) {
  const auto rows = tableRows(pageOf(read(kRoot / "docs/scene-format.md")).prose);
  std::map<std::string, std::string> told;
  for (const auto& row : rows) {
    const auto code = codeIn(row[0] + " " + row[1]);
    if (code.size() == 2) told[code[0]] = code[1];
  }
  const auto same = [](const std::string& a, const std::string& b) {
    char* end = nullptr;
    const double number = std::strtod(a.c_str(), &end);
    return end != a.c_str() && *end == '\0' ? number == std::strtod(b.c_str(), nullptr) : a == b;
  };
  for (const auto& [key, value] : defaultSettings()) {
    ASSERT_TRUE(told.contains(key)) << key << " is missing";
    EXPECT_TRUE(same(told[key], value)) << key << " is " << value << ", not " << told[key];
  }
}

}  // namespace
}  // namespace merge2d::docs
