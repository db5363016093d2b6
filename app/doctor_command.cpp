#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/ffmpeg.h"
#include "app/render_options.h"
#include "render/canvas.h"
#include "render/context.h"
#include "src2d/core/error.h"
#include "src2d/scene/load.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

/// One thing that merge2d builds on.
struct Check {
  std::string name;
  bool works = false;
  bool needed = true;
  std::string detail;                 ///< what was found, or what is wrong and how to mend it
  const char* otherwise = "missing";  ///< in a word, when it does not work and is not needed
};

/// Turns what `look` throws into a failed check; `remedy` says what to do about it.
template <class F>
Check attempt(const std::string& name, const std::string& remedy, F&& look) {
  try {
    return {name, true, true, look()};
  } catch (const std::exception& error) {
    return {name, false, true, fmt::format("{}; {}", error.what(), remedy)};
  }
}

bool hasFonts() {
  try {
    fontFile(Weight::Regular);
    return true;
  } catch (const IoError&) {
    return false;
  }
}

/// Draws a red picture and looks whether it is one. The context comes from where --context says.
/// Without fonts nothing is drawn, but OpenGL is not to blame.
std::string checkDrawing() {
  if (!hasFonts()) return Context().description() + "; not tried, as there is no font";
  Canvas canvas(64, 64);
  Drawing drawing;
  drawing.background = Color{255, 0, 0, 255};
  if (canvas.draw(drawing).at(32, 32) != Color{255, 0, 0, 255}) {
    throw IoError("the pixels of a test picture are wrong");
  }
  return canvas.description();
}

/// Sets a letter.
std::string checkFont(Weight weight) {
  const fs::path file = fontFile(weight);
  Text().width("x", {.size = 12, .weight = weight});
  return file.string();
}

/// Whether a library can draw, be it the one in use or not.
Check checkContext(const char* name, ContextKind kind) {
  const std::optional<ContextKind> chosen = chosenContext();
  chooseContext(kind);
  Check check = attempt(name, "only --context needs it", checkDrawing);
  chooseContext(chosen);
  check.needed = false;
  return check;
}

std::string checkScenes() {
  const std::size_t scenes = builtinScenes().size();
  if (scenes == 0) throw IoError("there are no built-in scenes");
  return fmt::format("{} built-in", scenes);
}

/// Where frames go unless -o says otherwise.
Check checkFolder() {
  const fs::path folder = fs::exists("frames") ? "frames" : ".";
  const std::string where = fs::weakly_canonical(folder).string();
  const fs::path probe = folder / fmt::format(".merge2d-doctor-{}", getpid());
  const bool writable = std::ofstream(probe).good();  // rights do not tell of every file system
  std::error_code ignored;
  fs::remove(probe, ignored);
  if (writable) return {"folder", true, true, where};
  return {"folder", false, false, fmt::format("{}; use --output DIR", where), "read-only"};
}

Check checkFfmpeg() {
  const auto program = findFfmpeg();
  return {"ffmpeg", program.has_value(), false,
          program ? program->string()
                  : "not installed; only --format gif and mp4 need it (apt-get install ffmpeg)"};
}

std::vector<Check> examine() {
  const std::string font_remedy = "install fonts-dejavu-core";
  return {attempt("OpenGL", "nothing can be drawn here", checkDrawing),
          checkContext("OSMesa", ContextKind::Osmesa),
          checkContext("EGL", ContextKind::Egl),
          attempt("font", font_remedy, [] { return checkFont(Weight::Regular); }),
          attempt("bold font", font_remedy, [] { return checkFont(Weight::Bold); }),
          attempt("scenes", "set MERGE2D_SCENES to their folder", checkScenes),
          checkFolder(),
          checkFfmpeg(),
          {"processors", true, false, std::to_string(std::thread::hardware_concurrency())}};
}

std::string table(const std::vector<Check>& checks) {
  std::string out = "merge2d " MERGE2D_VERSION "\n";
  for (const Check& check : checks) {
    const char* verdict = check.works ? "ok" : check.needed ? "FAILED" : check.otherwise;
    out += fmt::format("{:<12}{:<11}{}\n", check.name, verdict, check.detail);
  }
  return out;
}

std::string json(const std::vector<Check>& checks) {
  nlohmann::ordered_json out;
  out["version"] = MERGE2D_VERSION;
  out["checks"] = nlohmann::ordered_json::array();
  for (const Check& check : checks) {
    out["checks"].push_back({{"name", check.name},
                             {"ok", check.works},
                             {"needed", check.needed},
                             {"detail", check.detail}});
  }
  return out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void examine(const MessageOptions& options) {
  check(options);
  const std::vector<Check> checks = examine();
  print(options.json ? json(checks) : table(checks));
  const auto failed = std::ranges::count_if(
      checks, [](const Check& check) { return check.needed && !check.works; });
  if (failed > 0) {
    throw IoError(fmt::format("{} of {} checks failed", failed, checks.size()));
  }
}

}  // namespace

void addDoctorCommand(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("doctor", "Tell what works here: drawing, fonts, ffmpeg, folders");
  command->footer("Examples:\n  merge2d doctor\n  merge2d doctor --json");
  const auto options = std::make_shared<MessageOptions>();
  addContextOption(*command);
  addMessageOptions(*command, *options);
  command->callback([&action, options] { action = [options] { examine(*options); }; });
}

}  // namespace merge2d
