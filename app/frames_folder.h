#pragma once
/// The folder a rendering goes to, and what else is in it.

#include <filesystem>

#include "app/console.h"
#include "app/run_file.h"

namespace merge2d {

/// The frames of an earlier rendering in a folder that show the same film, by the digests in its
/// run.json. Throws UsageError where a rendering would touch somebody else's files, or where
/// --resume has nothing that it could continue.
FrameDigests::Map framesToKeep(const std::filesystem::path& folder, const Json& film,
                               const Film& frames, const RenderOptions& options);

/// Removes frames that would be taken for frames of this rendering, and what a killed one left. To
/// be called when run.json tells of the new rendering: otherwise the folder would be nobody's for a
/// moment.
void removeOtherFrames(const std::filesystem::path& folder, const FrameDigests::Map& kept,
                       FrameFormat format, const Console& console);

}  // namespace merge2d
