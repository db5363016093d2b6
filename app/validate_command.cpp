#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "app/commands.h"
#include "app/console.h"
#include "app/doubts.h"
#include "app/json.h"
#include "app/lesson_source.h"
#include "app/load_doubts.h"
#include "app/output_file.h"
#include "app/simulation.h"
#include "app/usage_error.h"
#include "lessons/lesson.h"
#include "lessons/words.h"
#include "src2d/core/error.h"
#include "src2d/core/utf8.h"
#include "src2d/geometry/box.h"

namespace merge2d {
namespace {

constexpr const char* kValidateExamples = R"(Examples:
  merge2d validate tower.toml
  merge2d validate drawing.png --to scene.toml
  merge2d validate my-lesson/
  merge2d validate pile --json --set step=0.005)";

struct ValidateOptions : SceneOptions {
  std::string to;  ///< file for the text scene, or empty
};

/// The parts of a scene.
struct Inventory {
  std::map<Motion, int> motions;
  int held = 0;  ///< dynamic, but pinned at first
  std::size_t discs = 0, polygons = 0;
  int emitted = 0;    ///< bodies that appear later
  double mass = 0.0;  ///< of the dynamic bodies [kg]
  Aabb extent;
};

Inventory inventoryOf(const Scene& scene) {
  Inventory found;
  for (const BodyDesc& body : scene.bodies) {
    ++found.motions[body.motion];
    if (body.motion == Motion::Dynamic && body.pinned_until > 0.0) ++found.held;
    for (const ConvexShape& shape : body.shapes) {
      ++(std::holds_alternative<Circle>(shape) ? found.discs : found.polygons);
      found.extent.include(bounds(shape, Pose::at(body.at, body.angle)));
    }
    if (body.motion != Motion::Dynamic) continue;
    found.mass += body.mass.value_or(body.density * areaProperties(body.shapes).area);
  }
  for (const EmitterDesc& emitter : scene.emitters) found.emitted += emitter.count;
  return found;
}

/// The rows of the report: what, and how much of it.
std::string table(const Scene& scene, const Inventory& found) {
  std::string out = fmt::format("{}: {}\n", escaped(scene.name), escaped(scene.title));
  const auto row = [&](const char* what, const std::string& value) {
    out += fmt::format("  {:<10}{}\n", what, value);
  };
  const auto count = [&](const char* what, std::size_t number) {
    if (number > 0) row(what, std::to_string(number));
  };
  std::string motions;
  for (const auto& [motion, number] : found.motions) {
    motions += fmt::format("{}{} {}", motions.empty() ? ": " : ", ", number, name(motion));
  }
  if (found.held > 0) motions += fmt::format(" ({} of them held at first)", found.held);
  row("bodies", std::to_string(scene.bodies.size()) + motions);
  row("shapes",
      fmt::format("{}: {}, {}", found.discs + found.polygons, counted(found.discs, "disc", "discs"),
                  counted(found.polygons, "polygon", "polygons")));
  if (found.emitted > 0) {
    row("emitters",
        fmt::format("{}: {} later", scene.emitters.size(),
                    counted(static_cast<std::size_t>(found.emitted), "body", "bodies")));
  }
  count("springs", scene.springs.size());
  count("joints", scene.joints.size());
  count("impulses", scene.impulses.size());
  count("forces", scene.forces.size());
  count("magnets", scene.magnets.size());
  row("mass", fmt::format("{:.6g} kg of dynamic bodies", found.mass));
  if (!found.extent.empty()) {
    row("extent",
        fmt::format("x from {:.4g} to {:.4g} m, y from {:.4g} to {:.4g} m", found.extent.lower.x(),
                    found.extent.upper.x(), found.extent.lower.y(), found.extent.upper.y()));
  }
  row("gravity", fmt::format("{}, {} m/s^2", scene.gravity.x(), scene.gravity.y()));
  row("time",
      fmt::format("{:.6g} s, {} steps of {} s", scene.duration, stepCount(scene), scene.step));
  for (const std::string& warning : scene.warnings) {
    out += fmt::format("warning: {}\n", escaped(warning));
  }
  return out;
}

std::string json(const Scene& scene, const Inventory& found) {
  Json out;
  out["scene"] = scene.name;
  out["title"] = scene.title;
  out["bodies"] = scene.bodies.size();
  for (const Motion motion : {Motion::Dynamic, Motion::Pinned, Motion::Scripted}) {
    const auto number = found.motions.find(motion);
    out[name(motion)] = number == found.motions.end() ? 0 : number->second;
  }
  out["shapes"] = found.discs + found.polygons;
  out["springs"] = scene.springs.size();
  out["joints"] = scene.joints.size();
  out["impulses"] = scene.impulses.size();
  out["forces"] = scene.forces.size();
  out["magnets"] = scene.magnets.size();
  out["emitters"] = scene.emitters.size();
  out["emitted_bodies"] = found.emitted;
  out["mass"] = found.mass;
  out["gravity"] = {scene.gravity.x(), scene.gravity.y()};
  out["step"] = scene.step;
  out["duration"] = scene.duration;
  out["steps"] = stepCount(scene);
  out["seed"] = scene.seed;
  out["warnings"] = scene.warnings;
  return out.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// A folder with a lesson.toml, or the name of a built-in lesson.
std::optional<DataFolder> lessonToValidate(const std::string& name) {
  const auto scenes = builtinScenes();
  if (std::ranges::find(scenes, name, &BuiltinScene::name) != scenes.end()) return std::nullopt;
  return lessonNamed(name);
}

/// Whether the page's policy would leave a picture of the text away.
bool asksForPictures(const std::string& html) {
  for (std::size_t at = html.find("<img"); at != std::string::npos;
       at = html.find("<img", at + 1)) {
    if (html.find("src=\"data:", at) >= html.find('>', at)) return true;
  }
  return false;
}

/// Answers that a page would show too early, and pictures that it would not show.
std::vector<std::string> doubtsAbout(const Lesson& lesson, const std::vector<Recording>& runs) {
  std::vector<std::string> out;
  if (asksForPictures(lesson.intro)) out.emplace_back("text.md: a page shows no pictures of files");
  for (const LessonPart& part : lesson.parts) {
    if (asksForPictures(part.html)) {
      out.push_back(fmt::format("'{}': a page shows no pictures of files", part.title));
    }
    const Recording& run = runs[part.trace];
    const std::int64_t asked = part.at.in(run).step;
    for (const Question& question : part.questions) {
      const std::int64_t revealed = question.reveal().in(run).step;
      if (revealed > asked) continue;
      out.push_back(
          fmt::format("'{}': the answer is in the picture when the question is asked: "
                      "step {} is revealed at step {}",
                      part.title, asked, revealed));
    }
  }
  return out;
}

/// A lesson's folder: all that can be said without a reader.
void validateLesson(const DataFolder& folder, const ValidateOptions& options) {
  if (!options.to.empty() || options.json) {
    throw UsageError("--to and --json are for scenes; a lesson is checked in words");
  }
  const Lesson lesson = loadLesson(folder);
  const std::vector<Recording> runs = recordLesson(lesson);
  const Console console(options);
  for (const std::string& doubt : doubtsAbout(lesson, runs)) console.warn(doubt);
  const std::vector<std::string> failed = failures(lesson, runs);
  std::size_t questions = 0;
  for (const LessonPart& part : lesson.parts) questions += part.questions.size();
  print(fmt::format(
      "{}: {}\n  {}, {}, {}\n  {} of {} hold\n", escaped(lesson.name), escaped(lesson.title),
      counted(lesson.parts.size(), "part", "parts"), counted(questions, "question", "questions"),
      counted(lesson.traces.size(), "run", "runs"), lesson.expectations.size() - failed.size(),
      counted(lesson.expectations.size(), "expectation", "expectations")));
  if (!failed.empty()) throw InputError(failed.front());
}

void validate(const ValidateOptions& options) {
  check(options);
  if (const auto lesson = lessonToValidate(options.scene)) return validateLesson(*lesson, options);
  if (options.json && options.to == "-") {
    throw UsageError("--json and --to - would both write to the standard output");
  }
  const Console console(options);
  Scene scene = loadScene(options, Console({.json = false, .quiet = true, .verbose = false}));
  warnOfOverlaps(scene);
  warnOfWhatComesTooLate(scene);
  warnOfHaste(scene);
  warnOfWhatDoesNothing(scene);
  warnOfStrainedJoints(scene);
  warnOfSmallBodies(scene);
  warnOfHeavyLoads(scene);
  const Inventory found = inventoryOf(scene);
  if (!options.to.empty()) writeFile(options.to, toToml(scene), {.everything = options.force});
  if (options.json) {
    print(json(scene, found));
  } else if (options.to == "-") {
    console.note(table(scene, found));
  } else {
    print(table(scene, found));
  }
}

}  // namespace

void addValidateCommand(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("validate", "Check a scene or a lesson and say what is in it");
  command->footer(kValidateExamples);
  const auto options = std::make_shared<ValidateOptions>();
  addSceneOptions(*command, *options);
  addOutputOption(
      *command, "--to", "FILE.toml",
      [options](const std::string& s) { options->to = readPath("--to", s); },
      "Write it as a text scene; - is the standard output")
      ->group("Files");
  addGeneralOptions(*command, *options);
  command->callback([&action, options] { action = [options] { validate(*options); }; });
}

}  // namespace merge2d
