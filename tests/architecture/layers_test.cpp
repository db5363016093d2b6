/// Who may include what. The folders form layers, and each foreign library has its one place; this
/// test reads the sources and names every line that steps over a border.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Sources below `folders` include nothing that begins with one of `forbidden`, except below
/// `exceptions`.
struct Rule {
  std::string name;
  std::vector<std::string> folders;
  std::vector<std::string> forbidden;
  std::vector<std::string> exceptions;
};

const std::vector<std::string> kEverywhere = {"src2d/",  "render/",  "lessons/", "api/",
                                              "app/",    "bench/",   "tests/",   "include/",
                                              "python/", "examples/"};

const std::vector<Rule> kRules = {
    // Layers: src2d < render < lessons < app; nothing depends on bench or tests.
    {"src2d stands alone", {"src2d/"}, {"render/", "lessons/", "app/", "bench/", "tests/"}, {}},
    {"render uses src2d", {"render/"}, {"lessons/", "app/", "bench/", "tests/"}, {}},
    {"lessons use render", {"lessons/"}, {"app/", "bench/", "tests/"}, {}},
    {"app uses no tests", {"app/"}, {"bench/", "tests/"}, {}},
    {"api uses lessons", {"api/"}, {"app/", "bench/", "tests/", "python/"}, {}},
    {"the public interface stands alone",
     {"include/", "python/", "examples/", "tests/api/", "tests/install/"},
     {"src2d/", "render/", "lessons/", "api/", "app/", "Eigen/", "fmt/"},
     {}},

    // One place for each foreign library.
    {"Box2D is geometry",
     kEverywhere,
     {"box2d/"},
     {"src2d/geometry/", "tests/src2d/geometry/", "bench/"}},
    {"toml++ reads scenes", kEverywhere, {"toml++/"}, {"src2d/scene/"}},
    {"JSON is for output",
     kEverywhere,
     {"nlohmann/"},
     {"src2d/trace/", "lessons/", "app/", "bench/", "tests/"}},
    {"OpenGL is behind the canvas", kEverywhere, {"GL/", "EGL/"}, {"render/"}},
    {"the command line is the app's", kEverywhere, {"CLI/"}, {"app/", "bench/"}},
};

/// What a line includes; empty when it includes nothing. Ways up are left out.
std::string_view included(std::string_view line) {
  const auto skip = [&](std::string_view what) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with(what)) return false;
    line.remove_prefix(what.size());
    return true;
  };
  if (!skip("#") || !skip("include") || !(skip("<") || skip("\""))) return {};
  while (skip("../")) {
  }
  return line;
}

/// Box2D serves for geometry and collision; its dynamics are only a peer to measure against.
bool usesBox2dDynamics(std::string_view line) {
  const std::vector<std::string> kinds = {"World", "Body", "Fixture"};
  return std::any_of(kinds.begin(), kinds.end(), [&](const std::string& kind) {
    return line.find("b2" + kind) != std::string_view::npos;
  });
}

/// Results of the C library differ in their last place: src2d/core/trig.h has its own.
bool usesTrigonometryOfTheCLibrary(std::string_view line) {
  const std::vector<std::string> names = {"sin", "cos", "tan", "asin", "acos", "atan", "atan2"};
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return line.find("std::" + name + "(") != std::string_view::npos;
  });
}

bool startsWithAny(std::string_view text, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const std::string& prefix) { return text.starts_with(prefix); });
}

/// The names of the rules that a line of a file breaks.
std::vector<std::string> broken(const std::string& path, std::string_view line) {
  std::vector<std::string> names;
  for (const Rule& rule : kRules) {
    if (startsWithAny(path, rule.folders) && !startsWithAny(path, rule.exceptions) &&
        startsWithAny(included(line), rule.forbidden)) {
      names.push_back(rule.name);
    }
  }
  if (!path.starts_with("bench/") && usesBox2dDynamics(line)) {
    names.emplace_back("Box2D's dynamics are a peer");
  }
  if (path.starts_with("src2d/") && usesTrigonometryOfTheCLibrary(line)) {
    names.emplace_back("trigonometry is our own");
  }
  return names;
}

/// "path:line: the rule: the text" for every offending line of a file.
std::vector<std::string> violations(const std::string& path, std::istream& text) {
  std::vector<std::string> found;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    for (const std::string& name : broken(path, line)) {
      found.push_back(path + ":" + std::to_string(number) + ": " + name + ": " + line);
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
  EXPECT_THAT(violationsIn("src2d/geometry/x.h", std::string("void f(b2") + "Body*);\n").size(), 1);
  EXPECT_THAT(violationsIn("src2d/world.cpp", "  return std::cos(angle);\n").size(), 1);
  EXPECT_THAT(violationsIn("app/main.cpp", "#include <toml++/toml.h>\n").size(), 1);
}

TEST(Layers, WhatIsAllowedIsNotNamed) {
  EXPECT_THAT(
      violationsIn("render/canvas.cpp", "#include <GL/osmesa.h>\n#include \"src2d/world.h\"\n"),
      IsEmpty());
  EXPECT_THAT(violationsIn("src2d/geometry/shape.h", "#include <box2d/b2_polygon_shape.h>\n"),
              IsEmpty());
  EXPECT_THAT(violationsIn("bench/peers/box2d_peer.cpp", std::string("b2") + "World world_;\n"),
              IsEmpty());
}

}  // namespace
