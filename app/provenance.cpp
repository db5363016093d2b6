#include "app/provenance.h"

#include <fmt/format.h>

#include "app/version.h"
#include "src2d/core/digest.h"
#include "src2d/scene/load.h"
#include "src2d/scene/names.h"
#include "src2d/scene/settings_list.h"
#include "src2d/trace/parameters.h"

namespace merge2d {
namespace {

constexpr const char* kProgram = "merge2d " MERGE2D_VERSION;

/// The text of every setting by "table.key".
std::vector<std::pair<std::string, std::string>> settingTexts(const Settings& settings) {
  std::vector<std::pair<std::string, std::string>> all;
  forEachSetting(
      settings, [&](std::string_view table, std::string_view key, const auto& value, const Range&) {
        std::string text;
        if constexpr (HasNames<std::remove_cvref_t<decltype(value)>>) {
          text = nameOf(value);
        } else {
          text = fmt::format("{}", value);
        }
        all.emplace_back(fmt::format("{}.{}", table, key), text);
      });
  return all;
}

}  // namespace

std::string digestOfScene(const Scene& scene) {
  return fmt::format("{:016x}", digestOf(toToml(scene)));
}

Json parametersJson(const Scene& scene) {
  JsonText text;
  writeParameters(text, scene);
  return Json::parse(text.text());
}

std::string changedParameters(const Scene& scene) {
  const Scene plain;
  std::string out;
  const auto add = [&](const std::string& key, const std::string& value) {
    out += fmt::format("{}{}={}", out.empty() ? "" : ";", key, value);
  };
  if (scene.gravity != plain.gravity) {
    add("gravity", fmt::format("[{}, {}]", scene.gravity.x(), scene.gravity.y()));
  }
  if (scene.step != plain.step) add("step", fmt::format("{}", scene.step));
  if (scene.duration != plain.duration) add("duration", fmt::format("{}", scene.duration));
  const auto all = settingTexts(scene.settings), defaults = settingTexts(plain.settings);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].second != defaults[i].second) add(all[i].first, all[i].second);
  }
  return out;
}

Json provenanceJson(const Scene& scene) {
  Json out;
  out["program"] = kProgram;
  out["git"] = *kGitDescribe == '\0' ? Json() : Json(kGitDescribe);
  out["digest"] = digestOfScene(scene);
  out["seed"] = scene.seed;
  out["parameters"] = parametersJson(scene);
  return out;
}

std::vector<std::pair<std::string, std::string>> provenanceColumns(const Scene& scene, Mode mode) {
  return {{"scene", scene.name},
          {"mode", std::string(nameOf(mode))},
          {"seed", fmt::format("{}", scene.seed)},
          {"digest", digestOfScene(scene)},
          {"parameters", changedParameters(scene)},
          {"program", kProgram},
          {"git", kGitDescribe}};
}

}  // namespace merge2d
