#pragma once
/// Pictures that never appear in place of somebody else's files. What is asked here is asked before
/// the work begins, so that nobody waits for a refusal.

#include <filesystem>
#include <vector>

namespace merge2d {

/// Throws UsageError where there is a file that is no picture of ours, unless `force` lets it be
/// replaced, and IoError where no picture could be written. Leaves nothing behind.
void requirePictureMayAppear(const std::filesystem::path& file, bool force);

/// A folder, made together with those above it where they are missing. What was made goes again
/// where nothing was put into it.
class MadeFolder {
 public:
  /// Throws IoError.
  explicit MadeFolder(const std::filesystem::path& folder);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< the innermost first
};

}  // namespace merge2d
