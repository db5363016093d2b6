#pragma once
/// Files that appear complete or not at all.

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace merge2d {

/// The name of a file that is removed however the program ends, unless it was kept. Only SIGKILL
/// and a loss of power leave it behind.
class TemporaryName {
 public:
  TemporaryName() = default;
  explicit TemporaryName(const std::filesystem::path& file);
  ~TemporaryName() { remove(); }
  TemporaryName(TemporaryName&& other) noexcept;
  TemporaryName& operator=(TemporaryName&& other) noexcept;

  const std::filesystem::path& path() const { return path_; }
  bool empty() const { return path_.empty(); }
  /// The file is not removed any more: it has got another name, or is to stay.
  void keep();
  void remove();

 private:
  std::filesystem::path path_;
  int slot_ = -1;  ///< where signal handlers find it; -1: nowhere
};

/// Removes the files of all temporary names. For handlers of signals: calls nothing but unlink().
void removeTemporaryFiles();

/// Whether this may be a temporary name that a killed program left: ".merge2d-k3v9x0q2mz7a.mp4".
bool isTemporaryName(std::string_view name);

struct NewFileOptions {
  std::string name{};   ///< as the user calls the file; empty: by its path
  bool durable = true;  ///< on the disk before it appears, so that a loss of power cannot empty it
  bool has_name = false;  ///< other programs open it by `temporary()` before it appears
};

/// A file that takes its place at the end. Until then there is nothing under its name, or what was
/// there before. It has no name before that, where the file system can do that, so that whatever
/// ends the program leaves nothing; elsewhere it has a temporary one in the same folder, which no
/// other program has, and which leads through no link. What it replaces keeps its permissions.
class NewFile {
 public:
  /// Throws IoError, as all of these do, with the reason.
  explicit NewFile(const std::filesystem::path& target, NewFileOptions options = {});
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  int descriptor() const { return descriptor_; }
  /// Empty when it has none.
  const std::filesystem::path& temporary() const { return temporary_.path(); }

  void write(std::span<const std::uint8_t> bytes);
  /// Overwrites what was written at this place.
  void writeAt(std::uint64_t place, std::span<const std::uint8_t> bytes);
  std::uint64_t size() const;

  /// The file appears.
  void finish();

  /// "cannot write NAME: REASON", for an error number.
  [[noreturn]] void fail(int error) const;

 private:
  void create();
  void createNamed(mode_t mode);
  /// Gives a file without a name the target's, or a temporary one where there is a target.
  bool linkToTarget();
  void close();

  std::filesystem::path target_;
  NewFileOptions options_;
  int descriptor_ = -1;
  TemporaryName temporary_;
};

/// Writes all of it. False with errno where that fails; EINTR where a signal came while a pipe was
/// full.
bool writeAll(int descriptor, std::span<const std::uint8_t> bytes);

}  // namespace merge2d
