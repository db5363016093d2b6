/// The world and the settings of a scene file.

#include <map>

#include "src2d/core/utf8.h"
#include "src2d/scene/interpret.h"
#include "src2d/scene/settings_list.h"

namespace merge2d {
namespace {

constexpr Range kMargin{0.0, 10.0, "between 0 and 10"};

}  // namespace

void readCamera(TableReader& root, Scene& scene, const BodyNames& names) {
  auto camera = root.table("camera");
  if (!camera) return;
  if (const auto body = camera->get("follow")) scene.follow = bodyNamed(*body, scene, names);
  const bool placed = camera->has("center"), sized = camera->has("height");
  if (placed || sized) scene.camera.emplace();
  if (sized && !placed && scene.follow) scene.camera->center = scene.bodies[*scene.follow].at;
  if (placed) camera->read("center", scene.camera->center, kPosition);
  if (sized) camera->read("height", scene.camera->height, kLength);
  camera->read("margin", scene.margin, kMargin);
  camera->done();
}

void readWorld(TableReader& root, Scene& scene) {
  int format = 1;
  root.read("format", format, {1, 1, "1, the only format there is so far"});
  root.read("title", scene.title);
  scene.title = asOneLine(scene.title);  // for terminals, captions and pages
  root.read("gravity", scene.gravity);
  root.read("step", scene.step, kStep);
  root.read("duration", scene.duration, kDuration);
  root.read("seed", scene.seed, kSeed);
}

void readSettings(TableReader& root, Settings& settings) {
  std::map<std::string_view, std::optional<TableReader>> tables;
  forEachSetting(
      settings, [&](std::string_view table, std::string_view key, auto& value, const Range& range) {
        const auto [entry, added] = tables.try_emplace(table);
        if (added) entry->second = root.table(table);
        if (entry->second) entry->second->read(key, value, range);
      });
  for (const auto& [name, table] : tables) {
    if (table) table->done();
  }
}

}  // namespace merge2d
