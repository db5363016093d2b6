#include "lessons/lesson.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "lessons/body_named.h"
#include "lessons/folder.h"
#include "lessons/markdown.h"
#include "src2d/core/error.h"
#include "src2d/core/suggest.h"
#include "src2d/core/utf8.h"
#include "src2d/scene/builtin_title.h"
#include "src2d/scene/load.h"
#include "src2d/scene/toml_parse.h"
#include "src2d/trace/json_text.h"

namespace merge2d {

namespace fs = std::filesystem;

/// The files, which values and their errors point into.
struct Lesson::Source {
  explicit Source(const DataFolder& folder)
      : toml_text(folder.read("lesson.toml")),
        prose_text(escaped(folder.read("text.md"), "\t\n\r")),
        toml(folder.pathOf("lesson.toml").string(), toml_text),
        prose(folder.pathOf("text.md").string(), prose_text),
        table(parseToml(toml)) {
    for (const auto& [key, node] : table) {
      if (key.str() != "title") refuseControls(node);  // which becomes one line of text
    }
  }

  /// Text for a page and for terminals, of lines and tabs at most.
  void refuseControls(const toml::node& node) const {
    if (const auto* texts = node.as_table()) {
      for (const auto& entry : *texts) refuseControls(entry.second);
    } else if (const auto* list = node.as_array()) {
      for (const toml::node& element : *list) refuseControls(element);
    } else if (const auto* text = node.as_string()) {
      const std::string& words = text->get();
      if (escaped(words, "\t\n\r") == words) return;
      toml.fail(node.source(), "a text has no control characters but ends of lines and tabs");
    }
  }

  std::string toml_text, prose_text;
  SourceText toml, prose;
  toml::table table;
};

namespace {

constexpr std::array<std::string_view, 9> kLayers = {
    "contacts", "forces", "graph", "boxes", "heat", "velocities", "ghost", "labels", "beside"};

constexpr std::array kModes = {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep};

Mode modeOf(const Value& value) {
  const std::string word = value.text();
  std::vector<std::string_view> names;
  for (const Mode mode : kModes) {
    if (word == name(mode)) return mode;
    names.emplace_back(name(mode));
  }
  value.fail(fmt::format("'{}' is no mode{}; there are {}", word, didYouMean(word, names),
                         fmt::join(names, ", ")));
}

std::string stageOf(const Value& value) {
  const std::string word = value.text();
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kStages; ++i) names.emplace_back(name(static_cast<Stage>(i)));
  if (std::find(names.begin(), names.end(), word) == names.end()) {
    value.fail(fmt::format("Algorithm 1 has no stage '{}'{}", word, didYouMean(word, names)));
  }
  return word;
}

/// Reads a folder into a lesson.
class Loader {
 public:
  explicit Loader(const DataFolder& folder) : folder_(folder) {
    for (const char* file : {"lesson.toml", "text.md"}) {
      if (folder.holds(file)) continue;
      throw InputError(
          fmt::format("{}: a lesson's folder holds lesson.toml and text.md, but {} is "
                      "missing",
                      folder.path().string(), file));
    }
    source_ = std::make_shared<Lesson::Source>(folder);
    lesson_.source = source_;
  }

  Lesson load() {
    TableReader top(source_->toml, source_->table, "the lesson");
    readHead(top);
    readTraces(top);
    readParts(top);
    for (TableReader& table : top.tables("expect")) {
      lesson_.expectations.emplace_back(table, lesson_.traces);
    }
    top.done();
    return std::move(lesson_);
  }

 private:
  void readHead(TableReader& top) {
    if (const auto format = top.require("format")) format->integer({1, 1, "1"});
    if (const auto title = top.require("title")) lesson_.title = asOneLine(title->text());
    top.read("summary", lesson_.summary);
    top.read("minutes", lesson_.minutes, {1, 120, "between 1 and 120"});
    const fs::path path = fs::absolute(folder_.path()).lexically_normal();
    std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
    const bool numbered = name.size() > 3 &&
                          std::isdigit(static_cast<unsigned char>(name[0])) != 0 &&
                          std::isdigit(static_cast<unsigned char>(name[1])) != 0 && name[2] == '_';
    lesson_.name = asOneLine(numbered ? name.substr(3) : name);
  }

  void readTraces(TableReader& top) {
    LessonTrace first{.label = "as it is", .mode = Mode::MergeSleep, .scene = {}, .scene_name = {}};
    if (const auto mode = top.get("mode")) first.mode = modeOf(*mode);
    const auto named = top.require("scene");
    if (!named) top.done();
    first.scene_name = sceneNamed(*named);
    const double seconds = secondsOf(top).value_or(0.0);  // 0: the scene's own
    load(first, {}, seconds);
    for (TableReader& table : top.tables("trace")) {
      LessonTrace trace{.label = "", .mode = first.mode, .scene = {}, .scene_name = {}};
      if (const auto label = table.require("label")) trace.label = newLabel(*label);
      if (const auto mode = table.get("mode")) trace.mode = modeOf(*mode);
      const auto own = table.get("scene");
      trace.scene_name = own ? sceneNamed(*own) : first.scene_name;
      const bool same = trace.scene_name == first.scene_name;
      const double usual = same ? seconds : 0.0;
      const Overrides overrides = readOverrides(table);
      const double lasts = secondsOf(table).value_or(usual);
      table.done();
      load(std::move(trace), overrides, lasts);
    }
  }

