#pragma once
/// What the tests of the documentation share: pages and their parts, and what there is in the
/// sources that a page may name.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace merge2d::docs {

namespace fs = std::filesystem;

inline const fs::path kRoot = MERGE2D_SOURCE_DIR;

inline std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// All files with one of the extensions below a folder of the project, in order.
inline std::vector<fs::path> filesBelow(const std::string& folder,
                                        const std::set<std::string>& extensions) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    if (extensions.contains(entry.path().extension())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

inline std::string nameOf(const fs::path& path) {
  return fs::relative(path, kRoot).generic_string();
}

/// README, CHANGELOG and everything below docs/.
inline std::vector<fs::path> pages() {
  std::vector<fs::path> all = filesBelow("docs", {".md"});
  all.insert(all.begin(), {kRoot / "README.md", kRoot / "CHANGELOG.md"});
  return all;
}

/// All matches of a pattern's first group.
inline std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) {
    found.push_back((*at)[1]);
  }
  return found;
}

/// A fenced block of a page, with what stands behind its opening fence.
struct Block {
  std::string language;
  std::string text;
};

/// A page: its blocks apart from its prose.
struct Page {
  std::string prose;
  std::vector<Block> blocks;
};

inline Page pageOf(const std::string& text) {
  Page page;
  bool inside = false;
  for (const std::string& line : linesOf(text)) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) page.blocks.push_back({line.substr(3), {}});
    } else {
      (inside ? page.blocks.back().text : page.prose) += line + "\n";
    }
  }
  return page;
}

/// What stands between backticks.
inline std::vector<std::string> codeIn(const std::string& prose) {
  return matches(prose, "`([^`\n]+)`");
}

/// The rows of all tables of a page, as cells, without heads and rules. "\|" is a bar in a cell.
inline std::vector<std::vector<std::string>> tableRows(const std::string& prose) {
  const auto trimmed = [](const std::string& s) {
    const std::size_t first = s.find_first_not_of(' ');
    return first == std::string::npos ? "" : s.substr(first, s.find_last_not_of(' ') - first + 1);
  };
  std::vector<std::vector<std::string>> rows;
  bool body = false;
  for (const std::string& line : linesOf(prose)) {
    if (!line.starts_with("|")) body = false;
    if (body) {
      std::vector<std::string> cells{""};
      for (std::size_t i = 1; i < line.size(); ++i) {
        if (line[i] == '|' && line[i - 1] != '\\') {
          cells.back() = trimmed(cells.back());
          cells.emplace_back();
        } else {
          cells.back() += line[i];
        }
      }
      cells.pop_back();
      rows.push_back(cells);
    }
    if (line.starts_with("|---")) body = true;
  }
  return rows;
}

/// Every test of the project as "Suite.Name", and the file that it is in.
inline const std::map<std::string, std::string>& allTests() {
  static const std::map<std::string, std::string> tests = [] {
    const std::regex pattern(
        R"((?:TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\(\s*(\w+),\s*(\w+))");
    std::map<std::string, std::string> found;
    for (const fs::path& file : filesBelow("tests", {".cpp"})) {
      const std::string text = read(file);
      for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
        found[(*at)[1].str() + "." + (*at)[2].str()] = nameOf(file);
      }
    }
    return found;
  }();
  return tests;
}

inline bool looksLikeTest(const std::string& word) {
  static const std::regex pattern(R"([A-Z]\w*\.[A-Z]\w*)");
  return std::regex_match(word, pattern);
}

/// A path of the project's own folders, such as src2d/world.cpp or docs/scenes/.
inline bool looksLikePath(const std::string& word) {
  static const std::regex pattern(
      R"((src2d|render|app|tests|docs|scenes|bench|scripts|cmake|frames/reference)/[\w./-]*)");
  return std::regex_match(word, pattern);
}

/// Whether a name occurs in a text as a word of its own.
inline bool hasWord(const std::string& text, const std::string& word) {
  return std::regex_search(text, std::regex("\\b" + word + "\\b"));
}

}  // namespace merge2d::docs
