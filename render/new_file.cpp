#include "render/new_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <system_error>
#include <utility>

#include "src2d/core/error.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTemporaryStart = ".merge2d-",
                           kNameLetters = "abcdefghijklmnopqrstuvwxyz012345";
constexpr std::size_t kRandomLetters = 12;

/// The temporary names that exist, in memory that handlers of signals may read. With more of them
/// than there are slots, some are not removed by handlers.
struct Slot {
  enum State : int { Free, Changing, Used };
  std::atomic<int> state{Free};
  std::array<char, PATH_MAX> path{};
};
std::array<Slot, 64> temporary_names;  // NOLINT: handlers of signals have no arguments

int takeSlot(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (std::size_t i = 0; i < temporary_names.size(); ++i) {
    int expected = Slot::Free;
    if (!temporary_names[i].state.compare_exchange_strong(expected, Slot::Changing)) continue;
    std::memcpy(temporary_names[i].path.data(), path.c_str(), path.size() + 1);
    temporary_names[i].state = Slot::Used;
    return static_cast<int>(i);
  }
  return -1;
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// A name that nobody can know before, with the extension of the target, by which other programs
/// know what to write.
fs::path randomName(const fs::path& target) {
  std::array<unsigned char, kRandomLetters> random{};
  if (getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size())) {
    throw IoError("the operating system gives no random numbers");
  }
  std::string name(kTemporaryStart);
  for (const unsigned char byte : random) name += kNameLetters[byte % kNameLetters.size()];
  return folderOf(target) / (name + target.extension().string());
}

/// Whether a file without a name can be given one later.
bool canBeNamedLater() { return access("/proc/self/fd", X_OK) == 0; }

/// A new name is on the disk with its folder. Not all file systems can tell; none loses the file.
void syncFolder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

TemporaryName::TemporaryName(const fs::path& file) : path_(file), slot_(takeSlot(file.string())) {}

TemporaryName::TemporaryName(TemporaryName&& other) noexcept
    : path_(std::exchange(other.path_, {})), slot_(std::exchange(other.slot_, -1)) {}

TemporaryName& TemporaryName::operator=(TemporaryName&& other) noexcept {
  remove();
  path_ = std::exchange(other.path_, {});
  slot_ = std::exchange(other.slot_, -1);
  return *this;
}

void TemporaryName::keep() {
  if (slot_ >= 0) temporary_names[static_cast<std::size_t>(slot_)].state = Slot::Free;
  slot_ = -1;
  path_.clear();
}

void TemporaryName::remove() {
  if (!empty()) unlink(path_.c_str());
  keep();
}

void removeTemporaryFiles() {
  for (Slot& slot : temporary_names) {
    if (slot.state == Slot::Used) unlink(slot.path.data());
  }
}

bool isTemporaryName(std::string_view name) {
  if (!name.starts_with(kTemporaryStart) || name.size() < kTemporaryStart.size() + kRandomLetters)
    return false;
  const std::string_view letters = name.substr(kTemporaryStart.size(), kRandomLetters);
  const std::string_view rest = name.substr(kTemporaryStart.size() + kRandomLetters);
  return letters.find_first_not_of(kNameLetters) == std::string_view::npos &&
         (rest.empty() || rest.front() == '.');
}

bool writeAll(int descriptor, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

NewFile::NewFile(const fs::path& target, NewFileOptions options)
    : target_(target), options_(std::move(options)) {
  if (options_.name.empty()) options_.name = target.string();
  create();
}

NewFile::~NewFile() { close(); }

void NewFile::fail(int error) const {
  throw IoError(
      fmt::format("cannot write {}: {}", options_.name, std::generic_category().message(error)));
}

void NewFile::create() {
  constexpr mode_t kDefault = 0666;  // less the umask
  struct stat replaced {};
  const bool replaces = stat(target_.c_str(), &replaced) == 0;
  if (replaces && access(target_.c_str(), W_OK) != 0) fail(errno);
  const mode_t mode = replaces ? replaced.st_mode & 0777U : kDefault;
  if (!options_.has_name && canBeNamedLater()) {
    descriptor_ = open(folderOf(target_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, mode);
  }
  if (descriptor_ < 0) createNamed(mode);
  if (!replaces) return;
  if (fchown(descriptor_, replaced.st_uid, replaced.st_gid) != 0) errno = 0;  // as far as we may
  if (fchmod(descriptor_, mode) != 0) errno = 0;
}

void NewFile::createNamed(mode_t mode) {
  constexpr int kFlags = O_CREAT | O_EXCL | O_NOFOLLOW | O_WRONLY | O_CLOEXEC;
  do {
    TemporaryName name(randomName(target_));
    descriptor_ = open(name.path().c_str(), kFlags, mode);
    if (descriptor_ >= 0) {
      temporary_ = std::move(name);
    } else {
      name.keep();  // it is not ours
    }
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) fail(errno);
}

// NOLINTNEXTLINE(readability-make-member-function-const): the file changes.
void NewFile::write(std::span<const std::uint8_t> bytes) {
  if (!writeAll(descriptor_, bytes)) fail(errno);
}

void NewFile::writeAt(std::uint64_t place, std::span<const std::uint8_t> bytes) {
  const auto end = lseek(descriptor_, 0, SEEK_CUR);
  if (end < 0 || lseek(descriptor_, static_cast<off_t>(place), SEEK_SET) < 0) fail(errno);
  write(bytes);
  if (lseek(descriptor_, end, SEEK_SET) < 0) fail(errno);
}

std::uint64_t NewFile::size() const {
  struct stat now {};
  if (fstat(descriptor_, &now) != 0) fail(errno);
  return static_cast<std::uint64_t>(now.st_size);
}

void NewFile::finish() {
  if (options_.durable && fsync(descriptor_) != 0 && errno != EINVAL) fail(errno);
  if (temporary_.empty() && linkToTarget()) return close();
  // Some network file systems tell at the end only that the disk is full.
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (rename(temporary_.path().c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.keep();
  if (options_.durable) syncFolder(folderOf(target_));
}

bool NewFile::linkToTarget() {
  const std::string file = fmt::format("/proc/self/fd/{}", descriptor_);
  const auto linkTo = [&](const fs::path& name) {
    return linkat(AT_FDCWD, file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  if (linkTo(target_)) {
    if (options_.durable) syncFolder(folderOf(target_));
    return true;
  }
  while (errno == EEXIST) {
    TemporaryName name(randomName(target_));
    if (linkTo(name.path())) {
      temporary_ = std::move(name);
      return false;
    }
    name.keep();
  }
  fail(errno);
}

void NewFile::close() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

}  // namespace merge2d
