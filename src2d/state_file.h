#pragma once
/// The state of a world as bytes: a run continues from them as if it had never stopped.
///
/// Format: "merge2d-state", version of the format, fingerprints of the fields that a state has, of
/// the scene and of its settings, mode, bodies added to the scene, state, checksum. Only a program
/// with the same fields reads such a file.

#include <string>
#include <string_view>

#include "src2d/setup.h"
#include "src2d/world.h"

namespace merge2d {

/// How the bytes begin.
inline constexpr std::string_view kStateStart = "merge2d-state";

/// Everything that influences the steps to come.
std::string saveState(const Scene& scene, const Setup& setup);

/// Brings a setup of the same scene to the saved state; settings and gravity stay as they are.
/// Returns the mode that the state was saved in. `source` names the bytes in messages. Throws
/// InputError when they are damaged, or of another version, scene, settings or mode; the setup may
/// then be that of the scene's start.
Mode restoreState(std::string_view bytes, const std::string& source, const Scene& scene,
                  Setup& setup, SavedUnder under = SavedUnder::SameSettings);

}  // namespace merge2d
