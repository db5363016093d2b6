#include "app/frames_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "app/folder_lock.h"
#include "app/usage_error.h"
#include "render/sequence.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

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
  std::erase_if(names, [](const std::string& name) { return !frameNumber(name); });
  return names;
}

/// Lessons and comparisons are put beside the frames.
void requireNothingForeign(const fs::path& folder) {
  for (const std::string& name : namesIn(folder)) {
    if (name == FolderLock::kName || isTemporaryName(name)) continue;
    if (name == "lesson.html" || name == "stages" || name == "compare") continue;
    throw UsageError(
        fmt::format("{} holds files that merge2d did not write, such as {}; choose another folder "
                    "with --output, or say --force to put frames there all the same",
                    folder.string(), name));
  }
}

}  // namespace

FrameDigests::Map framesToKeep(const fs::path& folder, const Json& film, const Film& frames,
                               const RenderOptions& options) {
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
  if (same && (options.resume || !whole)) return digestsOf(*earlier);

  const std::size_t replaced = framesIn(folder).size();
  if (!whole && replaced > 1 && !options.force) {
    throw UsageError(
        fmt::format("{} frames in {} belong to another rendering: {} differs from what {} says; "
                    "choose another folder with --output, or say --force to remove them",
                    replaced, folder.string(), changed, run_file));
  }
  return {};
}

void removeOtherFrames(const fs::path& folder, const FrameDigests::Map& kept, FrameFormat format,
                       const Console& console) {
  removeRemains(folder);
  std::size_t removed = 0;
  for (const std::string& name : framesIn(folder)) {
    const std::int64_t number = *frameNumber(name);
    const bool same = kept.contains(number) && name == frameName(number, format);
    if (!same) removed += fs::remove(folder / name) ? 1 : 0;
  }
  if (removed == 0) return;
  console.note(fmt::format("{} earlier frames in {} are replaced", removed, folder.string()));
}

}  // namespace merge2d
