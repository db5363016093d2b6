#include "app/frames_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "app/output_file.h"
#include "app/usage_error.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

/// "frame_000012.png", or the temporary name of such a file.
bool isFrame(std::string_view name) {
  constexpr std::string_view kStart = "frame_";
  constexpr std::size_t kDigits = 6;
  if (!name.starts_with(kStart) || name.size() < kStart.size() + kDigits) return false;
  const std::string_view digits = name.substr(kStart.size(), kDigits);
  const std::string_view rest = name.substr(kStart.size() + kDigits);
  return (rest == ".png" || rest == ".png.part") &&
         std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
}

/// The names in a folder, sorted.
std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> framesIn(const fs::path& folder) {
  std::vector<std::string> names = namesIn(folder);
  std::erase_if(names, [](const std::string& name) { return !isFrame(name); });
  return names;
}

/// Lessons and comparisons are put beside the frames.
void requireNothingForeign(const fs::path& folder) {
  for (const std::string& name : namesIn(folder)) {
    if (name == "lesson.html" || name == "stages" || name == "compare") continue;
    throw UsageError(
        fmt::format("{} holds files that merge2d did not write, such as {}; choose another folder "
                    "with --output, or say --force to put frames there all the same",
                    folder.string(), name));
  }
}

}  // namespace

void prepareFolder(const fs::path& folder, const Json& film, const Film& frames,
                   const RenderOptions& options, const Console& console) {
  if (!fs::exists(folder)) {
    makeFolder(folder);
    return;
  }
  if (!fs::is_directory(folder)) throw IoError(fmt::format("{} is not a folder", folder.string()));
  const std::optional<Json> earlier = readRunFile(folder);
  if (!earlier && !options.force) requireNothingForeign(folder);

  const std::string changed = earlier ? difference(film, *earlier) : "";
  const std::string run_file = (folder / "run.json").string();
  if (options.resume && !changed.empty()) {
    throw UsageError(
        fmt::format("--resume continues the same rendering only, but {} differs from what {} says; "
                    "without --resume its frames are replaced",
                    changed, run_file));
  }
  const bool whole = frames.from == 0 && frames.to == frames.last;
  const bool same = earlier && changed.empty();
  if (same && (options.resume || !whole)) return;

  const std::vector<std::string> replaced = framesIn(folder);
  if (!whole && replaced.size() > 1 && !options.force) {
    throw UsageError(
        fmt::format("{} frames in {} belong to another rendering: {} differs from what {} says; "
                    "choose another folder with --output, or say --force to remove them",
                    replaced.size(), folder.string(), changed, run_file));
  }
  for (const std::string& name : replaced) fs::remove(folder / name);
  if (!replaced.empty()) {
    console.note(
        fmt::format("{} earlier frames in {} are replaced", replaced.size(), folder.string()));
  }
}

}  // namespace merge2d
