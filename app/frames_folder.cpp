#include "app/frames_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <vector>

#include "app/usage_error.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

/// The number in "frame_000012.png", or in the temporary name of such a file.
std::optional<std::int64_t> frameNumber(std::string_view name) {
  constexpr std::string_view kStart = "frame_";
  constexpr std::size_t kDigits = 6;
  if (!name.starts_with(kStart) || name.size() < kStart.size() + kDigits) return std::nullopt;
  const std::string_view digits = name.substr(kStart.size(), kDigits);
  const std::string_view rest = name.substr(kStart.size() + kDigits);
  if (rest != ".png" && rest != ".png.part") return std::nullopt;
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + kDigits, number);
  if (error != std::errc() || end != digits.data() + kDigits) return std::nullopt;
  return number;
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

/// Removes the frames after `last`, all of them for -1; returns how many.
int removeFrames(const fs::path& folder, std::int64_t last) {
  int removed = 0;
  for (const std::string& name : namesIn(folder)) {
    const auto number = frameNumber(name);
    if (!number || *number <= last) continue;
    fs::remove(folder / name);
    ++removed;
  }
  return removed;
}

/// Lessons are put beside the frames.
void requireNothingForeign(const fs::path& folder) {
  for (const std::string& name : namesIn(folder)) {
    if (name == "lesson.html" || name == "stages") continue;
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
    fs::create_directories(folder);
    return;
  }
  if (!fs::is_directory(folder)) throw IoError(fmt::format("{} is not a folder", folder.string()));
  const std::optional<Json> earlier = readRunFile(folder);
  if (!earlier && !options.force) requireNothingForeign(folder);

  const std::string changed = earlier ? difference(film, *earlier) : "";
  if (options.resume && !changed.empty()) {
    throw UsageError(
        fmt::format("--resume continues the same rendering only, but {} differs from what {} says; "
                    "without --resume its frames are replaced",
                    changed, (folder / "run.json").string()));
  }
  const bool same = earlier && changed.empty();
  const bool whole = frames.from == 0 && frames.to == frames.last;
  const bool keep = same && (options.resume || !whole);
  const int removed = removeFrames(folder, keep ? frames.last : -1);
  if (removed > 0) {
    console.note(fmt::format("{} earlier frames in {} are replaced", removed, folder.string()));
  }
}

}  // namespace merge2d
