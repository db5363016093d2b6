#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/captions.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/ffmpeg.h"
#include "app/folder_lock.h"
#include "app/frame_sink.h"
#include "app/frames_folder.h"
#include "app/interrupt.h"
#include "app/output_file.h"
#include "app/picture_file.h"
#include "app/progress.h"
#include "app/run_ahead.h"
#include "app/simulation.h"
#include "app/stage_rendering.h"
#include "render/apng.h"
#include "render/contact_sheet.h"
#include "render/frame.h"
#include "render/png.h"
#include "render/sequence.h"
#include "render/svg_sheet.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRenderExamples = R"(Examples:
  merge2d render tower-platform
  merge2d render pile -q l --seconds 3 --format gif
  merge2d render books --overlay contacts,forces --theme print -s -o figure
  merge2d render spinner -r 1920x1080 --fps 60 -n 0,120
  merge2d render tower-platform --resume
  merge2d render pile --contact-sheet 4x3
  merge2d render books --seconds 3 -s --format svg -o figure
  merge2d render tower-platform --stages --at 599 --format svg

The pictures are called frame_000000.png, frame_000001.png and so on; frame k shows the time k /
fps, and the last one the end of the run. Beside them, run.json tells how they were made and
captions.vtt what happens; those of --stages have captions in step_000599.vtt, a second for each
picture. A folder is used only when it is empty or holds an earlier rendering, whose frames are
replaced; --force puts the frames among other files.)";

using RenderClock = std::chrono::steady_clock;

/// run.json is written so often: what a kill costs.
constexpr std::chrono::seconds kNotedEvery{1};

/// A rendering from its options to its files.
class Rendering {
 public:
  explicit Rendering(const RenderOptions& options)
      : options_(options),
        console_(options),
        simulation_(std::make_shared<const Scene>(loadScene(options, console_)),
                    {.mode = options.mode, .timings = false}),
        film_(filmOf(scene(), options)),
        folder_(options.folder.empty() ? fs::path("frames") / scene().name
                                       : fs::path(options.folder)),
        snapshot_(world().capture()),
        style_(makeStyle()),
        run_file_(folder_, filmJson(scene(), options, style_), film_) {}

  void run();

 private:
  const World& world() const { return simulation_.world(); }
  const Scene& scene() const { return world().scene(); }
  bool vector() const { return style_.format == FrameFormat::Svg; }
  fs::path sheetFile() const {
    return folder_ / (vector() ? "contact_sheet.svg" : "contact_sheet.png");
  }
  /// Frames drawn per second.
  double speed() const { return static_cast<double>(counts_.written) / std::max(seconds_, 1e-9); }

  FrameStyle makeStyle() const;
  void prepareFolder();
  void drawFrames();
  void noteProgress();
  void stepTo(std::int64_t step, FrameSink& sink);
  void finish(bool complete, const std::string& failure = {});
  fs::path makeAnimation();
  FfmpegJob ffmpegJob() const;
  void makeContactSheet() const;
  void noteSpeed() const;
  void printProducts(const fs::path& animation) const;

  const RenderOptions& options_;
  Console console_;
  Simulation simulation_;
  Film film_;
  fs::path folder_;
  Snapshot snapshot_;
  FrameStyle style_;
  RunFile run_file_;
  std::optional<MadeFolder> made_;
  std::optional<FolderLock> lock_;
  std::optional<FrameDigests> digests_;
  RenderClock::time_point noted_ = RenderClock::now();  ///< when run.json was written
  Captions captions_;
  FrameCounts counts_;
  double seconds_ = 0.0;  ///< that the frames took
};

FrameStyle Rendering::makeStyle() const {
  FrameStyle style;
  style.width = evenSize(options_.width());
  style.height = evenSize(options_.height());
  style.theme = options_.theme;
  style.format = options_.format == Format::Svg ? FrameFormat::Svg : FrameFormat::Png;
  style.transparent = options_.transparent;
  style.overlays = options_.overlays;
  style.mode = options_.mode;
  const auto& bodies = world().bodies();
  if (!fitsTheRun(scene())) {
    adaptToScene(style, scene(), snapshot_, bodies);
  } else {
    adaptToScene(style, scene(), snapshot_, coverageOf(simulation_.shared(), options_.mode),
                 bodies);
  }
  return style;
}

