#pragma once
/// Files that appear complete or not at all, and never in place of somebody else's.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace merge2d {

/// What a file may replace.
struct Replaces {
  bool everything = false;      ///< --force
  std::string_view ours = "?";  ///< a file that begins like this is one of ours; "?" is none
};

/// A text file that is written under a temporary name, in the same folder, and renamed at the end.
/// "-" is the standard output; devices and pipes are written as they are.
class OutputFile {
 public:
  /// Throws UsageError when there is a file that may not be replaced, IoError when it cannot be
  /// written.
  OutputFile(const std::string& path, const Replaces& replaces);
  /// Without `finish` nothing is left behind.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ostream& stream() { return *out_; }
  /// Throws IoError when something could not be written, for instance on a full disk.
  void check() const;
  /// The file appears. Throws IoError.
  void finish();

 private:
  std::string name_;  ///< as the user calls it
  std::filesystem::path path_;
  std::filesystem::path temporary_;  ///< empty when there is none
  std::ofstream file_;
  std::ostream* out_ = &file_;
};

/// A whole file at once.
void writeFile(const std::string& path, std::string_view text, const Replaces& replaces);

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

/// The path as it can be typed into a shell.
std::string shellQuoted(const std::string& path);

}  // namespace merge2d
