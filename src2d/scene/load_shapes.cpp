/// Shapes and scripts of a body.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src2d/core/error.h"
#include "src2d/geometry/box.h"
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
  for (const Value& corner : corners) outline.push_back(corner.vector(kCorner));
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
  const bool placed = at != Vec2::Zero() || angle != 0.0;
  for (ConvexShape& shape : shapes) {
    if (placed) shape = transformed(shape, Pose::at(at, angle));
    const Aabb box = bounds(shape);
    const double reach = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    if (reach > kCorner.upper) table.fail("a shape reaches further than 4e6 m from its body");
  }
  return shapes;
}

Keyframes readKeyframes(const Value& value) {
  Keyframes path;
  for (const Value& row : value.elements("[[t, x, y, degrees], …]")) {
    const std::vector<double> key = row.numbers(4, "[t, x, y, degrees]");
    const Keyframes::Key next{key[0], {key[1], key[2]}, radians(key[3])};
    const Verdict verdict = judgeKey(next, path.keys.empty() ? nullptr : &path.keys.back());
    if (verdict) row.fail(verdict->sentence);
    path.keys.push_back(next);
  }
  if (path.keys.empty()) value.fail("a script needs at least one key frame");
  return path;
}

Sinusoid readSinusoid(TableReader& table) {
  Sinusoid sinusoid;
  table.read("axis", sinusoid.axis);
  table.read("amplitude", sinusoid.amplitude);
  table.read("period", sinusoid.period, kPositive);
  if (table.has("axis") && sinusoid.axis == Vec2::Zero()) {
    table.failAt("axis", "'axis' must not be [0, 0]: it tells in which direction the body moves");
  }
  return sinusoid;
}

SteadyMotion readSteadyMotion(TableReader& table) {
  SteadyMotion motion;
  table.read("velocity", motion.velocity);
  table.readDegrees("spin", motion.spin);
  return motion;
}

/// One kind of script, which is told by its keys.
struct ScriptKind {
  std::vector<std::string_view> keys;
  bool all;  ///< whether it needs all of them, or only one
  Script (*read)(TableReader&);
};

const std::vector<ScriptKind>& scriptKinds() {
  static const std::vector<ScriptKind> kinds{
      {{"axis", "amplitude", "period"},
       true,
       [](TableReader& table) -> Script { return readSinusoid(table); }},
      {{"keyframes"},
       true,
       [](TableReader& table) -> Script { return readKeyframes(*table.get("keyframes")); }},
      {{"velocity", "spin"}, false, [](TableReader& table) -> Script {
         return readSteadyMotion(table);
       }}};
  return kinds;
}

constexpr std::string_view kScriptKinds =
    "a script has 'axis', 'amplitude' and 'period', or 'keyframes', or 'velocity' and 'spin'";

/// The kind whose keys the table has; whoever mixes two, or leaves some out, is told of all kinds.
const ScriptKind& kindOf(TableReader& table) {
  const ScriptKind* kind = nullptr;
  std::string_view first, missing;
  for (const ScriptKind& candidate : scriptKinds()) {
    for (const std::string_view key : candidate.keys) {
      if (!table.has(key)) continue;
      if (kind != nullptr && kind != &candidate) {
        table.failAt(key, fmt::format("'{}' and '{}' belong to different kinds of script: {}",
                                      first, key, kScriptKinds));
      }
      if (kind == nullptr) first = key;
      kind = &candidate;
    }
  }
  table.done();
  if (kind == nullptr) table.fail(fmt::format("the script is empty: {}", kScriptKinds));
  for (const std::string_view key : kind->keys) {
    if (!table.has(key) && missing.empty()) missing = key;
  }
  if (kind->all && !missing.empty()) {
    table.fail(fmt::format("a script with '{}' needs '{}' too: {}", first, missing, kScriptKinds));
  }
  return *kind;
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
  TableReader table = value->table("a table, such as { velocity = [1, 0] }");
  return kindOf(table).read(table);
}

}  // namespace merge2d
