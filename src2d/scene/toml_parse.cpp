#include "src2d/scene/toml_parse.h"

#include <fmt/format.h>

#include "src2d/core/error.h"

namespace merge2d {

toml::table parseToml(const SourceText& source) {
  try {
    return toml::parse(source.text(), std::string_view(source.name()));
  } catch (const toml::parse_error& error) {
    source.fail(error.source(), error.description());
  }
}

}  // namespace merge2d
