/// Shapes and scripts of a body.

#include <fmt/format.h>

#include "src2d/core/error.h"
#include "src2d/scene/interpret.h"

namespace merge2d {
namespace {

constexpr std::array<std::string_view, 3> kShapeKeys{"box", "circle", "polygon"};

std::vector<ConvexShape> polygonShapes(const Value& value) {
  const std::vector<Value> corners = value.elements("[[x, y], …]");
  if (corners.size() > SceneLimits::kVertices) {
    value.fail(fmt::format("a polygon has at most {} corners, this one has {}",
                           SceneLimits::kVertices, corners.size()));
  }
  std::vector<Vec2> outline;
  for (const Value& corner : corners) outline.push_back(corner.vector(kPosition));
  try {
    const std::vector<Polygon> pieces = convexPieces(outline);
    return {pieces.begin(), pieces.end()};
  } catch (const InputError& error) {
    value.fail(error.what());
  }
}

/// The shapes behind the one of box, circle and polygon that a table has; empty when it has none.
std::vector<ConvexShape> readSimpleShape(TableReader& table) {
  std::string_view given;
  for (const std::string_view key : kShapeKeys) {
    if (!table.has(key)) continue;
    if (!given.empty()) {
      table.failAt(key, fmt::format("{} has both '{}' and '{}'; for several shapes write "
                                    "shapes = [{{ … }}, {{ … }}]",
                                    table.title(), given, key));
    }
    given = key;
  }
  if (const auto box = table.get("box")) {
    const Vec2 size = box->vector(kLength, "[width, height]");
    return {makeBox(size.x(), size.y())};
  }
  if (const auto circle = table.get("circle")) {
    return {Circle{Vec2::Zero(), circle->number(kLength)}};
  }
  if (const auto polygon = table.get("polygon")) return polygonShapes(*polygon);
  return {};
}

/// One entry of `shapes`: a simple shape with its place in the body.
std::vector<ConvexShape> readPlacedShape(TableReader table) {
  Vec2 at = Vec2::Zero();
  double angle = 0.0;
  table.read("at", at, kPosition);
  table.readDegrees("angle", angle);
  std::vector<ConvexShape> shapes = readSimpleShape(table);
  table.done();
  if (shapes.empty()) table.fail("a shape needs box, circle or polygon");
  for (ConvexShape& shape : shapes) shape = transformed(shape, Pose::at(at, angle));
  return shapes;
}

Keyframes readKeyframes(const Value& value) {
  Keyframes path;
  for (const Value& row : value.elements("[[t, x, y, degrees], …]")) {
    const std::vector<double> key = row.numbers(4, "[t, x, y, degrees]");
    if (key[0] < 0) row.fail("key frames start at time 0 or later");
    if (!path.keys.empty() && key[0] <= path.keys.back().time) {
      row.fail(fmt::format("the times of key frames must increase, but {} follows {}", key[0],
                           path.keys.back().time));
    }
    path.keys.push_back({key[0], {key[1], key[2]}, radians(key[3])});
  }
  if (path.keys.empty()) value.fail("a script needs at least one key frame");
  return path;
}

Sinusoid readSinusoid(TableReader& table) {
  Sinusoid sinusoid;
  if (table.require("axis")) table.read("axis", sinusoid.axis);
  if (table.require("amplitude")) table.read("amplitude", sinusoid.amplitude);
  if (table.require("period")) table.read("period", sinusoid.period, kPositive);
  return sinusoid;
}

}  // namespace

std::vector<ConvexShape> readShapes(TableReader& table) {
  std::vector<ConvexShape> shapes = readSimpleShape(table);
  const auto list = table.get("shapes");
  if (!list) return shapes;
  if (!shapes.empty()) list->fail("'shapes' stands alone, without box, circle or polygon");
  for (const Value& entry : list->elements("[{ … }, …]")) {
    const std::vector<ConvexShape> pieces = readPlacedShape(entry.table());
    shapes.insert(shapes.end(), pieces.begin(), pieces.end());
    if (shapes.size() > SceneLimits::kShapesPerBody) {
      list->fail(fmt::format("a body has at most {} shapes", SceneLimits::kShapesPerBody));
    }
  }
  return shapes;
}

std::optional<Script> readScript(TableReader& body) {
  const auto value = body.get("script");
  if (!value) return std::nullopt;
  TableReader table = value->table();
  std::optional<Script> script;
  const bool steady = table.has("velocity") || table.has("spin");
  if (const auto keyframes = table.get("keyframes")) {
    script = readKeyframes(*keyframes);
  } else if (steady) {
    SteadyMotion motion;
    table.read("velocity", motion.velocity);
    table.readDegrees("spin", motion.spin);
    script = motion;
  } else {
    script = readSinusoid(table);
  }
  table.done();
  return script;
}

}  // namespace merge2d
