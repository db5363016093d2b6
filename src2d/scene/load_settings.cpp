/// The world and the settings of a scene file.

#include <map>

#include "src2d/core/utf8.h"
#include "src2d/scene/interpret.h"
#include "src2d/scene/settings_list.h"

namespace merge2d {
namespace {

void readCamera(TableReader camera, Scene& scene) {
  scene.camera.emplace();
  camera.read("center", scene.camera->center, kPosition);
  camera.read("height", scene.camera->height, kLength);
  camera.done();
}

}  // namespace

void readWorld(TableReader& root, Scene& scene) {
  int format = 1;
  root.read("format", format, {1, 1, "1, the only format there is so far"});
  root.read("title", scene.title);
  scene.title = asOneLine(scene.title);  // for terminals, captions and pages
  root.read("gravity", scene.gravity);
  root.read("step", scene.step, kStep);
  root.read("duration", scene.duration, kDuration);
  root.read("seed", scene.seed, kSeed);
  if (const auto camera = root.table("camera")) readCamera(*camera, scene);
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
