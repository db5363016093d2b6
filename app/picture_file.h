#pragma once
/// Pictures that never appear in place of somebody else's files. What is asked here is asked before
/// the work begins, so that nobody waits for a refusal.

#include <filesystem>

namespace merge2d {

/// Throws UsageError where there is a file that is no picture of ours, unless `force` lets it be
/// replaced, and IoError where no picture could be written. Leaves nothing behind.
void requirePictureMayAppear(const std::filesystem::path& file, bool force);

}  // namespace merge2d
