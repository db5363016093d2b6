#pragma once
/// The options of `render`.

#include <cstdint>
#include <optional>
#include <string>

#include "app/options.h"
#include "render/style.h"

namespace merge2d {

enum class Format { Png, Apng, Gif, Mp4, Svg };

/// Whether frames become one file that moves.
constexpr bool isAnimation(Format format) {
  return format == Format::Apng || format == Format::Gif || format == Format::Mp4;
}

/// How large and how fast: manim's letters.
struct Quality {
  char letter;
  int width, height;  ///< [px]
  int fps;
};

constexpr std::int64_t kMostFrames = 1'000'000;  ///< as many as their names have numbers

/// Frames, inclusive; an open end is the last one.
struct FrameRange {
  std::int64_t from = 0;
  std::optional<std::int64_t> to;
};

struct RenderOptions : SceneOptions {
  std::string folder;  ///< empty: frames/<scene>
  Quality quality{'m', 1280, 720, 30};
  std::optional<std::pair<int, int>> size;  ///< overrides the quality's [px]
  std::optional<int> fps;                   ///< overrides the quality's
  Overlays overlays = Overlays::standard();
  Theme theme = lightTheme();
  bool transparent = false;
  bool last_only = false;
  std::optional<FrameRange> range;
  Format format = Format::Png;
  bool resume = false;
  std::optional<std::pair<int, int>> contact_sheet;  ///< columns and rows
  bool stages = false;             ///< draw the stages of one time step instead of frames
  std::optional<std::int64_t> at;  ///< that step

  int width() const { return size ? size->first : quality.width; }
  int height() const { return size ? size->second : quality.height; }
  int framesPerSecond() const { return fps.value_or(quality.fps); }
};

void addRenderOptions(CLI::App& command, RenderOptions& options);
/// --context, for all commands that draw: it holds for the whole process.
void addContextOption(CLI::App& command);

/// Throws UsageError for options that contradict each other.
void check(const RenderOptions& options);

/// Width and height in pixels from "1280x720". Throws UsageError.
std::pair<int, int> readSize(const std::string& text);

/// "mp4"
std::string_view nameOf(Format format);

}  // namespace merge2d
