#pragma once
/// The folder a rendering goes to, and what else is in it.

#include <filesystem>

#include "app/console.h"
#include "app/run_file.h"

namespace merge2d {

/// Makes the folder ready: makes it when it is missing, and removes frames of earlier renderings
/// that would be taken for frames of this one. Throws UsageError where that would touch somebody
/// else's files, or where --resume has nothing that it could continue.
void prepareFolder(const std::filesystem::path& folder, const Json& film, const Film& frames,
                   const RenderOptions& options, const Console& console);

}  // namespace merge2d
