#include "app/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "src2d/core/error.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& folder) {
  throw IoError(fmt::format("cannot write to {}: {}", folder.string(),
                            std::generic_category().message(errno)));
}

/// The lock file tells the number of the process that holds it.
std::string holderOf(int descriptor) {
  std::array<char, 16> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  return size > 0 ? fmt::format(" (process {})",
                                std::string(text.data(), static_cast<std::size_t>(size)))
                  : std::string();
}

/// Whether the name still leads to the file: its process may have removed it meanwhile.
bool leadsTo(const fs::path& file, int descriptor) {
  struct stat named {
  }, open{};
  return stat(file.c_str(), &named) == 0 && fstat(descriptor, &open) == 0 &&
         named.st_dev == open.st_dev && named.st_ino == open.st_ino;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) {
  const fs::path file = folder / kName;
  while (true) {
    descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0644);
    if (descriptor_ < 0) fail(folder);
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      const std::string holder = holderOf(descriptor_);
      close(descriptor_);
      throw IoError(
          fmt::format("another merge2d{} writes to {} now; wait for it, or choose another folder",
                      holder, folder.string()));
    }
    if (leadsTo(file, descriptor_)) break;
    close(descriptor_);
  }
  file_ = TemporaryName(file);
  const std::string process = std::to_string(getpid());
  if (ftruncate(descriptor_, 0) != 0 ||
      pwrite(descriptor_, process.data(), process.size(), 0) < 0) {
    errno = 0;  // the lock holds without its text
  }
}

FolderLock::~FolderLock() {
  file_.remove();  // while it is locked, so that nobody else's is removed
  if (descriptor_ >= 0) close(descriptor_);
}

void removeRemains(const fs::path& folder) {
  std::vector<fs::path> remains;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (isTemporaryName(entry.path().filename().string())) remains.push_back(entry.path());
  }
  std::error_code ignored;
  for (const fs::path& file : remains) fs::remove(file, ignored);
}

}  // namespace merge2d
