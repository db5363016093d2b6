#include "api/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "src2d/core/error.h"
#include "src2d/core/suggest.h"
#include "src2d/scene/load.h"
#include "src2d/scene/names.h"
#include "src2d/scene/settings_list.h"

namespace merge2d {
namespace {

constexpr std::string_view kOfTheScene[] = {"title", "gravity", "step", "duration", "seed"};

std::vector<std::string> settingNames() {
  std::vector<std::string> names;
  Settings settings;
  forEachSetting(settings,
                 [&](std::string_view table, std::string_view key, const auto&, const Range&) {
                   names.push_back(fmt::format("{}.{}", table, key));
                 });
  return names;
}

[[noreturn]] void refuseKey(const std::string& key, const std::vector<std::string>& names) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  throw InputError(fmt::format("there is no setting '{}'{}", key, didYouMean(key, views)));
}

/// A world has functions of its own for some keys of its scene.
[[noreturn]] void refuseKeyOfTheScene(const std::string& key) {
  std::string instead;
  if (key == "step") instead = ": set its time step instead";
  if (key == "gravity") instead = ": set its gravity instead";
  throw InputError(fmt::format("'{}' is of the scene, not a setting of a world{}", key, instead));
}

void requireKey(const std::string& key, bool of_scene) {
  std::vector<std::string> names = settingNames();
  const auto* end = std::end(kOfTheScene);
  if (!of_scene && std::find(std::begin(kOfTheScene), end, key) != end) refuseKeyOfTheScene(key);
  if (of_scene) names.insert(names.end(), std::begin(kOfTheScene), std::end(kOfTheScene));
  if (std::find(names.begin(), names.end(), key) == names.end()) refuseKey(key, names);
}

/// A scene file of settings alone, read again with the change: one place judges values.
Scene changed(const Scene& scene, const std::string& key, const std::string& value) {
  Scene small;
  small.title = scene.title;
  small.gravity = scene.gravity;
  small.step = scene.step;
  small.duration = scene.duration;
  small.seed = scene.seed;
  small.settings = scene.settings;
  small.bodies.emplace_back().shapes = {Circle{}};
  return parseScene(toToml(small), "scene", {{key, value}});
}

std::string shown(double number) { return fmt::format("{}", number); }
std::string shown(int number) { return fmt::format("{}", number); }
std::string shown(bool on) { return on ? "true" : "false"; }
template <HasNames E>
std::string shown(E word) {
  return std::string(nameOf(word));
}

}  // namespace

void setByName(Scene& scene, const std::string& key, const std::string& value) {
  requireKey(key, true);
  const Scene read = changed(scene, key, value);
  scene.title = read.title;
  scene.gravity = read.gravity;
  scene.step = read.step;
  scene.duration = read.duration;
  scene.seed = read.seed;
  scene.settings = read.settings;
}

void setByName(Settings& settings, const std::string& key, const std::string& value) {
  requireKey(key, false);
  Scene scene;
  scene.settings = settings;
  settings = changed(scene, key, value).settings;
}

std::string getByName(const Settings& settings, const std::string& wanted) {
  requireKey(wanted, false);
  std::string found;
  forEachSetting(
      settings, [&](std::string_view table, std::string_view key, const auto& value, const Range&) {
        if (wanted == fmt::format("{}.{}", table, key)) found = shown(value);
      });
  return found;
}

std::string getByName(const Scene& scene, const std::string& key) {
  requireKey(key, true);
  if (key == "title") return scene.title;
  if (key == "gravity") return fmt::format("[{}, {}]", scene.gravity.x(), scene.gravity.y());
  if (key == "step") return shown(scene.step);
  if (key == "duration") return shown(scene.duration);
  if (key == "seed") return fmt::format("{}", scene.seed);
  return getByName(scene.settings, key);
}

}  // namespace merge2d
