/// Who may include what. The folders form layers, and each foreign library has its one place; this
/// test reads the sources and names every line that steps over a border.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A line below `folders` must not match `pattern`, except below `exceptions`.
struct Rule {
  std::string name;
  std::vector<std::string> folders;
  std::string pattern;
  std::vector<std::string> exceptions;
};

const std::vector<std::string> kEverywhere = {"src2d/", "render/", "lessons/",
                                              "app/",   "bench/",  "tests/"};

std::string including(const std::string& what) { return R"(^\s*#\s*include\s*["<])" + what; }

std::vector<Rule> rules() {
  return {
      // Layers: src2d < render < lessons < app; nothing depends on bench or tests.
      {"src2d stands alone",
       {"src2d/"},
       including("(\\.\\./)*(render|lessons|app|bench|tests)/"),
       {}},
      {"render uses src2d", {"render/"}, including("(\\.\\./)*(lessons|app|bench|tests)/"), {}},
      {"lessons use render", {"lessons/"}, including("(\\.\\./)*(app|bench|tests)/"), {}},
      {"app uses no tests", {"app/"}, including("(\\.\\./)*(bench|tests)/"), {}},

      // Box2D serves for geometry and collision; its dynamics are only a peer to measure against.
      {"Box2D is geometry",
       kEverywhere,
       including("box2d/"),
       {"src2d/geometry/", "tests/src2d/geometry/", "bench/"}},
      {"Box2D's dynamics are a peer",
       kEverywhere,
       R"(\bb2(World|Body|Fixture|Contact|Joint)\b)",
       {"bench/"}},

      // One place for each file format and for the graphics library.
      {"toml++ reads scenes", kEverywhere, including("toml\\+\\+/"), {"src2d/scene/"}},
      {"JSON is for output",
       kEverywhere,
       including("nlohmann/"),
       {"src2d/trace/", "lessons/", "app/", "bench/", "tests/"}},
      {"OpenGL is behind the canvas", kEverywhere, including("GL/"), {"render/"}},
      {"the command line is the app's", kEverywhere, including("CLI/"), {"app/", "bench/"}},
  };
}

bool below(const std::string& path, const std::vector<std::string>& folders) {
  return std::any_of(folders.begin(), folders.end(),
                     [&](const std::string& folder) { return path.starts_with(folder); });
}

/// "path:line: the rule: the text" for every offending line of a file.
std::vector<std::string> violations(const std::string& path, std::istream& text) {
  std::vector<std::pair<std::string, std::regex>> applicable;
  for (const Rule& rule : rules()) {
    if (below(path, rule.folders) && !below(path, rule.exceptions)) {
      applicable.emplace_back(rule.name, std::regex(rule.pattern));
    }
  }
  std::vector<std::string> found;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    for (const auto& [name, pattern] : applicable) {
      if (std::regex_search(line, pattern)) {
        found.push_back(path + ":" + std::to_string(number) + ": " + name + ": " + line);
      }
    }
  }
  return found;
}

std::vector<std::string> violationsIn(const std::string& path, const std::string& text) {
  std::istringstream stream(text);
  return violations(path, stream);
}

TEST(Layers, EverySourceKeepsToItsLayer) {
  const fs::path root = MERGE2D_SOURCE_DIR;
  std::vector<std::string> found;
  int files = 0;
  for (const std::string& folder : kEverywhere) {
    if (!fs::exists(root / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream text(entry.path());
      const auto more = violations(fs::relative(entry.path(), root).generic_string(), text);
      found.insert(found.end(), more.begin(), more.end());
      ++files;
    }
  }
  EXPECT_GT(files, 10) << "the sources were not found below " << root;
  EXPECT_THAT(found, IsEmpty());
}

TEST(Layers, AnOffendingLineIsNamed) {
  EXPECT_THAT(violationsIn("src2d/world.h", "#pragma once\n#include \"render/canvas.h\"\n"),
              ElementsAre("src2d/world.h:2: src2d stands alone: #include \"render/canvas.h\""));
  EXPECT_THAT(violationsIn("render/page.cpp", "  # include \"../lessons/page.h\"\n").size(), 1);
  EXPECT_THAT(violationsIn("src2d/contact/tree.h", "#include <box2d/b2_dynamic_tree.h>\n").size(),
              1);
  EXPECT_THAT(violationsIn("src2d/geometry/x.h",
                           "void f(b2"
                           "Body*);\n")
                  .size(),
              1);
  EXPECT_THAT(violationsIn("app/main.cpp", "#include <toml++/toml.h>\n").size(), 1);
}

TEST(Layers, WhatIsAllowedIsNotNamed) {
  EXPECT_THAT(
      violationsIn("render/canvas.cpp", "#include <GL/osmesa.h>\n#include \"src2d/world.h\"\n"),
      IsEmpty());
  EXPECT_THAT(violationsIn("src2d/geometry/shape.h", "#include <box2d/b2_polygon_shape.h>\n"),
              IsEmpty());
  EXPECT_THAT(violationsIn("bench/peers/box2d_peer.cpp",
                           "b2"
                           "World world_;\n"),
              IsEmpty());
}

}  // namespace
