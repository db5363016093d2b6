#include "app/stage_rendering.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "app/console.h"
#include "app/folder_lock.h"
#include "app/interrupt.h"
#include "app/output_file.h"
#include "app/picture_file.h"
#include "app/run_file.h"
#include "app/simulation.h"
#include "app/stage_pictures.h"
#include "app/web_vtt.h"
#include "render/contact_sheet.h"
#include "render/png.h"
#include "render/svg_sheet.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

StepRecord recordStep(const Scene& scene, const RenderOptions& options, StagePictures& pictures) {
  Recorder recorder(scene, options.mode);
  while (recorder.world().steps() + 1 < *options.at) {
    stopIfInterrupted();
    recorder.skip();
    if (!recorder.world().events().empty()) pictures.note(recorder.world().capture());
  }
  return recorder.record();
}

FrameStyle styleOf(const RenderOptions& options) {
  FrameStyle style;
  style.width = evenSize(options.width());
  style.height = evenSize(options.height());
  style.theme = options.theme;
  style.transparent = options.transparent;
  return style;
}

/// The pictures of one step and what goes with them.
class StageFiles {
 public:
  StageFiles(const RenderOptions& options, const Console& console, const Scene& scene)
      : options_(options),
        console_(console),
        style_(styleOf(options)),
        folder_(
            (options.folder.empty() ? fs::path("frames") / scene.name : fs::path(options.folder)) /
            "stages"),
        made_(folder_),
        lock_(folder_),
        vtt_(file(".vtt").string(), {.everything = options.force, .ours = WebVtt::kStart}),
        pictures_(scene, options.mode, style_) {
    for (std::size_t i = 0; i < kStages; ++i) requirePictureMayAppear(picture(i), options.force);
    if (options.contact_sheet) requirePictureMayAppear(file(ending()), options.force);
    record_ = recordStep(scene, options, pictures_);
  }

  const fs::path& folder() const { return folder_; }
  std::int64_t step() const { return record_->step; }

  void write() {
    for (std::size_t i = 0; i < kStages; ++i) drawStage(i);
    vtt_.stream() << captions_.text();
    vtt_.finish();
    if (options_.contact_sheet) writeContactSheet();
  }

 private:
  /// "stages/step_000045" and what follows.
  fs::path file(const std::string& rest) const {
    return folder_ / fmt::format("step_{:06}{}", *options_.at, rest);
  }
  fs::path picture(std::size_t i) const {
    return file(fmt::format("_{:02}_{}{}", i + 1, name(static_cast<Stage>(i)), ending()));
  }
  bool vector() const { return options_.format == Format::Svg; }
  const char* ending() const { return vector() ? ".svg" : ".png"; }

  void drawStage(std::size_t i) {
    const std::string text = pictures_.save(&*record_, static_cast<Stage>(i), picture(i).string());
    captions_.add(static_cast<std::int64_t>(i), text);
    console_.detail(text);
    if (!options_.contact_sheet) return;
    if (vector()) {
      documents_.push_back(readFileText(picture(i)));
    } else {
      cells_.push_back(shrunk(loadPng(picture(i)), kSheetCell));
    }
  }

  void writeContactSheet() const {
    const fs::path sheet = file(ending());
    const int columns = options_.contact_sheet->first;
    const std::string told = fmt::format("The eleven stages of step {}.", record_->step);
    if (vector()) {
      writeFile(sheet.string(),
                svgSheet(documents_, columns, kSheetCell, style_.theme.background, {.title = told}),
                {.everything = true});
    } else {
      savePng(sheet, contactSheet(cells_, columns, style_.theme.background),
              {.alpha = style_.transparent, .description = told});
    }
    console_.note(fmt::format("{} shows them all", sheet.string()));
  }

  const RenderOptions& options_;
  const Console& console_;
  FrameStyle style_;
  fs::path folder_;
  MadeFolder made_;
  FolderLock lock_;
  OutputFile vtt_;
  std::optional<StepRecord> record_;
  StagePictures pictures_;
  WebVtt captions_;  ///< a second for each picture
  std::vector<Picture> cells_;
  std::vector<std::string> documents_;  ///< the same as vector graphics
};

}  // namespace

void renderStages(const RenderOptions& options) {
  const Console console(options);
  const Scene scene = loadScene(options, console);
  requireStep(scene, *options.at);
  StageFiles files(options, console, scene);
  files.write();
  if (options.json) {
    const Json out{{"scene", scene.name},
                   {"folder", files.folder().string()},
                   {"step", files.step()},
                   {"written", kStages}};
    return print(out.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  }
  print(files.folder().string() + "\n");
}

}  // namespace merge2d
