#pragma once
/// TOML text to a table, with syntax errors that a beginner understands.

#include "src2d/scene/source_text.h"

namespace merge2d {

/// Throws an InputError with the place of the first syntax error, or where lists and tables are
/// nested deeper than `SceneLimits::kNesting`.
toml::table parseToml(const SourceText& source);

}  // namespace merge2d
