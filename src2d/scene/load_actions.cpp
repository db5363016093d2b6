/// Actions on bodies: [[spring]], [[impulse]], [[force]] and [[magnet]] of a scene file.

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
    obey(table, judgeTimes("a force", force.from, force.until));
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
    const auto [first, added] = magnets_.emplace(magnet.body, table.whereIs("body"));
    if (!added) {
      table.failAt("body", fmt::format("'{}' is a magnet already, by {}: write all its times "
                                       "there, on = [[0, 2], [4, 6]]",
                                       scene_.bodies[magnet.body].name, first->second));
    }
    scene_.magnets.push_back(magnet);
  }

 private:
  BodyIndex body(const std::optional<Value>& value) const {
    return value ? bodyNamed(*value, scene_, names_) : 0;  // missing, which `done` reports
  }

  void checkMoves(const TableReader& table, BodyIndex index, std::string_view what) const {
    obey(table, judgeMoves(what, scene_.bodies[index]));
  }

  void checkEnds(TableReader& table, const SpringDesc& spring) const {
    const bool to_world = table.has("to");
    if (to_world && spring.to_body) {
      table.failAt("to",
                   "a spring ends at a point ('to') or at a body ('to_body'), not at both; "
                   "'to_anchor' is the point of that body");
    }
    if (!to_world && !spring.to_body) {
      table.fail("[[spring]] needs one other end: 'to' (a point) or 'to_body' and 'to_anchor'");
    }
    if (to_world && table.has("to_anchor")) {
      table.failAt("to_anchor", "'to_anchor' is a point of 'to_body', which is missing");
    }
    if (spring.to_body == spring.body) {
      table.failAt("to_body", "both ends of the spring are on the same body");
    }
    if (!spring.to_body || !moves(scene_.bodies[*spring.to_body]))
      checkMoves(table, spring.body, "a spring");
  }

  static std::vector<MagnetDesc::Interval> intervals(const Value& on) {
    std::vector<MagnetDesc::Interval> result;
    for (const Value& row : on.elements("[[from, until], …]")) {
      const std::vector<double> ends = row.numbers(2, "a pair, as in on = [[0, 2], [4, 6]]");
      const MagnetDesc::Interval next{ends[0], ends[1]};
      const Verdict verdict = judgeInterval(next, result.empty() ? nullptr : &result.back());
      if (verdict) row.fail(verdict->sentence);
      result.push_back(next);
    }
    if (result.empty()) {
      on.fail("this magnet is never on: write on = [[from, until]], or leave 'on' out for always");
    }
    return result;
  }

  Scene& scene_;
  const BodyNames& names_;
  std::unordered_map<BodyIndex, std::string> magnets_;  ///< where each became one
};

}  // namespace

void readActions(TableReader& root, Scene& scene, const BodyNames& names) {
  ActionReader reader(scene, names);
  for (TableReader& table : root.tables("spring")) reader.spring(table);
  for (TableReader& table : root.tables("impulse")) reader.impulse(table);
  for (TableReader& table : root.tables("force")) reader.force(table);
  for (TableReader& table : root.tables("magnet")) reader.magnet(table);
}

}  // namespace merge2d
