/// What acts on bodies: [[spring]], [[impulse]], [[force]] and [[magnet]] of a scene file.

#include <fmt/format.h>

#include "src2d/scene/interpret.h"

namespace merge2d {
namespace {

/// Reads the actions of one scene, whose bodies are known by now.
class ActionReader {
 public:
  ActionReader(Scene& scene, const BodyNames& names) : scene_(scene), names_(names) {}

  void spring(TableReader& table) {
    SpringDesc spring;
    spring.body = body(table.require("body"));
    table.read("anchor", spring.anchor, kPosition);
    table.read("to", spring.to, kPosition);
    if (const auto other = table.get("to_body")) spring.to_body = body(other);
    if (const auto anchor = table.get("to_anchor")) spring.to = anchor->vector(kPosition);
    if (table.require("stiffness")) table.read("stiffness", spring.stiffness, kNotNegative);
    table.read("damping", spring.damping, kNotNegative);
    table.read("rest_length", spring.rest_length, kNotNegative);
    table.done();
    checkEnds(table, spring);
    scene_.springs.push_back(spring);
  }

  void impulse(TableReader& table) {
    ImpulseDesc impulse;
    impulse.body = body(table.require("body"));
    if (table.require("at")) table.read("at", impulse.at, kPosition);
    if (table.require("impulse")) table.read("impulse", impulse.impulse);
    table.read("time", impulse.time, kNotNegative);
    table.done();
    checkMoves(table, impulse.body, "an impulse");
    scene_.impulses.push_back(impulse);
  }

  void force(TableReader& table) {
    ForceDesc force;
    force.body = body(table.require("body"));
    table.read("at", force.at, kPosition);
    if (table.require("force")) table.read("force", force.force);
    table.read("from", force.from, kNotNegative);
    table.read("until", force.until, kNotNegative);
    table.done();
    if (force.until <= force.from) table.fail("a force must end after it begins");
    checkMoves(table, force.body, "a force");
    scene_.forces.push_back(force);
  }

  void magnet(TableReader& table) {
    MagnetDesc magnet;
    magnet.body = body(table.require("body"));
    const auto on = table.get("on");
    if (!on) magnet.on.emplace_back();
    if (on) magnet.on = intervals(*on);
    table.done();
    scene_.magnets.push_back(magnet);
  }

 private:
  BodyIndex body(const std::optional<Value>& value) const {
    return value ? bodyNamed(*value, scene_, names_) : 0;  // missing, which `done` reports
  }

  bool moves(BodyIndex index) const { return scene_.bodies[index].motion == Motion::Dynamic; }

  void checkMoves(const TableReader& table, BodyIndex index, std::string_view what) const {
    if (moves(index)) return;
    const BodyDesc& body = scene_.bodies[index];
    table.failAt("body", fmt::format("{} has no effect on '{}', which is {}", what, body.name,
                                     nameOf(body.motion)));
  }

  void checkEnds(TableReader& table, const SpringDesc& spring) const {
    const bool to_world = table.has("to");
    if (to_world == spring.to_body.has_value()) {
      table.fail("[[spring]] needs one other end: 'to' (a point) or 'to_body' and 'to_anchor'");
    }
    if (to_world && table.has("to_anchor")) {
      table.failAt("to_anchor", "'to_anchor' is a point of 'to_body', which is missing");
    }
    if (spring.to_body == spring.body) {
      table.failAt("to_body", "both ends of the spring are on the same body");
    }
    if (!spring.to_body || !moves(*spring.to_body)) checkMoves(table, spring.body, "a spring");
  }

  static std::vector<MagnetDesc::Interval> intervals(const Value& on) {
    std::vector<MagnetDesc::Interval> result;
    for (const Value& row : on.elements("[[from, until], …]")) {
      const std::vector<double> ends = row.numbers(2, "[from, until]");
      const double earliest = result.empty() ? 0.0 : result.back().until;
      if (ends[0] < earliest || ends[1] <= ends[0]) {
        row.fail("the intervals of a magnet must increase from time 0, without overlap");
      }
      result.push_back({ends[0], ends[1]});
    }
    return result;
  }

  Scene& scene_;
  const BodyNames& names_;
};

}  // namespace

BodyIndex bodyNamed(const Value& value, const Scene& scene, const BodyNames& names) {
  const std::string name = value.text();
  const auto found = names.find(name);
  if (found != names.end()) return found->second;
  if (names.contains(name + "[0,0]")) {
    value.fail(fmt::format("'{0}' is repeated: say which copy, such as '{0}[0,0]'", name));
  }
  std::vector<std::string_view> all;
  for (const BodyDesc& candidate : scene.bodies) all.push_back(candidate.name);
  value.fail(fmt::format("no body is called '{}'{}", name, didYouMean(name, all)));
}

void readActions(TableReader& root, Scene& scene, const BodyNames& names) {
  ActionReader reader(scene, names);
  for (TableReader& table : root.tables("spring")) reader.spring(table);
  for (TableReader& table : root.tables("impulse")) reader.impulse(table);
  for (TableReader& table : root.tables("force")) reader.force(table);
  for (TableReader& table : root.tables("magnet")) reader.magnet(table);
}

}  // namespace merge2d
