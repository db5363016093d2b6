#include "render/silhouette.h"

#include <gtest/gtest.h>

#include <numbers>

namespace merge2d {
namespace {

Polygon boxAt(double x, double y, double width, double height, double angle = 0.0) {
  return makeBox(width, height, Pose::at({x, y}, angle));
}

double perimeter(const Silhouette& look) {
  double sum = 0.0;
  for (const Segment& s : look.boundary) sum += (s.to - s.from).norm();
  return sum;
}

TEST(Silhouette, OfOnePieceNeedsNoBoundaryOfItsOwn) {
  const Silhouette look = silhouette({boxAt(0.0, 0.0, 2.0, 1.0)});
  EXPECT_TRUE(look.boundary.empty());
  EXPECT_EQ(look.pieces[0].kind, Piece::Kind::Box);
  EXPECT_NEAR(look.width, 1.0, 1e-9);
  EXPECT_NEAR(look.radius, std::sqrt(1.25), 1e-9);
}

TEST(Silhouette, KnowsATurnedRectangleFromARhombus) {
  EXPECT_EQ(silhouette({boxAt(1.0, 2.0, 2.0, 1.0, 0.7)}).pieces[0].kind, Piece::Kind::Box);
  const Polygon rhombus{{{-1.0, 0.0}, {0.0, -0.5}, {1.0, 0.0}, {0.0, 0.5}}};
  EXPECT_EQ(silhouette({rhombus}).pieces[0].kind, Piece::Kind::Polygon);
}

TEST(Silhouette, HidesASharedEdge) {
  const Silhouette look = silhouette({boxAt(-0.5, 0.0, 1.0, 1.0), boxAt(0.5, 0.0, 1.0, 1.0)});
  EXPECT_NEAR(perimeter(look), 6.0, 1e-2);
  EXPECT_EQ(look.boundary.size(), 4U) << "edges that go on are one";
}

TEST(Silhouette, HidesThePartsOfEdgesThatAreShared) {
  // A Z: each box keeps half of the edge it shares.
  const Silhouette look = silhouette({boxAt(0.0, 0.0, 2.0, 1.0), boxAt(1.0, 1.0, 2.0, 1.0)});
  EXPECT_NEAR(perimeter(look), 10.0, 1e-2);
  EXPECT_EQ(look.boundary.size(), 8U);
}

TEST(Silhouette, HidesWhatLiesInsideOfAnOverlappingPiece) {
  // A plus of two bars.
  const Silhouette look = silhouette({boxAt(0.0, 0.0, 3.0, 1.0), boxAt(0.0, 0.0, 1.0, 3.0)});
  EXPECT_NEAR(perimeter(look), 12.0, 1e-2);
}

TEST(Silhouette, KeepsOneOfTwoEdgesThatRunTogether) {
  const Silhouette look = silhouette({boxAt(0.0, 0.0, 2.0, 1.0), boxAt(0.5, 0.0, 2.0, 1.0)});
  EXPECT_NEAR(perimeter(look), 7.0, 1e-2);
}

TEST(Silhouette, HasOnlyTheOutsideOfAGridOfBoxes) {
  std::vector<ConvexShape> shapes;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) shapes.emplace_back(boxAt(0.1 * i, 0.1 * j, 0.1, 0.1));
  }
  const Silhouette look = silhouette(shapes);
  EXPECT_NEAR(perimeter(look), 1.6, 1e-3);
  EXPECT_EQ(look.boundary.size(), 4U);
}

TEST(Silhouette, CutsADiscWhereABarMeetsIt) {
  const Silhouette look = silhouette({boxAt(0.0, 0.0, 4.0, 0.2), Circle{{2.0, 0.0}, 0.5}});
  // The bar ends inside of the disc: its end is hidden, and so is the arc it covers.
  const double arc = 0.5 * (2.0 * std::numbers::pi - 2.0 * std::asin(0.1 / 0.5));
  const double bar = 2.0 * (4.0 - std::sqrt(0.25 - 0.01)) + 0.2;
  EXPECT_NEAR(perimeter(look), arc + bar, 0.01 * (arc + bar));
}

TEST(BodyLooks, TakesTheMedianOfTheDynamicBodies) {
  std::vector<BodyInfo> bodies(4);
  bodies[0].motion = Motion::Pinned;
  bodies[0].shapes = {boxAt(0.0, 0.0, 1000.0, 1000.0)};
  bodies[1].shapes = {boxAt(0.0, 0.0, 2.0, 1.0)};
  bodies[2].shapes = {boxAt(0.0, 0.0, 2.0, 1.0)};
  bodies[3].shapes = {Circle{{0.0, 0.0}, 20.0}};
  EXPECT_NEAR(BodyLooks(bodies).typical_width, 1.0, 1e-9);
}

}  // namespace
}  // namespace merge2d
