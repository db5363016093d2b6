/// No circle of includes: neither of rooms, nor of headers, nor, inside the rooms of merging, of
/// headers taken together with their sources. A header may name a function whose source lies beside
/// it under another name, or in a room above: so the rules include merging/rule.h and
/// collections/collection_method.h, and merging/rule_selection.cpp the rules.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The nodes that each node includes.
using Includes = std::map<std::string, std::set<std::string>>;

/// The files that a text includes by their path below the root.
std::set<std::string> includesOf(const std::string& text) {
  static const std::regex line(R"re((^|\n)[ \t]*#[ \t]*include[ \t]*"([^"\n]+)")re");
  std::set<std::string> files;
  for (std::sregex_iterator at(text.begin(), text.end(), line), end; at != end; ++at) {
    files.insert((*at)[2]);
  }
  return files;
}

/// All sources below src2d and the rooms above it.
const Includes& sources() {
  static const Includes all = [] {
    const fs::path root = MERGE2D_SOURCE_DIR;
    Includes found;
    for (const std::string folder : {"src2d", "render", "lessons", "api", "app"}) {
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
        const fs::path extension = entry.path().extension();
        if (extension != ".h" && extension != ".cpp") continue;
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        found[fs::relative(entry.path(), root).generic_string()] = includesOf(text.str());
      }
    }
    return found;
  }();
  return all;
}

/// The same with each file under the name `nodeOf(file)`, which is empty for those left out.
template <class NodeOf>
Includes grouped(const Includes& files, NodeOf&& nodeOf) {
  Includes groups;
  for (const auto& [file, included] : files) {
    const std::string node = nodeOf(file);
    if (node.empty()) continue;
    for (const std::string& other : included) {
      const std::string to = nodeOf(other);
      if (!to.empty() && to != node) groups[node].insert(to);
    }
  }
  return groups;
}

/// Walks along includes and stops at the first circle.
class CircleSearch {
 public:
  explicit CircleSearch(const Includes& includes) : includes_(includes) {}

  /// The nodes of a circle in their order, the first one again at the end; empty if there is none.
  std::vector<std::string> run() {
    for (const auto& [node, to] : includes_) {
      if (visit(node)) return circle_;
    }
    return {};
  }

 private:
  bool visit(const std::string& node) {
    const auto open = std::ranges::find(way_, node);
    if (open != way_.end()) {
      circle_.assign(open, way_.end());
      circle_.push_back(node);
      return true;
    }
    const auto at = includes_.find(node);
    if (at == includes_.end() || !seen_.insert(node).second) return false;
    way_.push_back(node);
    for (const std::string& next : at->second) {
      if (visit(next)) return true;
    }
    way_.pop_back();
    return false;
  }

  const Includes& includes_;
  std::set<std::string> seen_;
  std::vector<std::string> way_, circle_;
};

std::vector<std::string> circleOf(const Includes& includes) { return CircleSearch(includes).run(); }

/// "src2d/merging" of "src2d/merging/merge.h".
std::string roomOf(const std::string& path) { return fs::path(path).parent_path().string(); }

/// "src2d/merging/merge" of both "src2d/merging/merge.h" and "src2d/merging/merge.cpp".
std::string moduleOf(const std::string& path) {
  return fs::path(path).replace_extension().generic_string();
}

TEST(Circles, NoRoomsIncludeEachOther) {
  const Includes rooms = grouped(sources(), roomOf);
  ASSERT_GE(rooms.size(), 12u);
  EXPECT_THAT(circleOf(rooms), IsEmpty());
}

TEST(Circles, NoHeadersIncludeEachOther) {
  const auto header = [](const std::string& path) {
    return path.ends_with(".h") ? path : std::string();
  };
  EXPECT_THAT(circleOf(grouped(sources(), header)), IsEmpty());
}

TEST(Circles, NoModulesOfMergingIncludeEachOther) {
  const std::set<std::string> rooms = {"src2d/proofs", "src2d/collections", "src2d/sleeping",
                                       "src2d/relaxation", "src2d/merging"};
  const auto module = [&](const std::string& path) {
    return rooms.contains(roomOf(path)) ? moduleOf(path) : std::string();
  };
  const Includes modules = grouped(sources(), module);
  ASSERT_GE(modules.size(), 20u);
  EXPECT_THAT(circleOf(modules), IsEmpty());
}

TEST(Circles, ACircleIsNamedWithAllItsNodes) {
  EXPECT_THAT(circleOf({{"a", {"b"}}, {"b", {"c", "d"}}, {"c", {"e"}}, {"d", {"b"}}}),
              ElementsAre("b", "d", "b"));
  EXPECT_THAT(circleOf({{"a", {"b", "c"}}, {"b", {"c"}}}), IsEmpty());
}

TEST(Circles, AHeaderAndItsSourceAreOneModule) {
  const Includes files = {{"m/x.h", {}}, {"m/x.cpp", {"m/x.h", "m/y.h"}}, {"m/y.h", {"m/x.h"}}};
  EXPECT_THAT(circleOf(files), IsEmpty());
  EXPECT_THAT(circleOf(grouped(files, moduleOf)), ElementsAre("m/x", "m/y", "m/x"));
}

TEST(Circles, AnIncludeIsFoundHoweverItIsWritten) {
  EXPECT_THAT(includesOf("#pragma once\n  #  include \"m/x.h\"\n#include <vector>\n"),
              ElementsAre("m/x.h"));
  EXPECT_THAT(includesOf("// #include \"m/x.h\"\n"), IsEmpty());
}

}  // namespace
