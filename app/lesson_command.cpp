#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/console.h"
#include "app/interrupt.h"
#include "app/json.h"
#include "app/lesson_source.h"
#include "app/output_file.h"
#include "app/progress.h"
#include "app/simulation.h"
#include "app/usage_error.h"
#include "lessons/lesson.h"
#include "lessons/page.h"
#include "src2d/core/error.h"
#include "src2d/core/suggest.h"
#include "src2d/scene/file.h"
#include "src2d/scene/load.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLessonExamples = R"(Examples:
  merge2d lesson what-merging-is
  merge2d lesson tower-platform
  merge2d lesson my-lesson/
  merge2d lesson my-scene.toml -o page.html
  merge2d lesson books --no-live
  merge2d lesson cycles --embed -o cycles.html
  merge2d lesson --course -o course

The page is one file with everything in it: it needs no network, and sends nothing anywhere.)";

/// How the pages begin, so that one may replace another.
constexpr std::string_view kPageStart =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n"
    "<meta charset=\"utf-8\">\n<meta name=\"viewport\"";

struct LessonOptions : SceneOptions {
  std::string output;  ///< empty: frames/<name>/lesson.html
  bool no_live = false, embed = false, course = false;
  std::string language;  ///< of the page's own words; empty: English
};

/// Whoever mistypes a lesson's name is told of lessons too, not of scenes alone.
void refuseUnknownName(const std::string& name) {
  const fs::path path(name);
  if (isStandardInput(path) || path.has_parent_path() || path.has_extension()) return;
  if (std::error_code ignored; fs::exists(path, ignored)) return;
  std::vector<std::string> names;
  for (const BuiltinLesson& lesson : builtinLessons()) names.push_back(lesson.name);
  for (const BuiltinScene& scene : builtinScenes()) names.push_back(scene.name);
  if (isAmong(name, names)) return;
  throw InputError(
      fmt::format("no built-in lesson or scene is called '{}'{}; `merge2d list` names them all",
                  name, didYouMean(name, names)));
}

/// Runs a scene in full.
Recording recorded(const Scene& scene, Mode mode, const std::function<void(std::int64_t)>& done) {
  Recording recording = record(scene, {.mode = mode, .steps = stepCount(scene), .progress = done});
  lookInside(recording, {}, done);
  return recording;
}

/// Runs the reference for its motion alone, while another run goes on. It ends early when nobody
/// waits for it any more.
class Ghost {
 public:
  explicit Ghost(const Scene& scene)
      : run_(std::async(std::launch::async, [this, &scene] { return recordMotion(scene); })) {}
  ~Ghost() { unwanted_ = true; }
  Ghost(const Ghost&) = delete;
  Ghost& operator=(const Ghost&) = delete;

  std::int64_t steps() const { return steps_; }
  bool ready() const {
    return run_.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
  }
  Recording get() { return run_.get(); }

 private:
  Recording recordMotion(const Scene& scene) {
    const auto done = [this](std::int64_t step) {
      stopIfInterrupted();
      if (unwanted_) throw Interrupted("the page is not made");
      steps_ = step;
    };
    return record(scene, {.mode = Mode::Reference,
                          .detail = Detail::Motion,
                          .steps = stepCount(scene),
                          .progress = done});
  }

  std::atomic<bool> unwanted_ = false;
  std::atomic<std::int64_t> steps_ = 0;
  std::future<Recording> run_;
};

