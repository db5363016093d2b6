#include "app/render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/simulation.h"
#include "app/usage_error.h"
#include "render/canvas.h"
#include "render/context.h"
#include "src2d/core/error.h"
#include "src2d/core/suggest.h"

namespace merge2d {
namespace {

constexpr int kLeastSide = 16;  // [px]
constexpr int kMostFps = 1000;
constexpr int kMostCells = 12;  // of a contact sheet, along each side

constexpr std::array<Quality, 5> kQualities{{{'l', 854, 480, 15},
                                             {'m', 1280, 720, 30},
                                             {'h', 1920, 1080, 60},
                                             {'p', 2560, 1440, 60},
                                             {'k', 3840, 2160, 60}}};

constexpr std::array<std::string_view, 5> kFormats{"png", "apng", "gif", "mp4", "svg"};
constexpr std::array<std::string_view, 2> kContexts{"osmesa", "egl"};  // as in ContextKind

Quality readQuality(const std::string& text) {
  for (const Quality& quality : kQualities) {
    if (text.size() == 1 && text[0] == quality.letter) return quality;
  }
  throw UsageError(fmt::format(
      "--quality must be l (854x480, 15 frames per second), m (1280x720, 30), h (1920x1080, 60), "
      "p (2560x1440, 60) or k (3840x2160, 60), but is '{}'",
      text));
}

/// "4x3"
std::pair<int, int> readGrid(const std::string& text) {
  const std::size_t x = text.find('x');
  if (x == std::string::npos) {
    throw UsageError(
        fmt::format("--contact-sheet must be COLUMNSxROWS, such as 4x3, but is '{}'", text));
  }
  const auto side = [](const char* name, const std::string& digits) {
    const auto option = fmt::format("the number of {} in --contact-sheet", name);
    return static_cast<int>(readInteger(option, digits, 1, kMostCells));
  };
  return {side("columns", text.substr(0, x)), side("rows", text.substr(x + 1))};
}

FrameRange readRange(const std::string& text) {
  const auto number = [](const std::string& digits) {
    return readInteger("--frames FROM,TO", digits, 0, kMostFrames - 1);
  };
  const std::size_t comma = text.find(',');
  FrameRange range{number(text.substr(0, comma)), std::nullopt};
  if (comma == std::string::npos) return range;
  range.to = number(text.substr(comma + 1));
  if (*range.to < range.from) {
    throw UsageError(fmt::format("--frames {}: the first frame comes after the last one", text));
  }
  return range;
}

Format readFormat(const std::string& text) {
  const auto found = std::ranges::find(kFormats, text);
  if (found != kFormats.end()) return static_cast<Format>(found - kFormats.begin());
  throw UsageError(fmt::format("--format must be one of {}, but is '{}'{}",
                               fmt::join(kFormats, ", "), text, didYouMean(text, kFormats)));
}

/// An option that the renderer does not understand was typed wrongly.
template <class F>
auto asUsage(F&& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw UsageError(error.what());
  }
}

std::string overlayHelp() {
  std::string names;
  for (const OverlayEntry& entry : kOverlayTable) {
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  return "What to show over the bodies, with commas: " + names +
         "; these come on top of labels, scale, hud and legend; none or all first, -NAME to remove";
}

void addPictureOptions(CLI::App& command, RenderOptions& options) {
  constexpr const char* kGroup = "Pictures";
  addOption(
      command, "-q,--quality", "l|m|h|p|k",
      [&](const std::string& s) { options.quality = readQuality(s); },
      "480p15, 720p30 (default), 1080p60, 1440p60 or 2160p60")
      ->group(kGroup);
  addOption(
      command, "-r,--resolution", "WxH", [&](const std::string& s) { options.size = readSize(s); },
      "Size of the pictures, such as 1280x720; odd sizes grow by one for the sake of H.264")
      ->group(kGroup);
  addOption(
      command, "--fps", "N",
      [&](const std::string& s) {
        options.fps = static_cast<int>(readInteger("--fps", s, 1, kMostFps));
      },
      "Frames per second: frame k shows the time k / fps")
      ->group(kGroup);
  addOption(
      command, "--overlay", "LIST",
      [&](const std::string& s) { options.overlays = asUsage([&] { return parseOverlays(s); }); },
      overlayHelp())
      ->group(kGroup);
  addOption(
      command, "--theme", "NAME",
      [&](const std::string& s) { options.theme = asUsage([&] { return themeByName(s); }); },
      "light (default), dark or print")
      ->group(kGroup);
  command.add_flag("-t,--transparent", options.transparent, "No background")->group(kGroup);
  addContextOption(command);
}

void addFileOptions(CLI::App& command, RenderOptions& options) {
  constexpr const char* kGroup = "Files";
  addOutputOption(
      command, "-o,--output", "DIR",
      [&](const std::string& s) { options.folder = readPath("--output", s); },
      "Folder for the frames (default: frames/<scene>)")
      ->group(kGroup);
  command.add_flag("-s,--last-frame", options.last_only, "Draw the last frame only")->group(kGroup);
  addOption(
      command, "-n,--frames", "FROM,TO",
      [&](const std::string& s) { options.range = readRange(s); },
      "Draw the frames from FROM to TO only, both included; without TO, up to the last")
      ->group(kGroup);
  addOption(
      command, "--format", "FORMAT", [&](const std::string& s) { options.format = readFormat(s); },
      "png (default) or svg, vector graphics for papers; or png frames and from them also an apng, "
      "gif or "
      "mp4")
      ->group(kGroup);
  addOption(
      command, "--contact-sheet", "CxR",
      [&](const std::string& s) { options.contact_sheet = readGrid(s); },
      "Also put so many columns and rows of frames into one picture, such as 4x3")
      ->group(kGroup);
  command
      .add_flag("--stages", options.stages,
                "Draw the eleven stages of one time step, instead of frames, into stages/")
      ->group(kGroup);
  addOption(
      command, "--at", "STEP",
      [&](const std::string& s) { options.at = readInteger("--at", s, 1, kMostSteps); },
      "The time step whose stages are drawn: 1 is the first")
      ->group(kGroup);
  command
      .add_flag("--resume", options.resume, "Keep the frames that an interrupted rendering left")
      ->group(kGroup);
}

}  // namespace

std::pair<int, int> readSize(const std::string& text) {
  const std::size_t x = text.find('x');
  if (x == std::string::npos) {
    throw UsageError(
        fmt::format("--resolution must be WIDTHxHEIGHT, such as 1280x720, but is '{}'", text));
  }
  const auto side = [](const char* name, const std::string& digits) {
    const auto option = fmt::format("the {} in --resolution", name);
    return static_cast<int>(readInteger(option, digits, kLeastSide, Canvas::kMaxSide));
  };
  return {side("width", text.substr(0, x)), side("height", text.substr(x + 1))};
}

void addContextOption(CLI::App& command) {
  addOption(
      command, "--context", "osmesa|egl",
      [](const std::string& s) {
        const auto found = std::ranges::find(kContexts, s);
        if (found == kContexts.end()) {
          throw UsageError(fmt::format("--context must be one of {}, but is '{}'{}",
                                       fmt::join(kContexts, ", "), s, didYouMean(s, kContexts)));
        }
        chooseContext(static_cast<ContextKind>(found - kContexts.begin()));
      },
      "The library that OpenGL comes from (default: OSMesa, or else EGL)")
      ->group("Pictures");
}

void addRenderOptions(CLI::App& command, RenderOptions& options) {
  addSceneOptions(command, options);
  addFileOptions(command, options);
  addPictureOptions(command, options);
  addGeneralOptions(command, options);
}

void check(const RenderOptions& options) {
  check(static_cast<const SceneOptions&>(options));
  if (options.last_only && options.range) {
    throw UsageError("--last-frame and --frames ask for different frames");
  }
  if (options.last_only && isAnimation(options.format)) {
    throw UsageError(fmt::format("--last-frame makes one picture, which cannot be an {}",
                                 nameOf(options.format)));
  }
  if (options.stages != options.at.has_value()) {
    throw UsageError("--stages draws those of one time step: --stages --at STEP");
  }
  if (options.stages && (options.last_only || options.range || isAnimation(options.format))) {
    throw UsageError(
        "--stages draws pictures of one step; --last-frame, --frames and films are about frames");
  }
  if (options.last_only && options.contact_sheet) {
    throw UsageError("--last-frame makes one picture, which needs no --contact-sheet");
  }
  if (options.transparent && options.format == Format::Mp4) {
    throw UsageError("an mp4 cannot be transparent; --format apng can");
  }
}

std::string_view nameOf(Format format) { return kFormats[static_cast<std::size_t>(format)]; }

}  // namespace merge2d
