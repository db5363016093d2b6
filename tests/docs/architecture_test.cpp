/// Keeps docs/architecture.md and docs/glossary.md true: their arrows between rooms are those that
/// the sources keep to, and the functions and types that they name are where they say.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/docs/docs_testing.h"

namespace merge2d::docs {
namespace {

const std::vector<std::string> kPages = {"docs/architecture.md", "docs/glossary.md"};
const std::set<std::string> kSources = {".h", ".cpp"};

// ---- rooms ----

/// The room of a path such as "src2d/core/vec.h": "src2d/core"; "src2d" for the world itself.
std::string roomOf(const std::string& path) {
  const std::size_t first = path.find('/'), second = path.find('/', first + 1);
  const bool inside = path.starts_with("src2d/") && second != std::string::npos;
  return path.substr(0, inside ? second : first);
}

/// The rooms of the page, and those that each may include.
std::map<std::string, std::set<std::string>> arrowsOfThePage() {
  std::map<std::string, std::set<std::string>> arrows;
  for (const auto& row : tableRows(pageOf(read(kRoot / "docs/architecture.md")).prose)) {
    const std::vector<std::string> room = codeIn(row[0]);
    if (room.size() != 1) continue;
    std::set<std::string>& may = arrows[room[0]];
    may.insert(room[0]);
    for (const std::string& name : codeIn(row[2])) {
      const bool inside = fs::exists(kRoot / "src2d" / name);
      may.insert(name == "world" ? "src2d" : inside ? "src2d/" + name : name);
    }
  }
  return arrows;
}

/// "path: include" for each include of a file without an arrow.
std::vector<std::string> withoutArrow(const std::string& path, const std::string& text,
                                      const std::map<std::string, std::set<std::string>>& arrows) {
  std::vector<std::string> found;
  for (const std::string& other :
       matches(text, R"re((?:^|\n)#include "((?:src2d|render|lessons|api|app)/[^"]+)")re")) {
    if (!arrows.at(roomOf(path)).contains(roomOf(other))) found.push_back(path + ": " + other);
  }
  return found;
}

TEST(Architecture, EveryIncludeFollowsAnArrowOfThePage) {
  const auto arrows = arrowsOfThePage();
  ASSERT_GE(arrows.size(), 15u);
  for (const std::string folder :
       {"src2d", "render", "lessons", "api", "include", "python", "app"}) {
    for (const fs::path& file : filesBelow(folder, kSources)) {
      ASSERT_TRUE(arrows.contains(roomOf(nameOf(file)))) << nameOf(file) << " is in no room";
      EXPECT_THAT(withoutArrow(nameOf(file), read(file), arrows), testing::IsEmpty());
    }
  }
}

TEST(Architecture, AnIncludeWithoutAnArrowIsNamed) {
  const auto arrows = arrowsOfThePage();
  EXPECT_THAT(withoutArrow("src2d/geometry/box.h", "#include \"src2d/world.h\"\n", arrows),
              testing::ElementsAre("src2d/geometry/box.h: src2d/world.h"));
  EXPECT_THAT(withoutArrow("src2d/dynamics/x.cpp",
                           "#include <vector>\n#include \"src2d/merging/merge.h\"\n", arrows),
              testing::SizeIs(1));
}

// ---- names ----

/// Names and the file in which a page says that they are: "`a`, `b` in [file](path)".
struct NamedPlace {
  std::vector<std::string> names;
  fs::path file;
};

std::vector<NamedPlace> placesOf(const std::string& page) {
  const std::regex pattern(R"(((?:`[^`\n]+`(?:, )?)+)\s+in\s+\[[^\]]+\]\(([^)#]+)\))");
  const std::string prose = read(kRoot / page);
  std::vector<NamedPlace> places;
  for (std::sregex_iterator at(prose.begin(), prose.end(), pattern), end; at != end; ++at) {
    places.push_back({codeIn((*at)[1]), (kRoot / page).parent_path() / (*at)[2].str()});
  }
  return places;
}

std::string lastPart(const std::string& name) { return name.substr(name.rfind(':') + 1); }

TEST(Architecture, EveryNameOccursInItsFile) {
  for (const std::string& page : kPages) {
    const std::vector<NamedPlace> places = placesOf(page);
    EXPECT_GT(places.size(), 40u) << page;
    for (const NamedPlace& place : places) {
      ASSERT_TRUE(fs::is_regular_file(place.file)) << page << ": " << place.file;
      const std::string text = read(place.file);
      for (const std::string& name : place.names) {
        EXPECT_TRUE(hasWord(text, lastPart(name)))
            << page << ": no " << name << " in " << nameOf(place.file.lexically_normal());
      }
    }
  }
}

// ---- glossary ----

std::vector<std::vector<std::string>> terms() {
  return tableRows(pageOf(read(kRoot / "docs/glossary.md")).prose);
}

TEST(Glossary, EachTermHasOneSentenceAndAPlace) {
  ASSERT_GT(terms().size(), 80u);
  EXPECT_EQ(placesOf("docs/glossary.md").size(), terms().size());
  for (const auto& row : terms()) {
    ASSERT_EQ(row.size(), 3u) << row[0];
    const std::string text = std::regex_replace(row[1], std::regex(R"(Eqs?\. )"), "");
    EXPECT_TRUE(text.ends_with(".")) << row[0];
    EXPECT_EQ(text.find(". "), std::string::npos) << row[0] << " has more than one sentence";
  }
}

TEST(Glossary, IsInTheOrderOfTheAlphabet) {
  std::vector<std::string> names;
  for (const auto& row : terms()) {
    names.push_back(row[0]);
    for (char& c : names.back()) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  EXPECT_TRUE(std::ranges::is_sorted(names));
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

}  // namespace
}  // namespace merge2d::docs
