#include "src2d/scene/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "src2d/core/error.h"
#include "src2d/scene/scene.h"

namespace merge2d {
namespace {

[[noreturn]] void failReading(const std::string& name, int error) {
  throw IoError(fmt::format("{}: {}", name, std::generic_category().message(error)));
}

/// An open file that closes itself.
class OpenFile {
 public:
  OpenFile(const std::filesystem::path& path, const std::string& name) : name_(name) {
    file_ = isStandardInput(path) ? dup(STDIN_FILENO) : open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file_ < 0) failReading(name_, errno);
  }
  ~OpenFile() { close(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  /// Its size where it has one; pipes and devices have 0.
  std::size_t size() const {
    struct stat state {};
    const bool regular = fstat(file_, &state) == 0 && S_ISREG(state.st_mode);
    return regular ? static_cast<std::size_t>(state.st_size) : 0;
  }

  /// Fills as much of the range as there is; returns how much that was.
  std::size_t read(char* to, std::size_t most) const {
    std::size_t done = 0;
    while (done < most) {
      const ssize_t bytes = ::read(file_, to + done, most - done);
      if (bytes < 0 && errno == EINTR) continue;
      if (bytes < 0) failReading(name_, errno);
      if (bytes == 0) break;
      done += static_cast<std::size_t>(bytes);
    }
    return done;
  }

 private:
  const std::string& name_;
  int file_ = -1;
};

}  // namespace

bool isStandardInput(const std::filesystem::path& path) { return path == "-"; }

std::string nameOfFile(const std::filesystem::path& path) {
  return isStandardInput(path) ? std::string(kStandardInput) : path.string();
}

std::string readFile(const std::filesystem::path& path, const FileKind& kind) {
  const std::string name = nameOfFile(path);
  const OpenFile file(path, name);
  const auto failSize = [&](std::string_view has) {
    throw InputError(fmt::format("{}: {} has at most {} MB, this one has {}", name, kind.what,
                                 kind.most >> 20u, has));
  };
  if (file.size() > kind.most) failSize(fmt::format("{} MB", file.size() >> 20u));
  std::string bytes(std::max(file.size(), kind.start.size()), '\0');
  bytes.resize(file.read(bytes.data(), bytes.size()));
  // A file without an end, such as /dev/zero, is known by its start or by its size. Blocks start
  // small: most files have been read by now, and room for more takes longer than they did.
  constexpr std::size_t kSmallest = 1u << 12, kLargest = 1u << 20;
  bool more = true;
  for (std::size_t block = kSmallest; more && bytes.starts_with(kind.start);
       block = std::min(2 * block, kLargest)) {
    const std::size_t before = bytes.size();
    bytes.resize(before + block);
    const std::size_t got = file.read(bytes.data() + before, block);
    bytes.resize(before + got);
    if (bytes.size() > kind.most) failSize("more");
    more = got == block;
  }
  return bytes;
}

}  // namespace merge2d
