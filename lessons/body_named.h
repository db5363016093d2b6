#pragma once
/// The bodies that a lesson speaks of.

#include <string_view>

#include "src2d/core/ids.h"
#include "src2d/scene/scene.h"
#include "src2d/scene/toml_reader.h"

namespace merge2d {

/// The scene's body of that name. Throws an InputError at `place`, with the name that may be meant.
BodyId bodyNamed(const Value& place, const Scene& scene, std::string_view wanted);

}  // namespace merge2d