  static std::optional<double> secondsOf(TableReader& table) {
    const auto seconds = table.get("seconds");
    if (!seconds) return std::nullopt;
    return seconds->number({1e-3, 600, "between 0.001 and 600"});
  }

  void load(LessonTrace trace, const Overrides& overrides, double seconds) {
    const std::string wanted = trace.scene_name;
    trace.scene = folder_.holds(wanted) ? loadSceneFile(folder_, wanted, overrides)
                                        : loadScene(wanted, overrides);
    if (seconds > 0.0) trace.scene.duration = seconds;
    trace.world = static_cast<std::size_t>(std::ranges::find(scenes_, wanted) - scenes_.begin());
    if (trace.world == scenes_.size()) scenes_.push_back(wanted);
    labels_.push_back(trace.label);
    lesson_.traces.push_back(std::move(trace));
  }

  /// A file of the folder, or the name of a built-in scene.
  std::string sceneNamed(const Value& named) const {
    std::string wanted = named.text();
    if (folder_.holds(wanted)) return wanted;
    if (wanted.find('.') != std::string::npos) {
      named.fail(fmt::format("there is no file '{}' in the lesson's folder", wanted));
    }
    const std::vector<BuiltinScene> builtin = builtinScenes();
    std::vector<std::string_view> names;
    for (const BuiltinScene& scene : builtin) names.emplace_back(scene.name);
    if (std::ranges::find(names, wanted) == names.end()) {
      named.fail(
          fmt::format("there is no built-in scene '{}'{}", wanted, didYouMean(wanted, names)));
    }
    return wanted;
  }

  std::string newLabel(const Value& label) const {
    const std::string text = label.text();
    if (std::find(labels_.begin(), labels_.end(), text) != labels_.end()) {
      label.fail(fmt::format("there is another trace '{}'", text));
    }
    return text;
  }

  static Overrides readOverrides(TableReader& table) {
    Overrides overrides;
    const auto set = table.get("set");
    if (!set) return overrides;
    for (const Value& one : set->elements("[\"key=value\"]")) {
      const std::string text = one.text();
      const std::size_t at = text.find('=');
      if (at == std::string::npos) one.fail("it should read \"key=value\", as after --set");
      overrides.emplace_back(text.substr(0, at), text.substr(at + 1));
    }
    return overrides;
  }

  void readParts(TableReader& top) {
    std::vector<Section> sections = sectionsOf(source_->prose_text);
    lesson_.intro = markdownToHtml(sections.front().text);
    sections.erase(sections.begin());
    std::vector<TableReader> tables = top.tables("part");
    if (tables.empty()) top.fail("a lesson has at least one [[part]]");
    std::vector<std::string> titles;
    for (const Section& section : sections) titles.push_back(section.title);
    for (TableReader& table : tables) readPart(table, sections, titles);
    for (const Section& section : sections) {
      const bool used = std::any_of(lesson_.parts.begin(), lesson_.parts.end(),
                                    [&](const LessonPart& p) { return p.title == section.title; });
      if (used) continue;
      throw InputError(source_->prose.message(
          {static_cast<toml::source_index>(section.line), 1},
          fmt::format("lesson.toml has no [[part]] with section = \"{}\"", section.title)));
    }
  }

  void readPart(TableReader& table, const std::vector<Section>& sections,
                const std::vector<std::string>& titles) {
    const auto section = table.require("section");
    const auto at = table.require("at");
    if (!section || !at) table.done();
    const std::size_t trace = traceOf(table);
    LessonPart part{.title = section->text(),
                    .html = {},
                    .at = Moment(*at, lesson_.traces[trace].scene),
                    .stage = {},
                    .layers = {},
                    .select = {},
                    .trace = trace,
                    .questions = {}};
    const auto found = std::find(titles.begin(), titles.end(), part.title);
    if (found == titles.end()) {
      section->fail(fmt::format("text.md has no section '## {}'{}", part.title,
                                didYouMean(part.title, titles)));
    }
    part.html = markdownToHtml(sections[static_cast<std::size_t>(found - titles.begin())].text);
    if (const auto stage = table.get("stage")) part.stage = stageOf(*stage);
    if (const auto layers = table.get("layers")) {
      for (const Value& layer : layers->elements("[\"contacts\", \"forces\"]")) {
        if (std::find(kLayers.begin(), kLayers.end(), layer.text()) == kLayers.end()) {
          layer.fail(fmt::format("there is no layer '{}'{}; there are {}", layer.text(),
                                 didYouMean(layer.text(), kLayers), fmt::join(kLayers, ", ")));
        }
        part.layers.push_back(layer.text());
      }
    }
    if (const auto select = table.get("select")) readSelection(*select, part);
    readQuestions(table, part);
    table.done();
    lesson_.parts.push_back(std::move(part));
  }

