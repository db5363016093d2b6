#include "app/ffmpeg.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <system_error>

#include "app/output_file.h"
#include "src2d/core/error.h"

extern char** environ;

namespace merge2d {
namespace {

namespace fs = std::filesystem;

/// ffmpeg reads "%" in the name of its input as the start of a number.
std::string escapedPercents(const std::string& path) {
  std::string out;
  for (const char c : path) out += c == '%' ? std::string("%%") : std::string(1, c);
  return out;
}

/// Runs a program and returns what it returns to the shell.
int runProgram(const fs::path& program, const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = 0;
  const int failed = posix_spawn(&child, program.c_str(), nullptr, nullptr, argv.data(), environ);
  if (failed != 0) {
    throw IoError(fmt::format("cannot start {}: {}", program.string(),
                              std::generic_category().message(failed)));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
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
  all.insert(all.end(), {"-i", frames.string()});
  if (gif) {
    all.insert(all.end(), {"-vf",
                           "fps=25,split[a][b];[a]palettegen=stats_mode=diff[p];"
                           "[b][p]paletteuse=dither=bayer:bayer_scale=5:diff_mode=rectangle"});
  } else if (transparent) {  // H.264 knows no transparency
    all.insert(all.end(), {"-c:v", "libvpx-vp9", "-pix_fmt", "yuva420p"});
  } else {
    all.insert(all.end(), {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-movflags", "+faststart"});
  }
  all.push_back(output.string());
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
  const fs::path output = job.output();
  fs::path temporary = output;
  temporary.replace_extension(".part" + output.extension().string());
  std::vector<std::string> arguments = job.arguments(temporary);
  arguments.insert(arguments.begin() + 1, {"-y", "-nostdin", "-loglevel", "error"});
  const int status = runProgram(program, arguments);
  std::error_code failed;
  if (status == 0) fs::rename(temporary, output, failed);
  if (status == 0 && !failed) return;
  std::error_code ignored;
  fs::remove(temporary, ignored);
  throw IoError(fmt::format("ffmpeg could not write {}; this is its command: {}", output.string(),
                            job.commandLine()));
}

}  // namespace merge2d