/// Names a page that was written: its path, or with --json an object in a line.
void printPage(const LessonOptions& options, const std::string& path) {
  if (!options.json) return print(path + "\n");
  print(Json{{"page", path}}.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

/// Where a page goes: asked for before it is made, so that nobody waits for a refusal.
class PageFile {
 public:
  PageFile(const LessonOptions& options, const std::string& name)
      : options_(options),
        path_(options.output.empty() ? (fs::path("frames") / name / "lesson.html").string()
                                     : options.output) {
    if (options.output.empty()) made_.emplace(fs::path(path_).parent_path());
    file_.emplace(path_, Replaces{.everything = options.force, .ours = kPageStart});
  }

  void write(const PageContent& content, bool live) {
    file_->stream() << makePage(content, live);
    file_->finish();
    if (path_ != "-") printPage(options_, path_);
  }

 private:
  const LessonOptions& options_;
  std::string path_;
  std::optional<MadeFolder> made_;
  std::optional<OutputFile> file_;
};

/// A scene's page: no text, no questions, the reference as ghost.
PageContent scenePage(const LessonOptions& options, const Console& console,
                      std::optional<PageFile>& file) {
  const Scene scene = loadScene(options, console);
  file.emplace(options, scene.name);
  PageContent content{.title = scene.title, .lesson = "null", .traces = {}};
  std::optional<Ghost> ghost;
  if (options.mode != Mode::Reference) ghost.emplace(scene);
  Progress progress(console, "step", stepCount(scene));
  const auto tell = [&](std::int64_t step) {
    stopIfInterrupted();
    progress.update(ghost ? std::min(step, ghost->steps()) : step);
  };
  content.traces.push_back({std::string(name(options.mode)), recorded(scene, options.mode, tell)});
  if (ghost) {
    while (!ghost->ready()) tell(ghost->steps());
    content.traces.push_back({"reference", ghost->get()});
  }
  return content;
}

/// Simulates a lesson, and names the expectations that do not hold.
PageContent contentOf(const Lesson& lesson, const Console& console) {
  std::vector<Recording> recordings =
      recordLesson(lesson, [](std::int64_t) { stopIfInterrupted(); });
  for (const std::string& failure : failures(lesson, recordings)) console.warnOfPlace(failure);
  PageContent content{
      .title = lesson.title, .lesson = lessonJson(lesson, recordings), .traces = {}};
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    content.traces.push_back(
        {lesson.traces[i].label, std::move(recordings[i]), lesson.traces[i].world});
  }
  return content;
}

void refuseSceneOptions(const LessonOptions& options) {
  if (!options.overrides.empty() || options.steps || options.seconds || options.has_mode) {
    throw UsageError(
        "a lesson says itself how its scene is run; --mode, --set, --seed, --steps and "
        "--seconds are for scenes");
  }
}

PageContent lessonPage(const DataFolder& folder, const LessonOptions& options,
                       const Console& console, std::optional<PageFile>& file) {
  refuseSceneOptions(options);
  const Lesson lesson = loadLesson(folder);
  file.emplace(options, lesson.name);
  return contentOf(lesson, console);
}

/// All lessons and a page that lists them, in a folder.
void writeCourse(const LessonOptions& options, const Console& console) {
  refuseSceneOptions(options);
  if (!options.scene.empty()) {
    throw UsageError("--course writes all lessons; give it no name of one");
  }
  const fs::path folder = options.output.empty() ? "course" : options.output;
  const MadeFolder made(folder);
  std::vector<Lesson> lessons;
  for (const BuiltinLesson& lesson : builtinLessons()) lessons.push_back(loadLesson(lesson.folder));
  const auto fileOf = [](const Lesson& lesson) { return lesson.name + ".html"; };
  const auto write = [&](const std::string& name, const std::string& page) {
    OutputFile file((folder / name).string(), {.everything = options.force, .ours = kPageStart});
    file.stream() << page;
    file.finish();
    printPage(options, (folder / name).string());
  };
  std::vector<CourseEntry> entries;
  for (std::size_t i = 0; i < lessons.size(); ++i) {
    const Lesson& lesson = lessons[i];
    entries.push_back({.title = lesson.title,
                       .summary = lesson.summary,
                       .file = fileOf(lesson),
                       .minutes = lesson.minutes});
    PageContent content = contentOf(lesson, console);
    content.course = {.number = static_cast<int>(i) + 1,
                      .of = static_cast<int>(lessons.size()),
                      .next_title = i + 1 < lessons.size() ? lessons[i + 1].title : "",
                      .next_file = i + 1 < lessons.size() ? fileOf(lessons[i + 1]) : "index.html"};
    if (!options.language.empty()) content.language = options.language;
    write(fileOf(lesson), makePage(content, !options.no_live));
  }
  write("index.html", makeCourseIndex(entries));
}

void run(const LessonOptions& options) {
  check(options);
  const Console console(options);
  catchInterrupts();
  if (options.course) return writeCourse(options, console);
  if (options.scene.empty()) {
    throw UsageError("which scene or lesson? `merge2d list` names them; --course writes all");
  }
  std::optional<PageFile> file;
  refuseUnknownName(options.scene);
  const auto folder = lessonNamed(options.scene);
  PageContent content =
      folder ? lessonPage(*folder, options, console, file) : scenePage(options, console, file);
  content.embed = options.embed;
  if (!options.language.empty()) content.language = options.language;
  file->write(content, !options.no_live);
}

std::string readLanguage(const std::string& text) {
  constexpr std::array<std::string_view, 3> kLanguages = {"en", "de", "fr"};
  if (isAmong(text, kLanguages)) return text;
  throw UsageError(fmt::format("--language must be en, de or fr, but is '{}'{}", text,
                               didYouMean(text, kLanguages)));
}

}  // namespace

void addLessonCommand(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand(
      "lesson", "Write a page that plays, steps and explains, for a browser");
  command->footer(kLessonExamples);
  const auto options = std::make_shared<LessonOptions>();
  addSceneOptions(*command, *options);
  command->get_option("SCENE")->required(false);
  addOutputOption(
      *command, "-o,--output", "FILE.html",
      [options](const std::string& s) { options->output = readPath("--output", s); },
      "The page; by default frames/NAME/lesson.html; - is the standard output. Of --course: a "
      "folder, by default course");
  command->add_flag("--course", options->course, "All lessons, and a page that lists them");
  addOption(
      *command, "--language", "en|de|fr",
      [options](const std::string& s) { options->language = readLanguage(s); },
      "Of the page's own words; the text of a lesson stays as it is");
  command->add_flag("--embed", options->embed,
                    "A compact page for slides, notebooks and frames in other pages");
  command->add_flag("--no-live", options->no_live,
                    "Leave the engine out (1 MB): the page plays the prepared run, and nobody "
                    "can take it over");
  addGeneralOptions(*command, *options);
  command->callback([&action, options] { action = [options] { run(*options); }; });
}

}  // namespace merge2d