/// Whether a step may have made collections: by merging, or of the parts of a split one.
bool mayMakeCollections(const std::vector<Event>& events) {
  return std::ranges::any_of(events, [](const Event& e) {
    return e.type == EventType::Merge || e.type == EventType::Unmerge;
  });
}

void Rendering::stepTo(std::int64_t step, FrameSink& sink) {
  while (world().steps() < step) {
    simulation_.step();
    // Between two frames only the events are of interest.
    snapshot_.step = world().steps();
    snapshot_.time = world().time();
    snapshot_.events = world().events();
    snapshot_.stats = world().stats();
    run_file_.add(snapshot_);
    captions_.add(snapshot_);
    // The colour of a collection is decided when it is made, whichever frames are drawn.
    if (mayMakeCollections(snapshot_.events)) sink.note(world().capture());
  }
}

/// Files that a kill leaves can be told from those of somebody else.
void Rendering::noteProgress() {
  if (RenderClock::now() < noted_ + kNotedEvery) return;
  run_file_.write(false, *digests_);
  noted_ = RenderClock::now();
}

void Rendering::drawFrames() {
  const auto sink =
      makeFrameSink(world().bodies(), style_, folder_, film_, *digests_, options_.resume);
  Progress progress(console_, "frame", film_.to + 1);
  const RenderClock::time_point start = RenderClock::now();
  for (std::int64_t frame = 0; frame <= film_.to; ++frame) {
    stepTo(film_.stepOf(frame), *sink);
    stopIfInterrupted();
    world().capture(snapshot_);
    sink->add(frame, snapshot_);
    noteProgress();
    progress.update(frame);
  }
  sink->finish();
  counts_ = sink->counts();
  seconds_ = std::chrono::duration<double>(RenderClock::now() - start).count();
}

void Rendering::finish(bool complete, const std::string& failure) {
  run_file_.write(complete, *digests_, describe(snapshot_, style_), failure);
  writeFile(folder_ / "captions.vtt", captions_.text(scene().title), {.everything = true});
}

FfmpegJob Rendering::ffmpegJob() const {
  return {.folder = folder_,
          .scene = scene().name,
          .fps = film_.fps,
          .first = film_.from,
          .gif = options_.format == Format::Gif,
          .transparent = options_.transparent};
}

/// The path of the animation that was asked for; empty when there is none.
fs::path Rendering::makeAnimation() {
  if (!isAnimation(options_.format)) return {};
  if (options_.format == Format::Apng) {
    const fs::path file = folder_ / (scene().name + ".apng");
    ApngWriter writer(file, film_.fps);
    for (std::int64_t k = film_.from; k <= film_.to; ++k) {
      writer.add(readFileBytes(folder_ / frameName(k)), options_.transparent);
    }
    writer.finish();
    return file;
  }
  const auto program = findFfmpeg();
  if (!program) {
    console_.note(fmt::format("ffmpeg is not installed; where it is, this makes the {}:",
                              nameOf(options_.format)));
    return {};
  }
  runFfmpeg(*program, ffmpegJob());
  return ffmpegJob().output();
}

