#pragma once
/// One process at a time writes the files of a folder that belong together.

#include <filesystem>
#include <string_view>

#include "render/new_file.h"

namespace merge2d {

/// Holds a lock on a file in the folder, which is gone with the lock. A process that ends gives it
/// back, however it ends; the file alone, without its process, holds nobody up.
class FolderLock {
 public:
  static constexpr std::string_view kName = ".merge2d.lock";

  /// Throws IoError that names the process which writes there, or where the folder cannot be
  /// written. File systems that know no locks are used without.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
  TemporaryName file_;
};

/// Removes the temporary files that a killed process left in a folder. To be called under its lock.
void removeRemains(const std::filesystem::path& folder);

}  // namespace merge2d
