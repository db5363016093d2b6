#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <sstream>

#include "src2d/cycles/contact_graph.h"
#include "tests/src2d/cycles/named_graphs.h"

namespace merge2d {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Groups as "A B, C D", by name.
std::string named(const ContactGraph& graph, const Groups& groups) {
  std::set<std::string> lines;
  for (const auto& members : membersOf(groups)) {
    std::set<std::string> names;
    for (const std::uint32_t i : members) names.insert(graph.bodies[i]);
    std::string line;
    for (const std::string& name : names) line += (line.empty() ? "" : " ") + name;
    lines.insert(line);
  }
  std::string all;
  for (const std::string& line : lines) all += (all.empty() ? "" : ", ") + line;
  return all;
}

class Named : public testing::TestWithParam<NamedGraph> {};

TEST_P(Named, HasTheGroupsThatTheoryGives) {
  const ContactGraph graph = parseContactGraph(GetParam().text, "graph.txt");
  const CycleVerdicts verdicts = judge(graph);
  EXPECT_EQ(named(graph, verdicts.triangle), GetParam().triangle);
  EXPECT_EQ(named(graph, verdicts.rigid), GetParam().rigid);
}

TEST_P(Named, DoesNotDependOnTheOrderOfItsLines) {
  std::vector<std::string> lines;
  std::istringstream in(GetParam().text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::mt19937 random(3);
  for (int i = 0; i < 5; ++i) {
    std::shuffle(lines.begin(), lines.end(), random);
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    const ContactGraph graph = parseContactGraph(text, "graph.txt");
    const CycleVerdicts verdicts = judge(graph);
    EXPECT_EQ(named(graph, verdicts.triangle), GetParam().triangle) << text;
    EXPECT_EQ(named(graph, verdicts.rigid), GetParam().rigid) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Graphs, Named, testing::ValuesIn(namedGraphs()), [](const auto& graph) {
  std::string name = graph.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

CycleVerdicts judged(const std::string& text) { return judge(parseContactGraph(text, "g")); }

TEST(Verdicts, APairMayMergeWhenItsGroupHoldsAndItTouches) {
  const CycleVerdicts verdicts = judged("A B 1\nB C 1\nC A 1\nC D 1\n");
  EXPECT_THAT(verdicts.pair_triangle, ElementsAre(1, 1, 1, 0));
  EXPECT_THAT(verdicts.pair_rigid, ElementsAre(1, 1, 1, 0));
}

TEST(Verdicts, APairWithoutContactsNeverMerges) {
  const CycleVerdicts verdicts = judged("A B 0\nB C 2\nC A 2\n");
  EXPECT_EQ(verdicts.triangle, (Groups{0, 0, 0}));
  EXPECT_THAT(verdicts.pair_triangle, ElementsAre(0, 1, 1));
  EXPECT_THAT(verdicts.pair_rigid, ElementsAre(0, 1, 1));
}

TEST(Verdicts, TheCycleThatClosedIsNamed) {
  EXPECT_THAT(judged("A B 1\nC D 1\nB C 1\nA C 1\n").cycles,
              ElementsAre(testing::UnorderedElementsAre(0, 2, 3)));
  EXPECT_THAT(judged("A B 1\nC D 1\nB C 1\nA D 1\n").cycles, IsEmpty());
}

TEST(Verdicts, PinnedBodiesAreOneEvenWhenNothingTouchesThem) {
  EXPECT_EQ(judged("pinned A B\nC D 1\n").rigid, (Groups{0, 0, 2, 3}));
  EXPECT_EQ(judged("pinned A\nC D 2\n").rigid, (Groups{0, 1, 1}));
  EXPECT_THAT(judged("pinned A B\nA B 1\n").pair_rigid, ElementsAre(1));
}

TEST(Verdicts, TheGenericGroupsTellWhatIsOnlyDegenerate) {
  const CycleVerdicts verdicts = judged("A B 1 0,0\nB C 1 1,0\nC A 1 2,0\n");
  EXPECT_EQ(verdicts.generic, (Groups{0, 0, 0}));
  EXPECT_EQ(verdicts.rigid, (Groups{0, 1, 2}));
}

TEST(Verdicts, PointsOfSomePairsAreEnoughToSeeThatTheseAreDegenerate) {
  // The links L and M are parallel; N may be anywhere.
  const std::string links = "A L 1 0,0\nL B 1 0,1\nA M 1 1,0\nM B 1 1,1\n";
  EXPECT_EQ(judged(links + "A N 1\nN B 1\n").rigid, (Groups{0, 0, 0, 0, 0}));
  // A and B coincide in one point; the third pin of the triangle cannot help A against B.
  EXPECT_EQ(judged("A B 2 1,1 1,1\nB C 1\n").rigid, (Groups{0, 1, 2}));
}

TEST(Verdicts, DoNotDependOnUnitsNorOnThePlace) {
  const auto triangle = [](double scale, double x, double height) {
    std::ostringstream text;
    text.precision(17);
    text << "A B 1 " << x << "," << x << "\nB C 1 " << x + scale << "," << x << "\nC A 1 "
         << x + 0.5 * scale << "," << x + height * scale << "\n";
    return judged(text.str()).rigid;
  };
  for (const double scale : {1e-6, 1e-3, 1.0, 1e6}) {
    EXPECT_EQ(triangle(scale, 0.0, 1e-3), (Groups{0, 0, 0})) << scale;
    EXPECT_EQ(triangle(scale, 0.0, 1e-9), (Groups{0, 1, 2})) << scale;
    EXPECT_EQ(triangle(scale, 100.0 * scale, 1e-3), (Groups{0, 0, 0})) << scale;
  }
}

TEST(Verdicts, ALongChainOfTrianglesIsOneGroup) {
  std::string text;
  for (int i = 0; i + 2 < 3000; ++i) {
    if (i == 0) text += "b0 b1 1\n";
    text += "b" + std::to_string(i) + " b" + std::to_string(i + 2) + " 1\n";
    text += "b" + std::to_string(i + 1) + " b" + std::to_string(i + 2) + " 1\n";
  }
  const CycleVerdicts verdicts = judged(text);
  EXPECT_EQ(verdicts.triangle, Groups(3000, 0));
  EXPECT_EQ(verdicts.rigid, Groups(3000, 0));
}

}  // namespace
}  // namespace merge2d
