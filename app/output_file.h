#pragma once
/// Files that appear complete or not at all, and never in place of somebody else's.

#include <array>
#include <filesystem>
#include <optional>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "render/new_file.h"

namespace merge2d {

/// The files that an output may replace.
struct Replaces {
  bool everything = false;      ///< --force
  std::string_view ours = "?";  ///< a file that begins like this is one of ours; "?" is none
};

/// Makes a folder and those above it, where there are none. Throws IoError.
void makeFolder(const std::filesystem::path& folder);

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

/// Writes to a descriptor and keeps the reason why that failed.
class DescriptorBuffer : public std::streambuf {
 public:
  explicit DescriptorBuffer(int descriptor = -1) : descriptor_(descriptor) { empty(); }

  void setDescriptor(int descriptor) { descriptor_ = descriptor; }
  int error() const { return error_; }  ///< errno of the first write that failed; 0: none did

 protected:
  int_type overflow(int_type character) override;
  int sync() override;

 private:
  void empty() { setp(buffer_.data(), buffer_.data() + buffer_.size()); }

  int descriptor_;
  int error_ = 0;
  std::array<char, 1 << 16> buffer_;
};

/// A text file that takes its place at the end (render/new_file.h); folders that are missing are
/// made. "-" is the standard output; devices and pipes are written as they are.
class OutputFile {
 public:
  /// Throws UsageError when there is a file that may not be replaced, IoError when it cannot be
  /// written.
  OutputFile(const std::string& path, const Replaces& replaces);
  /// Without `finish` nothing is left behind.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ostream& stream() { return out_; }
  /// Throws IoError when something could not be written, for instance on a full disk.
  void check() const;
  /// The file appears. Throws IoError.
  void finish();

 private:
  bool isStandardOutput() const { return name_ == "-"; }
  void openDevice(const std::filesystem::path& device);

  std::string name_;  ///< as the user calls it
  std::optional<MadeFolder> made_;
  std::optional<NewFile> file_;  ///< none where a device is written
  int device_ = -1;              ///< its descriptor
  DescriptorBuffer buffer_;
  std::ostream out_{&buffer_};
};

/// A whole file at once.
void writeFile(const std::string& path, std::string_view text, const Replaces& replaces);

/// An option and the file that it names; without one, the path is empty.
struct NamedOutput {
  std::string option, path;
};

/// Throws UsageError where two outputs of a command are one file, whatever links lead there.
void requireDistinct(const std::vector<NamedOutput>& outputs);

/// The path as it can be typed into a shell.
std::string shellQuoted(const std::string& path);

}  // namespace merge2d
