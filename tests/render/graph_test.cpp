#include "render/graph.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "render/graph_layout.h"

namespace merge2d {
namespace {

ContactGraph parse(const std::string& text) { return parseContactGraph(text, "graph.txt"); }

/// How many pixels of a half of the picture have this colour.
int count(const Picture& picture, Color color, bool right_half) {
  const int middle = picture.width / 2;
  int found = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = right_half ? middle : 0; x < (right_half ? picture.width : middle); ++x) {
      if (picture.at(x, y) == color) ++found;
    }
  }
  return found;
}

Picture drawn(const std::string& text) {
  Canvas canvas(640, 320);
  const ContactGraph graph = parse(text);
  return drawGraph(canvas, graph, judge(graph));
}

TEST(Graph, GroupsAreColouredPerCriterion) {
  // Three links hold two bodies: only the rigid criterion sees it.
  const Picture picture = drawn("A L 1\nL B 1\nA M 1\nM B 1\nA N 1\nN B 1\n");
  const Color group = lightTheme().collections[0].fill, free = lightTheme().free.fill;
  EXPECT_EQ(count(picture, group, false), 0);
  EXPECT_GT(count(picture, free, false), 100);
  EXPECT_GT(count(picture, group, true), 100);
  EXPECT_EQ(count(picture, free, true), 0);
}

TEST(Graph, WhatHoldsSingleContactsIsShadedInBothPanels) {
  const auto shaded = [](const std::string& text, bool right_half) {
    const Color shade = lightTheme().collections[Theme::kFaint].fill;
    return count(drawn(text), mix(lightTheme().background, shade, 0.55), right_half);
  };
  for (const char* triangle : {"A B 1\nB C 1\nC A 1\n",                 // laid out
                               "A B 1 0,0\nB C 1 4,0\nC A 1 2,3\n"}) {  // in their places
    EXPECT_GT(shaded(triangle, false), 100) << triangle;
    EXPECT_NEAR(shaded(triangle, true), shaded(triangle, false), 20) << triangle;
  }
  const char* links = "A L 1\nL B 1\nA M 1\nM B 1\nA N 1\nN B 1\n";
  EXPECT_EQ(shaded(links, false), 0);
  EXPECT_GT(shaded(links, true), 100);
  EXPECT_EQ(shaded("A B 1\nB C 2\n", true), 0);
}

TEST(Graph, PivotsAreRed) {
  EXPECT_GT(count(drawn("A B 1\n"), lightTheme().broken_contact, true), 20);
  EXPECT_EQ(count(drawn("A B 2\n"), lightTheme().broken_contact, true), 0);
}

TEST(Graph, LongNamesStayInTheirPanel) {
  const std::string name = "a-body-whose-name-goes-on-" + std::string(200, 'x');
  const Picture picture = drawn(name + " B 1\n");
  for (int y = 60; y < picture.height; ++y) {
    for (const int x : {0, 1, 317, 318, 322, 323, 638, 639}) {
      ASSERT_EQ(picture.at(x, y), lightTheme().background) << x << " " << y;
    }
  }
}

TEST(Graph, AnythingCanBeDrawn) {
  for (const char* text :
       {"", "pinned A\n", "A B 0\n", "A B 2 1,1 1,1\n", "A B 1 5,5\nB C 1 5,5\n",
        "A B 3 0,0 1,0 0.5,1\nC D 1 1e12,1e12\n", "A B 1 1e-9,0\nB C 1 0,1e-9\n"}) {
    EXPECT_GT(count(drawn(text), lightTheme().ink, false), 0) << text;  // the title at least
  }
}

TEST(GraphLayout, PutsBodiesAmidTheirPoints) {
  const GraphLayout layout = layOutGraph(parse("A B 2 0,0 2,0\n"));
  EXPECT_TRUE(layout.placed);
  EXPECT_EQ(layout.bodies[0], Vec2(1, 0));
}

TEST(GraphLayout, PutsWhatDoesNotHangTogetherSideBySide) {
  std::string text;
  for (int i = 0; i < 12; ++i) {
    text += fmt::format("a{0} b{0} 1\nb{0} c{0} 1\nc{0} a{0} 1\n", i);
  }
  const ContactGraph graph = parse(text + "lonely other 0\n");
  const GraphLayout layout = layOutGraph(graph);
  double shortest = 1e300, longest = 0.0;  // edges
  for (const GraphPair& pair : graph.pairs) {
    const double length = (layout.bodies[pair.a] - layout.bodies[pair.b]).norm();
    shortest = std::min(shortest, length);
    if (pair.contacts > 0) longest = std::max(longest, length);
  }
  double nearest = 1e300;  // bodies
  for (std::size_t i = 0; i < layout.bodies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      nearest = std::min(nearest, (layout.bodies[i] - layout.bodies[j]).norm());
    }
  }
  EXPECT_GT(nearest, 0.6 * longest) << "no two bodies nearer than an edge is long, or so";
  const Vec2 size = layout.extent.upper - layout.extent.lower;
  EXPECT_LT(size.maxCoeff(), 14.0 * longest) << "and not much emptiness between them";
}

TEST(GraphLayout, KeepsBodiesApart) {
  std::string text;
  for (int i = 0; i < 40; ++i) {
    text += "b" + std::to_string(i) + " b" + std::to_string((i * 7 + 1) % 40 + 40) + " 1\n";
  }
  const GraphLayout layout = layOutGraph(parse(text));
  EXPECT_FALSE(layout.placed);
  for (std::size_t i = 0; i < layout.bodies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT((layout.bodies[i] - layout.bodies[j]).norm(), 0.2) << i << " " << j;
    }
  }
}

}  // namespace
}  // namespace merge2d
