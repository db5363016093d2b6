#pragma once
/// `--set key=value`: changes to a parsed scene file before it is interpreted.

#include "src2d/scene/load.h"
#include "src2d/scene/source_text.h"

namespace merge2d {

/// Sets one key of `scene`. `merging.velocity` goes through tables, which are created when missing;
/// `body[3].mass` and `body.platform.mass` (also of springs, emitters, …) choose one of an array of
/// tables by number from 0 or by name. What it writes carries `--set key=value` as its place, so
/// that later errors name it. Throws an InputError.
void applyOverride(toml::table& scene, const std::string& key, const std::string& value);

}  // namespace merge2d
