#pragma once
/// Outlines of polygons, convex or not, before they are cut into convex pieces.

#include <vector>

#include "src2d/core/vec.h"

namespace merge2d {

/// Which way the path a → b → c turns: 1 to the left, -1 to the right, 0 straight on or back.
/// Sines below 1e-10 count as straight.
int turn(const Vec2& a, const Vec2& b, const Vec2& c);

/// Whether the segments a–b and c–d have a point in common.
bool segmentsMeet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// The vertices at which the outline bends.
std::vector<Vec2> withoutStraightVertices(std::vector<Vec2> points);

/// The same outline counter-clockwise, without repeated and collinear vertices. Throws InputError
/// when it crosses or touches itself, has fewer than three distinct vertices or encloses no area.
/// Edges in messages are numbered from 0; edge k leaves vertex k.
std::vector<Vec2> simpleOutline(const std::vector<Vec2>& outline);

}  // namespace merge2d
