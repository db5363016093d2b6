#pragma once
/// The looks of a body that never change, computed once per run.

#include <vector>

#include "src2d/trace/snapshot.h"

namespace merge2d {

/// One convex shape of a body, in the body's frame.
struct Piece {
  enum class Kind { Disc, Box, Polygon };
  Kind kind = Kind::Disc;
  Pose frame{};                  ///< centre; of a box also its axes
  Vec2 half = Vec2::Zero();      ///< of a box [m]
  double radius = 0.0;           ///< of a disc; of the others about `frame` [m]
  std::vector<Vec2> vertices{};  ///< of boxes and polygons, counter-clockwise [m]
};

struct Segment {
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();
};

struct Silhouette {
  std::vector<Piece> pieces;
  /// The boundary of the union of several pieces, without the seams between them; empty for one.
  std::vector<Segment> boundary;
  double radius = 0.0;  ///< of the circle about the body's origin that holds it [m]
  double area = 0.0;    ///< [m²]
  double width = 0.0;   ///< of the body where it is thinnest, roughly [m]
};

Silhouette silhouette(const std::vector<ConvexShape>& shapes);

/// The looks of all bodies of a run.
struct BodyLooks {
  std::vector<Silhouette> silhouettes;  ///< by id
  double typical_width = 1.0;           ///< median of the dynamic bodies [m]

  explicit BodyLooks(const std::vector<BodyInfo>& bodies);
};

}  // namespace merge2d
