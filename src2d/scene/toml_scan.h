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
  struct Stray {
    std::size_t byte = 0;
    toml::source_position place;
  };
  using Place = std::optional<toml::source_position>;

  std::vector<Bracket> open;   ///< outermost first
  Place unclosed_quote;        ///< where the text begins that has no end
  Place missing_value;         ///< an '=' that nothing follows
  Place too_deep;              ///< where nesting passes the limit
  std::optional<Stray> stray;  ///< a character beyond ASCII outside of texts and comments
};

/// Reads up to line and column `end`, or until the nesting passes `limit`. Dots in keys nest too.
TomlScan scanToml(std::string_view text, const toml::source_position& end, std::size_t limit);

}  // namespace merge2d
