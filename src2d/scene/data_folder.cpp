/// Source of the order of folders: XDG Base Directory Specification 0.8.

#include "src2d/scene/data_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "src2d/core/error.h"
#include "src2d/scene/file.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

/// The value of a variable of the environment; an empty one counts as unset.
std::string environment(const char* variable, const std::string& otherwise) {
  const char* value = std::getenv(variable);
  return value == nullptr || *value == '\0' ? otherwise : value;
}

/// The data folders of the user and of the system. Relative paths are invalid and left out.
std::vector<fs::path> xdgDataFolders() {
  std::vector<fs::path> folders;
  const auto add = [&](const fs::path& folder) {
    if (folder.is_absolute()) folders.push_back(folder);
  };
  const std::string home = environment("HOME", "");
  add(environment("XDG_DATA_HOME", home.empty() ? "" : home + "/.local/share"));
  const std::string system = environment("XDG_DATA_DIRS", "/usr/local/share:/usr/share");
  for (std::size_t begin = 0; begin <= system.size();) {
    const std::size_t end = std::min(system.find(':', begin), system.size());
    add(system.substr(begin, end - begin));
    begin = end + 1;
  }
  return folders;
}

/// The folder `share` of the tree in which the running program is installed; empty where the system
/// does not tell.
fs::path shareBesideProgram() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : program.parent_path().parent_path() / "share";
}

}  // namespace

DataFolder::DataFolder(fs::path on_disk) : path_(std::move(on_disk)) {}

DataFolder::DataFolder(fs::path name, std::span<const EmbeddedFile> embedded)
    : path_(std::move(name)), embedded_(true), files_(embedded) {}

std::vector<std::string> DataFolder::entries() const {
  std::vector<std::string> names;
  if (embedded_) {
    for (const EmbeddedFile& file : files_) {
      if (!file.path.starts_with(prefix_)) continue;
      const std::string_view rest = file.path.substr(prefix_.size());
      names.emplace_back(rest.substr(0, rest.find('/')));
    }
  } else {
    std::error_code error;
    for (fs::directory_iterator it(path_, error), end; !error && it != end; it.increment(error)) {
      names.push_back(it->path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

bool DataFolder::holds(const std::string& file) const {
  if (embedded_) {
    return std::any_of(files_.begin(), files_.end(),
                       [&](const EmbeddedFile& f) { return f.path == prefix_ + file; });
  }
  std::error_code ignored;
  return fs::is_regular_file(pathOf(file), ignored);
}

std::string DataFolder::read(const std::string& file) const {
  if (!embedded_) return readFile(pathOf(file));
  for (const EmbeddedFile& f : files_) {
    if (f.path == prefix_ + file) return std::string(f.text);
  }
  throw IoError(fmt::format("{}: No such file or directory", pathOf(file).string()));
}

DataFolder DataFolder::folder(const std::string& name) const {
  DataFolder inner = *this;
  inner.path_ /= name;
  if (embedded_) inner.prefix_ += name + "/";
  return inner;
}

std::vector<DataFolder> dataFolders(const std::string& kind, const char* variable,
                                    std::span<const EmbeddedFile> embedded) {
  const std::string chosen = environment(variable, "");
  if (!chosen.empty()) return {DataFolder(fs::path(chosen))};
  std::vector<fs::path> share = xdgDataFolders();
  if (const fs::path own = shareBesideProgram(); !own.empty()) share.insert(share.begin(), own);
  std::vector<DataFolder> folders;
  for (const fs::path& s : share) folders.emplace_back(s / "merge2d" / kind);
  folders.emplace_back("built-in/" + kind, embedded);
  return folders;
}

}  // namespace merge2d
