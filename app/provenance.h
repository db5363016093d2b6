#pragma once
/// Where numbers come from: everything that is needed to make them again.

#include <string>
#include <utility>
#include <vector>

#include "app/json.h"
#include "src2d/scene/scene.h"

namespace merge2d {

/// The digest of a scene with all its changes: 16 hexadecimal digits over its text.
std::string digestOfScene(const Scene& scene);

/// Gravity, step, duration, seed and every table of settings, defaults included.
Json parametersJson(const Scene& scene);

/// "merging.velocity=0.02;seed=3": the settings that are not the default ones. Empty when all are.
std::string changedParameters(const Scene& scene);

/// {"program", "git", "digest", "seed", "parameters"}; git is null where that is not known.
Json provenanceJson(const Scene& scene);

/// The same as columns of a table, all of them texts: scene, mode, seed, digest, parameters (those
/// that changed), program, git.
std::vector<std::pair<std::string, std::string>> provenanceColumns(const Scene& scene, Mode mode);

}  // namespace merge2d
