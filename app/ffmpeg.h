#pragma once
/// Films by ffmpeg, where it is installed.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/render_options.h"

namespace merge2d {

/// The program ffmpeg, if there is one on the PATH.
std::optional<std::filesystem::path> findFfmpeg();

/// The arguments of the command that makes a film from the frames of a folder; `output` is the last
/// one.
struct FfmpegJob {
  std::filesystem::path folder;
  std::string scene;
  int fps = 30;
  std::int64_t first = 0;  ///< number of the first frame
  bool gif = false;
  bool transparent = false;

  std::filesystem::path output() const;
  std::vector<std::string> arguments(const std::filesystem::path& output) const;
  /// As it can be typed into a shell.
  std::string commandLine() const;
};

/// Makes the film: complete or not at all. Throws IoError.
void runFfmpeg(const std::filesystem::path& program, const FfmpegJob& job);

}  // namespace merge2d
