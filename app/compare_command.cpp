#include <fmt/format.h>

#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/comparison.h"
#include "app/comparison_charts.h"
#include "app/comparison_report.h"
#include "app/console.h"
#include "app/folder_lock.h"
#include "app/interrupt.h"
#include "app/output_file.h"
#include "app/parse.h"
#include "app/picture_file.h"
#include "app/progress.h"
#include "app/render_options.h"
#include "app/simulation.h"
#include "app/usage_error.h"
#include "src2d/core/error.h"
#include "src2d/scene/names.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCompareExamples = R"(Examples:
  merge2d compare tower-platform
  merge2d compare dominoes --seconds 5 --json --no-charts
  merge2d compare tower-platform --window 1,5.9
  merge2d compare pile --csv pile.csv -o charts --theme print
  merge2d compare pile -o figures --format svg

The four modes take turns of 200 steps. Distances are those of the bodies' centres from where they
are in the reference; after a collapse they grow with chaos as well as with errors, so compare
also the bodies that tipped over (turned by 45 degrees), and when: the k-th in each mode against the
k-th in the reference. 'Creep' is how far bodies move on what they rest on, in each mode by itself.
'Welds gone in 20 steps' counts flicker: welds that formed and broke again.)";

struct CompareOptions : SceneOptions {
  std::string csv;     ///< file, or empty
  std::string folder;  ///< of the charts; empty: frames/<scene>/compare
  ChartStyle charts;
  std::optional<Window> window;
  bool no_charts = false;
  bool no_timings = false;
};

Window readWindow(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) {
    throw UsageError(
        fmt::format("--window needs FROM,TO in seconds, such as 1,5, but got '{}'", text));
  }
  const Window window{readNumber("--window FROM,TO", text.substr(0, comma), 0.0),
                      readNumber("--window FROM,TO", text.substr(comma + 1), 0.0)};
  if (window.to <= window.from) {
    throw UsageError(fmt::format("--window {}: it ends before it begins", text));
  }
  return window;
}

/// A window that the run does not reach would be empty.
void check(const Window& window, const Comparison& comparison) {
  const double end = static_cast<double>(comparison.steps()) * comparison.scene().step;
  if (window.to <= end + 0.5 * comparison.scene().step) return;
  throw UsageError(fmt::format("--window ends at {} s, but the run at {} s", window.to, end));
}

Theme readTheme(const std::string& text) {
  try {
    return themeByName(text);
  } catch (const InputError& error) {
    throw UsageError(error.what());
  }
}

bool readVector(const std::string& text) {
  if (text == "png" || text == "svg") return text == "svg";
  throw UsageError(fmt::format("--format must be one of png, svg, but is '{}'", text));
}

[[noreturn]] void refuseMode(const std::string& mode) {
  throw UsageError(fmt::format(
      "compare simulates all four modes and has no --mode; 'merge2d run SCENE --mode {}' simulates "
      "one, and --json or --csv has the numbers of each",
      valueOf<Mode>(mode) ? mode : "merge"));
}

void check(const CompareOptions& options) {
  check(static_cast<const SceneOptions&>(options));
  if (options.json && options.csv == "-") {
    throw UsageError("--json and '-' would both write to the standard output");
  }
  if (options.no_charts && !options.folder.empty()) {
    throw UsageError("--output is a folder for charts, which --no-charts leaves out");
  }
}

/// The files of a comparison: asked for before it begins, so that nobody waits for nothing.
class Products {
 public:
  Products(const CompareOptions& options, const Scene& scene)
      : options_(options),
        folder_(options.folder.empty() ? fs::path("frames") / scene.name / "compare"
                                       : fs::path(options.folder)) {
    std::vector<NamedOutput> outputs{{"--csv", options.csv}};
    const auto charts = chartFiles(folder_, !options.no_timings, options.charts.vector);
    if (!options.no_charts) {
      for (const fs::path& chart : charts) outputs.push_back({"--output", chart.string()});
    }
    requireDistinct(outputs);
    if (!options.csv.empty()) {
      csv_.emplace(options.csv, Replaces{.everything = options.force, .ours = kComparisonCsvStart});
    }
    if (options.no_charts) return;
    made_.emplace(folder_);
    lock_.emplace(folder_);
    for (const fs::path& chart : charts) requirePictureMayAppear(chart, options.force);
  }

