/// [[body]] of a scene file.

#include <fmt/format.h>

#include "src2d/scene/interpret.h"

namespace merge2d {
namespace {

/// repeat = { count = [columns, rows], spacing = [x, y], stagger = 0.5 }
struct Repeat {
  std::int64_t columns = 1;
  std::int64_t rows = 1;
  Vec2 spacing = Vec2::Zero();  ///< [m]
  double stagger = 0.0;         ///< shift of every other row, in columns

  Vec2 offset(std::int64_t column, std::int64_t row) const {
    const double shift = row % 2 == 1 ? stagger : 0.0;
    return {(static_cast<double>(column) + shift) * spacing.x(),
            static_cast<double>(row) * spacing.y()};
  }
};

std::optional<Repeat> readRepeat(TableReader& body) {
  const auto value = body.get("repeat");
  if (!value) return std::nullopt;
  TableReader table = value->table();
  Repeat repeat;
  if (const auto count = table.require("count")) {
    const std::vector<Value> both = count->elements("[columns, rows]");
    if (both.size() != 2) count->failMustBe("[columns, rows]");
    constexpr Range kCopies{1, static_cast<double>(SceneLimits::kBodies), "between 1 and 100000"};
    repeat.columns = both[0].integer(kCopies);
    repeat.rows = both[1].integer(kCopies);
  }
  if (table.require("spacing")) table.read("spacing", repeat.spacing, kPosition);
  table.read("stagger", repeat.stagger);
  table.done();
  return repeat;
}

/// Adds bodies to the scene, each under a name of its own.
class BodyList {
 public:
  explicit BodyList(Scene& scene) : scene_(scene) {}

  void add(const TableReader& table, const BodyDesc& body) {
    const auto [first, added] = names_.emplace(body.name, scene_.bodies.size());
    if (!added) failTwice(table, body.name, *homes_[first->second]);
    if (body.at.cwiseAbs().maxCoeff() > SceneLimits::kCoordinate) {
      table.failAt(table.holds("repeat") ? "repeat" : "at",
                   fmt::format("'{}' stands further than 1e6 m from the origin", body.name));
    }
    scene_.bodies.push_back(body);
    homes_.push_back(&table);
  }

  void addCopies(const TableReader& table, const BodyDesc& body, const Repeat& repeat) {
    for (std::int64_t row = 0; row < repeat.rows; ++row) {
      for (std::int64_t column = 0; column < repeat.columns; ++column) {
        BodyDesc copy = body;
        copy.name = fmt::format("{}[{},{}]", body.name, column, row);
        copy.at += repeat.offset(column, row);
        add(table, copy);
      }
    }
  }

  void checkRoom(const TableReader& table) const {
    if (scene_.bodies.size() == SceneLimits::kBodies) {
      table.fail(fmt::format("a scene has at most {} bodies", SceneLimits::kBodies));
    }
  }

  void checkRoom(const TableReader& table, const Repeat& repeat) const {
    const auto copies = static_cast<std::size_t>(repeat.columns * repeat.rows);
    const std::size_t all = scene_.bodies.size() + copies;
    if (all <= SceneLimits::kBodies) return;
    table.failAt("repeat", fmt::format("{} x {} copies make {} bodies in all, but a scene has at "
                                       "most {}",
                                       repeat.columns, repeat.rows, all, SceneLimits::kBodies));
  }

  BodyNames names() && { return std::move(names_); }

 private:
  [[noreturn]] static void failTwice(const TableReader& table, const std::string& name,
                                     const TableReader& first) {
    const std::string place = first.whereIs("name");
    if (!table.holds("name")) {
      table.fail(
          fmt::format("a body without a name is called '{}' here, but so is the one in {}: name it",
                      name, place));
    }
    table.failAt("name",
                 fmt::format("two bodies are called '{}': the first is in {}", name, place));
  }

  Scene& scene_;
  BodyNames names_;
  std::vector<const TableReader*> homes_;  ///< of each body; they outlive the list
};

void addBody(TableReader& table, BodyList& list, const BodyDesc& defaults) {
  const BodyDesc body = readBody(table, defaults);
  const std::optional<Repeat> repeat = readRepeat(table);
  table.done();
  checkBody(table, body);
  if (!repeat) {
    list.checkRoom(table);
    return list.add(table, body);
  }
  list.checkRoom(table, *repeat);
  if (body.script && std::holds_alternative<Keyframes>(*body.script)) {
    table.failAt("repeat", "key frames are places in the world, so all copies would be in one");
  }
  list.addCopies(table, body, *repeat);
}

}  // namespace

BodyDesc defaultBody(const Material& material) {
  BodyDesc body;
  body.density = material.density;
  body.friction = material.friction;
  body.restitution = material.restitution;
  body.rolling = material.rolling;
  return body;
}

BodyDesc readBody(TableReader& table, const BodyDesc& defaults) {
  BodyDesc body = defaults;
  if (const auto name = table.get("name")) checkName(*name, body.name = name->text());
  table.read("motion", body.motion);
  table.read("at", body.at, kPosition);
  table.readDegrees("angle", body.angle);
  table.read("velocity", body.velocity);
  table.readDegrees("spin", body.spin);
  body.shapes = readShapes(table);
  if (const auto mass = table.get("mass")) body.mass = mass->number(kPositive);
  table.read("density", body.density, kPositive);
  table.read("friction", body.friction, kNotNegative);
  table.read("restitution", body.restitution, kFraction);
  table.read("rolling", body.rolling, kNotNegative);
  table.read("surface_velocity", body.surface_velocity);
  table.read("pinned_until", body.pinned_until, kNotNegative);
  body.script = readScript(table);
  if (!body.script) return body;
  if (const auto* path = std::get_if<Keyframes>(&*body.script)) {
    if (table.has("at")) table.failAt("at", "the key frames say where the body is, not 'at'");
    if (table.has("angle")) table.failAt("angle", "the key frames say the angle, not 'angle'");
    body.at = path->keys.front().position;
    body.angle = path->keys.front().angle;
  }
  return body;
}

void checkBody(const TableReader& table, const BodyDesc& body) {
  if (body.shapes.empty()) {
    table.fail(fmt::format("{} needs a shape: box, circle, polygon or shapes", table.title()));
  }
  obey(table, judgeBody(body));
}

void obey(const TableReader& table, const Verdict& verdict) {
  if (verdict) table.failAt(verdict->key, verdict->sentence);
}

BodyNames readBodies(TableReader& root, Scene& scene) {
  BodyList list(scene);
  BodyDesc defaults = defaultBody(scene.settings.material);
  int number = 0;
  for (TableReader& table : root.tables("body")) {
    defaults.name = fmt::format("body{}", ++number);
    addBody(table, list, defaults);
  }
  return std::move(list).names();
}

}  // namespace merge2d
