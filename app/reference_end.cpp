#include "app/reference_end.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "app/json.h"
#include "app/output_file.h"
#include "app/version.h"
#include "src2d/core/digest.h"
#include "src2d/scene/load.h"

namespace merge2d {
namespace {

constexpr const char* kEndFormat = "merge2d-reference-end";

/// Identifies a reference run: the scene without the settings that the reference does not read, its
/// length, and the program.
std::string keyOf(Scene scene, std::int64_t steps) {
  scene.settings.merging = {};
  scene.settings.unmerging = {};
  scene.settings.sleeping = {};
  return fmt::format("{:016x}", digestOf(fmt::format("{}\n{}\n{} {}", toToml(scene), steps,
                                                     MERGE2D_VERSION, kGitDescribe)));
}

/// Nothing where the file is missing, damaged or of another kind.
std::optional<BodyCenters> readEnd(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return std::nullopt;
  const Json json = Json::parse(in, nullptr, false);
  if (!json.is_object() || json.value("format", Json()) != kEndFormat) return std::nullopt;
  BodyCenters end;
  for (const Json& row : json.value("bodies", Json::array())) {
    if (!row.is_array() || row.size() != 3) return std::nullopt;
    for (const Json& number : row) {
      if (!number.is_number()) return std::nullopt;
    }
    end.bodies.push_back(
        {BodyId(row[0].get<std::uint32_t>()), {row[1].get<double>(), row[2].get<double>()}});
  }
  return end;
}

}  // namespace

BodyCenters centersOf(const World& world) {
  Snapshot snapshot;
  world.capture(snapshot);
  BodyCenters centers;
  for (const BodyState& body : snapshot.bodies) {
    if (world.bodies()[index(body.id)].motion != Motion::Dynamic) continue;
    centers.bodies.push_back({body.id, body.x});
  }
  return centers;
}

ReferenceError errorBetween(const BodyCenters& reference, const BodyCenters& run) {
  ReferenceError error;
  std::size_t both = 0;
  auto there = run.bodies.begin();
  for (const BodyCenters::One& here : reference.bodies) {
    while (there != run.bodies.end() && there->id < here.id) ++there;
    if (there == run.bodies.end()) break;
    if (there->id != here.id) continue;
    const double distance = (there->x - here.x).norm();
    error.mean += distance;
    error.max = std::max(error.max, distance);
    ++both;
  }
  if (both > 0) error.mean /= static_cast<double>(both);
  return error;
}

std::filesystem::path ReferenceFolder::fileOf(const Scene& scene, std::int64_t steps) const {
  return folder_ / (keyOf(scene, steps) + ".json");
}

BodyCenters ReferenceFolder::endOf(const std::shared_ptr<const Scene>& scene,
                                   std::int64_t steps) const {
  if (!folder_.empty()) {
    if (auto end = readEnd(fileOf(*scene, steps))) return *std::move(end);
  }
  Simulation reference(scene, {.mode = Mode::Reference});
  for (std::int64_t i = 0; i < steps; ++i) reference.step();
  BodyCenters end = centersOf(reference.world());
  keep(*scene, steps, end);
  return end;
}

void ReferenceFolder::keep(const Scene& scene, std::int64_t steps, const BodyCenters& end) const {
  if (folder_.empty()) return;
  const std::filesystem::path file = fileOf(scene, steps);
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored) && readEnd(file)) return;
  Json json;
  json["format"] = kEndFormat;
  json["scene"] = scene.name;
  json["steps"] = steps;
  json["columns"] = {"id", "x", "y"};
  json["bodies"] = Json::array();
  for (const BodyCenters::One& one : end.bodies) {
    json["bodies"].push_back({index(one.id), one.x.x(), one.x.y()});
  }
  writeFile(file.string(), json.dump() + "\n", {.everything = true});
}

}  // namespace merge2d