  void writeTable(const Comparison& comparison) {
    if (csv_) csv_->stream() << comparisonCsv(comparison), csv_->finish();
  }

  /// The paths of the charts.
  std::vector<std::string> drawCharts(const Comparison& comparison) const {
    if (options_.no_charts) return {};
    return drawComparison(comparison, folder_, options_.charts);
  }

 private:
  const CompareOptions& options_;
  fs::path folder_;  ///< of the charts
  std::optional<OutputFile> csv_;
  std::optional<MadeFolder> made_;
  std::optional<FolderLock> lock_;
};

void simulate(Comparison& comparison, const Console& console) {
  Progress progress(console, "step", comparison.steps());
  while (!comparison.done()) {
    comparison.advance();
    progress.update(comparison.stepsDone());
  }
}

void compare(const CompareOptions& options) {
  check(options);
  const Console console(options);
  catchInterrupts();
  Comparison comparison(std::make_shared<const Scene>(loadScene(options, console)),
                        !options.no_timings);
  if (options.window) check(*options.window, comparison);
  Products products(options, comparison.scene());
  simulate(comparison, console);
  products.writeTable(comparison);
  if (!options.json && options.csv != "-") print(comparisonTable(comparison, options.window));
  const std::vector<std::string> charts = products.drawCharts(comparison);
  if (options.json) print(comparisonJson(comparison, options.window, charts));
  for (const std::string& chart : charts) console.note(chart);
}

}  // namespace

void addCompareCommand(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("compare", "Simulate a scene in all four modes, side by side");
  command->footer(kCompareExamples);
  const auto options = std::make_shared<CompareOptions>();
  addSceneOptions(*command, *options);
  command->remove_option(command->get_option("--mode"));
  addOption(  // not in the help: it tells those who try it
      *command, "--mode", "MODE", [](const std::string& mode) { refuseMode(mode); }, "")
      ->group("");
  addOption(
      *command, "--window", "FROM,TO",
      [options](const std::string& s) { options->window = readWindow(s); },
      "Also tell the means of a part of the run, in seconds")
      ->group("Simulation");
  constexpr const char* kGroup = "Files";
  addOutputOption(
      *command, "-o,--output", "DIR",
      [options](const std::string& s) { options->folder = readPath("--output", s); },
      "Folder of the charts time.png, counts.png and distance.png (default: "
      "frames/<scene>/compare)")
      ->group(kGroup);
  addOutputOption(
      *command, "--csv", "FILE.csv",
      [options](const std::string& s) { options->csv = readPath("--csv", s); },
      "Write a table with a row per mode and time step; - is the standard output")
      ->group(kGroup);
  addOption(
      *command, "--theme", "NAME",
      [options](const std::string& s) { options->charts.theme = readTheme(s); },
      "Colours of the charts: light (default), dark or print")
      ->group(kGroup);
  addOption(
      *command, "--format", "png|svg",
      [options](const std::string& s) { options->charts.vector = readVector(s); },
      "Charts as pictures (default), or as vector graphics for papers")
      ->group(kGroup);
  addContextOption(*command);
  command->add_flag("--no-charts", options->no_charts, "Draw no charts")->group(kGroup);
  command
      ->add_flag("--no-timings", options->no_timings,
                 "Leave out measured seconds, so that two runs give the same bytes")
      ->group(kGroup);
  addGeneralOptions(*command, *options);
  command->callback([&action, options] { action = [options] { compare(*options); }; });
}

}  // namespace merge2d