  /// The run that a part shows.
  std::size_t traceOf(TableReader& table) const {
    const auto trace = table.get("trace");
    if (!trace) return 0;
    const auto label = std::find(labels_.begin(), labels_.end(), trace->text());
    if (label == labels_.end()) {
      trace->fail(fmt::format("the lesson has no trace '{}'{}", trace->text(),
                              didYouMean(trace->text(), labels_)));
    }
    return static_cast<std::size_t>(label - labels_.begin());
  }

  /// [part.question], or several of them in [[part.questions]].
  void readQuestions(TableReader& table, LessonPart& part) const {
    const Scene& scene = lesson_.traces[part.trace].scene;
    if (auto question = table.table("question")) part.questions.emplace_back(*question, scene);
    for (TableReader& question : table.tables("questions")) {
      part.questions.emplace_back(question, scene);
    }
  }

  void readSelection(const Value& value, LessonPart& part) const {
    const Scene& scene = lesson_.traces[part.trace].scene;
    for (const Value& wanted : value.elements("[\"a body\"] or [\"a\", \"b\"]")) {
      part.select.push_back(bodyNamed(wanted, scene, wanted.text()));
    }
    if (part.select.empty() || part.select.size() > 2) value.fail("it names a body, or a pair");
    std::sort(part.select.begin(), part.select.end());
  }

  DataFolder folder_;
  std::shared_ptr<Lesson::Source> source_;
  std::vector<std::string> labels_;
  std::vector<std::string> scenes_;  ///< the different ones, by their names
  Lesson lesson_;
};

}  // namespace

Lesson loadLesson(const DataFolder& folder) { return Loader(folder).load(); }

namespace {

/// The steps of a trace that a lesson shows or asks about; moments that do not happen have none.
std::vector<std::int64_t> stepsShown(const Lesson& lesson, std::size_t trace,
                                     const Recording& recording) {
  std::vector<std::int64_t> out;
  for (const LessonPart& part : lesson.parts) {
    if (part.trace != trace) continue;
    if (const auto found = part.at.find(recording)) out.push_back(found->step);
    for (const Question& question : part.questions) {
      if (const auto found = question.reveal().find(recording)) out.push_back(found->step);
    }
  }
  return out;
}

}  // namespace

std::vector<Recording> recordLesson(const Lesson& lesson,
                                    const std::function<void(std::int64_t)>& progress) {
  std::vector<Recording> out;
  for (const LessonTrace& trace : lesson.traces) {
    const auto steps = std::llround(trace.scene.duration / trace.scene.step);
    out.push_back(
        record(trace.scene,
               {.mode = trace.mode, .detail = Detail::Full, .steps = steps, .progress = progress}));
    lookInside(out.back(), stepsShown(lesson, out.size() - 1, out.back()), progress);
  }
  return out;
}

std::vector<std::string> failures(const Lesson& lesson, const std::vector<Recording>& recordings) {
  std::vector<std::string> out;
  for (const Expectation& expectation : lesson.expectations) {
    if (auto failure = expectation.failure(recordings[expectation.trace()])) {
      out.push_back(std::move(*failure));
    }
  }
  return out;
}

std::string lessonJson(const Lesson& lesson, const std::vector<Recording>& recordings) {
  JsonText out;
  out.open('{').field("summary", lesson.summary).field("minutes", lesson.minutes);
  out.field("intro", lesson.intro);
  out.array("parts", lesson.parts, [&](const LessonPart& part) {
    const Recording& recording = recordings[part.trace];
    const std::int64_t step = part.at.in(recording).step;
    out.open('{').field("title", part.title).field("html", part.html).field("step", step);
    out.field("stage", part.stage).field("trace", part.trace);
    out.array("layers", part.layers, [&](const std::string& layer) { out.value(layer); });
    out.array("select", part.select, [&](BodyId b) { out.value(b); });
    out.array("questions", part.questions,
              [&](const Question& question) { question.write(out, recording, step); });
    out.close('}');
  });
  out.close('}');
  return std::string(out.text());
}

std::vector<BuiltinLesson> builtinLessons() {
  std::map<std::string, DataFolder> folders;  // by their names
  for (const DataFolder& all : lessonFolders()) {
    for (const std::string& entry : all.entries()) {
      if (all.folder(entry).holds("lesson.toml")) folders.try_emplace(entry, all.folder(entry));
    }
  }
  std::vector<BuiltinLesson> lessons;
  for (const auto& [entry, folder] : folders) {
    const std::string name = entry.substr(entry.find('_') + 1);
    try {
      const auto title = titleOf(folder, "lesson.toml", embeddedLessons());
      lessons.push_back({name, title.value_or(name), folder});
    } catch (const std::runtime_error&) {
      lessons.push_back({name, name, folder});
    }
  }
  return lessons;
}

}  // namespace merge2d
