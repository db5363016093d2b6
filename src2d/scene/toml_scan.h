#pragma once
/// A quick look at TOML text before and beside the parser: how deep it nests, and which brackets
/// and quotes stand open at some place.

#include <optional>
#include <string_view>
#include <vector>

#include "src2d/scene/toml.h"

namespace merge2d {

struct TomlScan {
  struct Bracket {
    char opening = '[';
    toml::source_position place;
  };
  std::vector<Bracket> open;  ///< outermost first
  std::optional<toml::source_position> unclosed_quote;
  std::optional<toml::source_position> missing_value;  ///< after an '=' where none follows
  std::optional<toml::source_position> too_deep;       ///< where nesting passes the limit
};

/// Reads up to line and column `end`, or until the nesting passes `limit`. Dots in keys nest too.
TomlScan scanToml(std::string_view text, const toml::source_position& end, std::size_t limit);

}  // namespace merge2d
