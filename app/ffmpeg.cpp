#include "app/ffmpeg.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>

#include "app/child_process.h"
#include "app/output_file.h"
#include "render/new_file.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

/// ffmpeg reads "%" in the name of its input as the start of a number.
std::string escapedPercents(const std::string& path) {
  std::string out;
  for (const char c : path) out += c == '%' ? std::string("%%") : std::string(1, c);
  return out;
}

/// ffmpeg takes a word that begins with "-" for an option, and "name:" for a protocol.
std::string plainPath(const fs::path& path) {
  const std::string text = path.string();
  const std::string first = text.substr(0, text.find('/'));
  const bool plain = !text.starts_with('-') && first.find(':') == std::string::npos;
  return plain ? text : "./" + text;
}

/// The reason of a failure, in a line: the first message is about the cause, the others about what
/// followed.
std::string reasonOf(const ChildResult& result) {
  std::istringstream lines(result.messages);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t source_end = line.starts_with('[') ? line.find("] ") : std::string::npos;
    if (source_end != std::string::npos) line.erase(0, source_end + 2);  // "[libx264 @ 0x55…] "
    if (line.find_first_not_of(" \t\r") != std::string::npos) return line;
  }
  if (result.signal == 0) return fmt::format("it returned {} without a word", result.code);
  return fmt::format("signal {} ended it ({})", result.signal, strsignal(result.signal));
}

}  // namespace

std::optional<fs::path> findFfmpeg() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / "ffmpeg";
    std::error_code ignored;
    if (fs::is_regular_file(program, ignored) && access(program.c_str(), X_OK) == 0) return program;
  }
  return std::nullopt;
}

fs::path FfmpegJob::output() const {
  return folder / (scene + (gif ? ".gif" : transparent ? ".webm" : ".mp4"));
}

std::vector<std::string> FfmpegJob::arguments(const fs::path& output) const {
  std::vector<std::string> all{"ffmpeg", "-framerate", std::to_string(fps)};
  if (first != 0) all.insert(all.end(), {"-start_number", std::to_string(first)});
  const fs::path frames = fs::path(escapedPercents(folder.string())) / "frame_%06d.png";
  all.insert(all.end(), {"-i", plainPath(frames)});
  if (gif) {
    all.insert(all.end(), {"-vf",
                           "fps=25,split[a][b];[a]palettegen=stats_mode=diff[p];"
                           "[b][p]paletteuse=dither=bayer:bayer_scale=5:diff_mode=rectangle"});
  } else if (transparent) {  // H.264 knows no transparency
    all.insert(all.end(), {"-c:v", "libvpx-vp9", "-pix_fmt", "yuva420p"});
  } else {
    all.insert(all.end(), {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-movflags", "+faststart"});
  }
  all.push_back(plainPath(output));
  return all;
}

std::string FfmpegJob::commandLine() const {
  std::string line;
  for (const std::string& argument : arguments(output())) {
    line += (line.empty() ? "" : " ") + shellQuoted(argument);
  }
  return line;
}

void runFfmpeg(const fs::path& program, const FfmpegJob& job) {
  NewFile film(job.output(), {.has_name = true});
  std::vector<std::string> arguments = job.arguments(film.temporary());
  arguments.insert(arguments.begin() + 1, {"-y", "-nostdin", "-loglevel", "error"});
  const ChildResult result = runChild(program, arguments);
  if (result.code == 0) return film.finish();
  throw IoError(fmt::format("ffmpeg could not write {}: {}; this is its command: {}",
                            job.output().string(), reasonOf(result), job.commandLine()));
}

}  // namespace merge2d
