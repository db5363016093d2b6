#include "src2d/trace/parameters.h"

#include "src2d/scene/names.h"
#include "src2d/scene/settings_list.h"

namespace merge2d {
namespace {

/// "solver":{…},"merging":{…},…
void writeSettings(JsonText& out, const Settings& settings) {
  std::string_view current;
  forEachSetting(
      settings, [&](std::string_view table, std::string_view key, const auto& value, const Range&) {
        if (table != current) {
          if (!current.empty()) out.close('}');
          out.key(table).open('{');
          current = table;
        }
        if constexpr (HasNames<std::remove_cvref_t<decltype(value)>>) {
          out.field(key, nameOf(value));
        } else {
          out.field(key, value);
        }
      });
  out.close('}');
}

}  // namespace

void writeParameters(JsonText& out, const Scene& scene) {
  out.open('{').field("gravity", scene.gravity).field("step", scene.step);
  out.field("duration", scene.duration).field("seed", scene.seed);
  writeSettings(out, scene.settings);
  out.close('}');
}

}  // namespace merge2d