/// Frames from the first to the last at equal distances.
void Rendering::makeContactSheet() const {
  if (!options_.contact_sheet) return;
  const auto [columns, rows] = *options_.contact_sheet;
  const std::int64_t cells = std::min<std::int64_t>(columns * rows, film_.to - film_.from + 1);
  std::vector<fs::path> files;
  for (std::int64_t i = 0; i < cells; ++i) {
    const std::int64_t way =
        cells > 1 ? (2 * i * (film_.to - film_.from) + cells - 1) / (2 * (cells - 1)) : 0;
    files.push_back(folder_ / frameName(film_.from + way, style_.format));
  }
  const std::string told = fmt::format("{} pictures from t = {:.2f} s to t = {:.2f} s. {}", cells,
                                       static_cast<double>(film_.from) / film_.fps, snapshot_.time,
                                       describe(snapshot_, style_));
  if (vector()) {
    std::vector<std::string> documents;
    for (const fs::path& file : files) documents.push_back(readFileText(file));
    writeFile(sheetFile().string(),
              svgSheet(documents, columns, kSheetCell, style_.theme.background,
                       {.title = scene().title, .description = told}),
              {.everything = true});
  } else {
    std::vector<Picture> frames;
    for (const fs::path& file : files) frames.push_back(shrunk(loadPng(file), kSheetCell));
    savePng(sheetFile(), contactSheet(frames, columns, style_.theme.background),
            {.alpha = style_.transparent, .description = told});
  }
  console_.note(fmt::format("{} shows {} frames", sheetFile().string(), cells));
}

void Rendering::noteSpeed() const {
  const std::int64_t frames = counts_.written + counts_.kept;
  std::string note = fmt::format("{} frame{} of {}x{} in {:.1f} s", frames, frames == 1 ? "" : "s",
                                 style_.width, style_.height, seconds_);
  if (counts_.written > 0) note += fmt::format(", {:.0f} frames per second", speed());
  if (counts_.kept > 0) note += fmt::format("; {} were there already", counts_.kept);
  console_.note(note);
}

/// The folder, the picture or the animation, and how ffmpeg makes a film.
void Rendering::printProducts(const fs::path& animation) const {
  const bool pixels = style_.format == FrameFormat::Png;
  const std::string ffmpeg = ffmpegJob().commandLine();
  if (options_.json) {
    const Json out{{"scene", scene().name},
                   {"folder", folder_.string()},
                   {"frames", {{"first", film_.from}, {"last", film_.to}}},
                   {"written", counts_.written},
                   {"kept", counts_.kept},
                   {"width", style_.width},
                   {"height", style_.height},
                   {"fps", film_.fps},
                   {"animation", animation.empty() ? Json() : Json(animation.string())},
                   {"ffmpeg", pixels ? Json(ffmpeg) : Json()},
                   {"frames_per_second", speed()}};
    print(out.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  } else if (options_.last_only) {
    print((folder_ / frameName(film_.last, style_.format)).string() + "\n");
  } else {
    print((animation.empty() ? folder_ : animation).string() + "\n");
    if (pixels) print(ffmpeg + "\n");
  }
}

void Rendering::prepareFolder() {
  std::error_code ignored;
  if (fs::exists(folder_, ignored) && !fs::is_directory(folder_, ignored)) {
    throw IoError(fmt::format("{} is not a folder", folder_.string()));
  }
  made_.emplace(folder_);
  lock_.emplace(folder_);
  if (options_.contact_sheet) requirePictureMayAppear(sheetFile(), options_.force);
  const FrameDigests::Map kept =
      framesToKeep(folder_, filmJson(scene(), options_, style_), film_, options_);
  digests_.emplace(kept);
  run_file_.write(false, *digests_);
  removeOtherFrames(folder_, kept, style_.format, console_);
}

void Rendering::run() {
  prepareFolder();
  try {
    drawFrames();
  } catch (const SimulationError& error) {
    finish(false, error.what());  // what there is up to here helps to find out why
    throw;
  } catch (const Interrupted&) {
    run_file_.write(false, *digests_);
    throw Interrupted("interrupted; --resume continues");
  }
  finish(true);
  noteSpeed();
  makeContactSheet();
  printProducts(makeAnimation());
}

void render(const RenderOptions& options) {
  check(options);
  catchInterrupts();
  if (options.stages) return renderStages(options);
  Rendering(options).run();
}

}  // namespace

void addRenderCommand(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("render", "Draw a scene as a sequence of PNG or SVG files");
  command->footer(kRenderExamples);
  const auto options = std::make_shared<RenderOptions>();
  addRenderOptions(*command, *options);
  command->callback([&action, options] { action = [options] { render(*options); }; });
}

}  // namespace merge2d
