#pragma once
/// The state of a world as bytes: a run continues from them as if it had never stopped.
///
/// Format: "merge2d-state", version of the format, fingerprint of the fields that a state has and
/// of the scene, mode, state, checksum. Only a program with the same fields reads such a file.

#include <string>
#include <string_view>

#include "src2d/dynamics/setup.h"

namespace merge2d {

/// How the bytes begin.
inline constexpr std::string_view kStateStart = "merge2d-state";

/// Everything that influences the steps to come.
std::string saveState(const Scene& scene, const Setup& setup);

/// Brings a fresh setup of the same scene to the saved state. `source` names the bytes in messages.
/// Throws InputError when they are damaged, or of another version, scene or mode.
void restoreState(std::string_view bytes, const std::string& source, const Scene& scene,
                  Setup& setup);

}  // namespace merge2d
