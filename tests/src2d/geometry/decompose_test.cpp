#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

#include "src2d/core/error.h"
#include "src2d/geometry/outline.h"
#include "src2d/geometry/shape.h"

namespace merge2d {
namespace {

using Outline = std::vector<Vec2>;

double signedArea(const Outline& outline) {
  return areaProperties(ConvexShape{Polygon{outline}}).area;  // the formula holds for any outline
}

std::string errorOf(const Outline& outline) {
  try {
    convexPieces(outline);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool isStrictlyConvex(const Polygon& p) {
  const std::size_t n = p.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(p.vertices[i], p.vertices[(i + 1) % n], p.vertices[(i + 2) % n]) <= 0) return false;
  }
  return n >= 3 && n <= Polygon::kMaxVertices;
}

Outline regularPolygon(int n) {
  Outline outline;
  for (int i = 0; i < n; ++i) {
    outline.push_back(Rotation::of(2.0 * std::numbers::pi * i / n) * Vec2(1.0, 0.0));
  }
  return outline;
}

double sumOfAreas(const std::vector<Polygon>& pieces) {
  double sum = 0.0;
  for (const Polygon& piece : pieces) sum += areaProperties(ConvexShape{piece}).area;
  return sum;
}

TEST(ConvexPieces, LeaveAConvexOutlineAsItIs) {
  for (int n = 3; n <= 8; ++n) {
    const auto pieces = convexPieces(regularPolygon(n));
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_EQ(pieces[0].vertices, regularPolygon(n));
  }
}

TEST(ConvexPieces, TurnAClockwiseOutlineAround) {
  const auto pieces = convexPieces({{0.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}});
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_DOUBLE_EQ(signedArea(pieces[0].vertices), 1.0);
}

TEST(ConvexPieces, DropRepeatedAndCollinearVertices) {
  const auto pieces = convexPieces(
      {{0.0, 0.0}, {0.5, 0.0}, {1.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {0.0, 0.0}});
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_THAT(pieces[0].vertices, testing::UnorderedElementsAre(Vec2(0.0, 0.0), Vec2(1.0, 0.0),
                                                                Vec2(1.0, 1.0), Vec2(0.0, 1.0)));
}

TEST(ConvexPieces, CutAnLInTwo) {
  const Outline l = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  const auto pieces = convexPieces(l);
  EXPECT_EQ(pieces.size(), 2U);
  EXPECT_DOUBLE_EQ(sumOfAreas(pieces), 4.0);
}

TEST(ConvexPieces, CutAPlusInThree) {
  const Outline plus = {{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                        {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  const auto pieces = convexPieces(plus);
  EXPECT_LE(pieces.size(), 5U);
  EXPECT_DOUBLE_EQ(sumOfAreas(pieces), 5.0);
}

TEST(ConvexPieces, KeepToEightVertices) {
  for (const int n : {9, 14, 15, 20, 100}) {
    const auto pieces = convexPieces(regularPolygon(n));
    EXPECT_LE(static_cast<int>(pieces.size()), (n + 2) / 4) << n;
    EXPECT_NEAR(sumOfAreas(pieces), signedArea(regularPolygon(n)), 1e-12);
    for (const Polygon& piece : pieces) EXPECT_TRUE(isStrictlyConvex(piece));
  }
}

TEST(ConvexPieces, CutASpiral) {
  Outline spiral;
  for (int i = 0; i <= 60; ++i) spiral.push_back(Rotation::of(0.3 * i) * Vec2(1.0 + 0.1 * i, 0.0));
  for (int i = 60; i >= 0; --i) spiral.push_back(Rotation::of(0.3 * i) * Vec2(1.3 + 0.1 * i, 0.0));
  const auto pieces = convexPieces(spiral);
  EXPECT_NEAR(sumOfAreas(pieces), std::abs(signedArea(spiral)), 1e-9);
  for (const Polygon& piece : pieces) EXPECT_TRUE(isStrictlyConvex(piece));
}

TEST(ConvexPieces, NameTheEdgesThatCross) {
  EXPECT_EQ(errorOf({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),
            "the outline crosses itself between edge 0 and edge 2");
  // A vertex that touches an edge, and an edge that folds back.
  EXPECT_EQ(errorOf({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}),
            "the outline crosses itself between edge 0 and edge 2");
  EXPECT_EQ(errorOf({{0, 0}, {2, 0}, {1, 0}, {1, 1}}),
            "the outline crosses itself between edge 0 and edge 1");
}

TEST(ConvexPieces, SayWhenThereIsNothingToCut) {
  EXPECT_EQ(errorOf({}), "the outline has fewer than three distinct vertices");
  EXPECT_EQ(errorOf({{0, 0}, {1, 0}, {1, 0}}),
            "the outline has fewer than three distinct vertices");
  EXPECT_EQ(errorOf({{0, 0}, {1, 0}, {2, 0}}), "the outline encloses no area");
  EXPECT_EQ(errorOf({{0, 0}, {1, 0}, {0, std::nan("")}}),
            "the outline has a coordinate that is not a finite number");
}

/// A star-shaped outline: rays at growing angles, of arbitrary lengths.
rc::Gen<Outline> starOutlines() {
  const auto lengths = rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 50));
  return rc::gen::map(
      rc::gen::suchThat(lengths, [](const auto& v) { return v.size() >= 3; }), [](const auto& v) {
        Outline outline;
        const double angle = 2.0 * std::numbers::pi / static_cast<double>(v.size());
        for (std::size_t i = 0; i < v.size(); ++i) {
          outline.push_back(Rotation::of(angle * static_cast<double>(i)) * Vec2(v[i], 0.0));
        }
        return outline;
      });
}

RC_GTEST_PROP(ConvexPieces, CoverTheOutlineWithConvexPolygons, ()) {
  const Outline outline = *starOutlines();
  const auto pieces = convexPieces(outline);
  RC_ASSERT(std::abs(sumOfAreas(pieces) - signedArea(outline)) < 1e-9 * signedArea(outline));
  for (const Polygon& piece : pieces) RC_ASSERT(isStrictlyConvex(piece));
}

/// A skyline of columns on a grid: many collinear vertices, many right angles.
RC_GTEST_PROP(ConvexPieces, CoverASkyline, ()) {
  const auto heights =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 6)));
  Outline outline = {{static_cast<double>(heights.size()), 0.0}};
  double area = 0.0;
  for (std::size_t i = heights.size(); i-- > 0;) {
    outline.emplace_back(static_cast<double>(i) + 1.0, heights[i]);
    outline.emplace_back(static_cast<double>(i), heights[i]);
    area += heights[i];
  }
  outline.emplace_back(0.0, 0.0);
  const auto pieces = convexPieces(outline);
  RC_ASSERT(std::abs(sumOfAreas(pieces) - area) < 1e-9 * area);
  RC_ASSERT(pieces.size() <= heights.size());
  for (const Polygon& piece : pieces) RC_ASSERT(isStrictlyConvex(piece));
}

}  // namespace
}  // namespace merge2d
