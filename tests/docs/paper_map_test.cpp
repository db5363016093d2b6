/// Keeps docs/paper_map.md and docs/symbols.md true.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src2d/scene/settings.h"
#include "tests/docs/docs_testing.h"

namespace merge2d::docs {
namespace {

using Row = std::vector<std::string>;

std::vector<Row> mapRows() { return tableRows(pageOf(read(kRoot / "docs/paper_map.md")).prose); }

/// The two words in backticks of a cell: what, and in which file.
std::pair<std::string, std::string> whatAndWhere(const std::string& cell) {
  const std::vector<std::string> words = codeIn(cell);
  if (words.size() != 2) return {};
  return {words[0], words[1]};
}

TEST(PaperMap, EveryFunctionOccursInItsFile) {
  for (const Row& row : mapRows()) {
    ASSERT_EQ(row.size(), 4u) << row[0];
    const auto [function, file] = whatAndWhere(row[2]);
    ASSERT_TRUE(fs::is_regular_file(kRoot / file)) << row[0] << ": " << row[2];
    const std::string name = function.substr(function.rfind(':') + 1);
    EXPECT_TRUE(hasWord(read(kRoot / file), name)) << row[0] << ": no " << name << " in " << file;
  }
}

TEST(PaperMap, EveryTestIsInItsFile) {
  for (const Row& row : mapRows()) {
    const auto [test, file] = whatAndWhere(row[3]);
    const auto found = allTests().find(test);
    ASSERT_NE(found, allTests().end()) << row[0] << ": there is no test " << test;
    EXPECT_EQ(found->second, file) << row[0] << ": " << test;
  }
}

TEST(PaperMap, NoLineAndNoEquationIsMissing) {
  std::set<std::string> named;
  for (const Row& row : mapRows()) named.insert(row[0]);
  for (int line = 1; line <= 12; ++line) {
    EXPECT_TRUE(named.contains("Line " + std::to_string(line))) << line;
  }
  for (int equation = 1; equation <= 20; ++equation) {
    EXPECT_TRUE(named.contains("Eq. (" + std::to_string(equation) + ")")) << equation;
  }
}

/// The stages of the page stand in the step in the same order.
TEST(PaperMap, TheStepCallsTheFunctionsOfAlgorithm1InOrder) {
  const std::string world = read(kRoot / "src2d/world.cpp");
  std::size_t at = world.find("void World::Impl::runStages()");
  ASSERT_NE(at, std::string::npos);
  for (const Row& row : mapRows()) {
    if (!row[0].starts_with("Line ") || row[0] == "Line 1") continue;
    const std::string stage = row[1].substr(0, row[1].find_first_of(":,"));
    const std::string call = "run(Stage::" + stage + ", [&] { " + whatAndWhere(row[2]).first + "(";
    at = world.find(call, at);
    ASSERT_NE(at, std::string::npos) << "no " << call << " after the lines before";
  }
}

TEST(PaperMap, EquationsCitedInTheSourcesAreInTheMap) {
  std::set<std::string> named;
  for (const Row& row : mapRows()) named.insert(row[0]);
  for (const fs::path& file : filesBelow("src2d", {".h", ".cpp"})) {
    for (const std::string& number : matches(read(file), R"(Eqs?\. \((\d+)\))")) {
      EXPECT_TRUE(named.contains("Eq. (" + number + ")")) << nameOf(file) << ": " << number;
    }
  }
}

/// Table 1; "let it breathe" is a change per step.
TEST(PaperMap, TheDefaultThresholdsAreThoseOfTable1) {
  const Settings settings;
  EXPECT_EQ(settings.merging.velocity, 1e-2);
  EXPECT_EQ(settings.unmerging.velocity, 2e-2);
  EXPECT_EQ(settings.sleeping.velocity, 1e-5);
  EXPECT_EQ(settings.merging.breathing, 1e-5);
  EXPECT_EQ(settings.merging.sliding, 1e-2);
  EXPECT_EQ(settings.unmerging.sliding, 1e-2);
  EXPECT_EQ(settings.merging.steps, 3);
  EXPECT_EQ(settings.sleeping.steps, 3);
  EXPECT_EQ(settings.unmerging.steps, 3);
  EXPECT_EQ(settings.unmerging.sweeps, 1);
  EXPECT_EQ(settings.solver.iterations, 10);  // Section 8.1
}

// ---- docs/symbols.md ----

std::vector<Row> symbolRows() { return tableRows(pageOf(read(kRoot / "docs/symbols.md")).prose); }

TEST(Symbols, EveryNameOccursInItsFile) {
  ASSERT_GT(symbolRows().size(), 40u);
  for (const Row& row : symbolRows()) {
    ASSERT_EQ(row.size(), 6u) << row[0];
    const std::vector<std::string> file = codeIn(row[5]);
    ASSERT_EQ(file.size(), 1u) << row[0];
    ASSERT_TRUE(fs::is_regular_file(kRoot / file[0])) << row[0] << ": " << file[0];
    const std::string text = read(kRoot / file[0]);
    for (const std::string& name : codeIn(row[1])) {
      for (const std::string& part : matches(name, R"((\w+))")) {
        EXPECT_TRUE(hasWord(text, part)) << row[0] << ": no " << part << " in " << file[0];
      }
    }
  }
}

TEST(Symbols, EachLetterHasOneMeaning) {
  std::set<std::string> seen;
  for (const Row& row : symbolRows()) EXPECT_TRUE(seen.insert(row[0]).second) << row[0];
}

/// All Greek letters of a text in UTF-8, where each takes two bytes.
std::set<std::string> greekLettersIn(const std::string& text) {
  std::set<std::string> found;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte == 0xCE || byte == 0xCF) found.insert(text.substr(i, 2));
  }
  return found;
}

TEST(Symbols, EveryGreekLetterOfTheEngineIsListed) {
  const std::set<std::string> listed = greekLettersIn(read(kRoot / "docs/symbols.md"));
  for (const fs::path& file : filesBelow("src2d", {".h", ".cpp"})) {
    for (const std::string& letter : greekLettersIn(read(file))) {
      EXPECT_TRUE(listed.contains(letter)) << nameOf(file) << ": " << letter;
    }
  }
}

TEST(Symbols, EachHasAUnitAndAShape) {
  for (const Row& row : symbolRows()) {
    EXPECT_FALSE(row[2].empty()) << row[0];
    EXPECT_FALSE(row[3].empty()) << row[0];
    EXPECT_FALSE(row[4].empty()) << row[0];
  }
}

}  // namespace
}  // namespace merge2d::docs
