#pragma once
/// The files that come with the program (scenes, lessons): on disk, or built into it.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace merge2d {

/// A file that is built into the program.
struct EmbeddedFile {
  std::string_view path;  ///< from its folder, with '/'
  std::string_view text;
  std::string_view title = {};  ///< of a TOML file (cmake/embed.cmake); empty where none was found
};

/// A folder of text files, wherever they are. It refers to embedded files and does not own them.
class DataFolder {
 public:
  /// A folder on disk, which need not exist. Implicit: a path serves where a folder is asked for.
  DataFolder(std::filesystem::path on_disk);
  /// `name` stands for the folder in messages.
  DataFolder(std::filesystem::path name, std::span<const EmbeddedFile> embedded);

  bool isEmbedded() const { return embedded_; }
  /// As messages name it; of a folder on disk, its path.
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path pathOf(const std::string& file) const { return path_ / file; }

  /// The names of the files and folders that lie directly in it, ascending.
  std::vector<std::string> entries() const;
  bool holds(const std::string& file) const;
  /// The bytes of a file. Throws IoError when it cannot be read, InputError when it is too large.
  std::string read(const std::string& file) const;
  DataFolder folder(const std::string& name) const;

 private:
  std::filesystem::path path_;
  bool embedded_ = false;
  std::string prefix_;  ///< of the paths of embedded files in it: "" or "name/"
  std::span<const EmbeddedFile> files_;
};

/// The folders in which data of a kind ("scenes", "lessons") are looked for; the first that holds a
/// file counts. `variable` of the environment names the only one. Otherwise: ../share/merge2d
/// beside the program, merge2d in the XDG data folders, the embedded files.
std::vector<DataFolder> dataFolders(const std::string& kind, const char* variable,
                                    std::span<const EmbeddedFile> embedded);

}  // namespace merge2d
