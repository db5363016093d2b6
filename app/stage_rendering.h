#pragma once
/// `render --stages`: the eleven stages of one time step, a picture each.

#include "app/render_options.h"

namespace merge2d {

inline constexpr int kSheetCell = 640;  ///< width of a picture in a contact sheet, at most [px]

/// Pictures, their captions and, when asked for, a contact sheet, into the folder `stages`. Throws
/// SimulationError, IoError.
void renderStages(const RenderOptions& options);

}  // namespace merge2d
