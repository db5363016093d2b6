#include "src2d/scene/builtin_title.h"

#include <algorithm>

#include "src2d/scene/toml_parse.h"

namespace merge2d {

std::optional<std::string> titleOf(const DataFolder& folder, const std::string& file,
                                   std::span<const EmbeddedFile> embedded) {
  const std::string text = folder.read(file);
  const auto known = std::ranges::find_if(
      embedded, [&](const EmbeddedFile& one) { return !one.title.empty() && one.text == text; });
  if (known != embedded.end()) return std::string(known->title);
  return parseToml(SourceText(folder.pathOf(file).string(), text))["title"].value<std::string>();
}

}  // namespace merge2d
