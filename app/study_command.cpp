#include <sched.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/called_name.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/folder_lock.h"
#include "app/interrupt.h"
#include "app/json.h"
#include "app/output_file.h"
#include "app/process_pool.h"
#include "app/program.h"
#include "app/progress.h"
#include "app/study_data.h"
#include "app/study_folder.h"
#include "app/study_report.h"
#include "app/usage_error.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStudyExamples = R"(Examples:
  merge2d study grid.toml -o thresholds               run what is missing, on all processors
  merge2d study grid.toml -o thresholds --list | parallel
  merge2d study grid.toml -o thresholds --only 17     one run, as each line of the list does
  merge2d study grid.toml -o thresholds --collect     thresholds/study.csv from the runs there are
  merge2d study --report thresholds                   thresholds/report.html

A study file names scenes, modes, seeds, and parameters with their values (docs/studies.md):
  scenes = ["tower-platform"]
  modes = ["reference", "merge+sleep"]
  seconds = 2.0
  [parameters]
  merging.velocity = [0.005, 0.01, 0.02]
  unmerging.velocity = { from = 0.01, to = 0.1, count = 5, scale = "log" }

Each run is a process of its own: one that crashes or runs out of memory is a row with its exit
code. Finished runs are not run again; those that failed are.)";

/// Runs by their numbers, from 1.
struct Interval {
  std::size_t first = 0, last = 0;
};

struct StudyOptions : MessageOptions {
  std::string file{};
  std::string folder{};  ///< empty: studies/<name>
  std::size_t jobs = 0;  ///< 0: as many as there are processors
  std::optional<Interval> only{};
  std::string report{};  ///< folder of a study, or empty
  bool list = false, collect = false, force = false;

  fs::path folderOrDefault() const {
    return folder.empty() ? fs::path("studies") / fs::path(file).stem() : fs::path(folder);
  }
};

Interval readInterval(const std::string& text) {
  constexpr auto kMost = static_cast<std::int64_t>(Study::kMostRuns);
  const std::size_t dash = text.find('-');
  const std::int64_t first = readInteger("--only", text.substr(0, dash), 1, kMost);
  const std::int64_t last =
      dash == std::string::npos ? first : readInteger("--only", text.substr(dash + 1), 1, kMost);
  if (last < first) {
    throw UsageError(fmt::format("--only {}: the last run comes before the first", text));
  }
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

void check(const StudyOptions& options) {
  check(static_cast<const MessageOptions&>(options));
  if (!options.report.empty()) {
    if (options.file.empty() && options.folder.empty()) return;
    throw UsageError("--report DIR draws what the folder of a study has, and needs no study file");
  }
  if (options.file.empty()) throw UsageError("study needs a study file, such as grid.toml");
  if (int{options.list} + int{options.collect} + int{options.only.has_value()} > 1) {
    throw UsageError("--list, --collect and --only exclude each other");
  }
}

/// As many as this process may use, which a job of a cluster has fewer of than its machine.
std::size_t processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return static_cast<std::size_t>(std::max(1, CPU_COUNT(&set)));
}

std::string shellCommand(const std::vector<std::string>& words) {
  std::string line = shellQuoted(calledName());
  for (const std::string& word : words) line += " " + shellQuoted(word);
  return line;
}

/// The first line of a process's error messages.
std::string firstError(const ProcessEnd& end) {
  if (end.timed_out) return "it took longer than its time limit";
  const std::size_t at = end.err.find("error: ");
  if (at == std::string::npos) {
    return end.exit_code > 128 ? fmt::format("signal {} ended it", end.exit_code - 128) : "";
  }
  return end.err.substr(at + 7, end.err.find('\n', at) - at - 7);
}

/// A study with its runs and their rows.
class Runs {
 public:
  explicit Runs(const StudyOptions& options)
      : folder_(options.folderOrDefault()),
        study_(readStudy(options.file)),
        runs_(runsOf(study_)),
        keys_(study_) {}

  const Study& study() const { return study_; }
  const std::vector<StudyRun>& all() const { return runs_; }
  const fs::path& folder() const { return folder_; }
  std::vector<StudyRow>& rows() { return rows_; }

  /// Reads the rows there are.
  void readRows() {
    rows_.assign(runs_.size(), {});
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (auto row = readRow(folder_, keys_.of(runs_[i]))) rows_[i] = *std::move(row);
    }
  }

  /// The arguments of the process of a run.
  std::vector<std::string> processArguments(std::size_t run) const {
    std::vector<std::string> words = argumentsOf(study_, runs_[run]);
    if (study_.reference_error) {
      words.insert(words.end(), {"--reference-folder", endsFolder(folder_).string()});
    }
    return words;
  }

  /// Makes the row of a process that ended, and keeps it.
  void keep(const ProcessEnd& end) {
    StudyRow row{.key = keys_.of(runs_[end.task]), .command = {"merge2d"}};
    for (std::string& word : argumentsOf(study_, runs_[end.task])) {
      row.command.push_back(std::move(word));
    }
    row.exit_code = end.exit_code;
    row.message = end.exit_code == 0 ? "" : firstError(end);
    row.wall_seconds = end.wall_seconds;
    row.cpu_seconds = end.cpu_seconds;
    row.memory_bytes = end.memory_bytes;
    row.result = Json::parse(end.out, nullptr, false);
    if (row.result.is_discarded()) row.result = nullptr;
    writeRow(folder_, row);
    rows_[end.task] = std::move(row);
  }

 private:
  fs::path folder_;
  Study study_;
  std::vector<StudyRun> runs_;
  RunKeys keys_;
  std::vector<StudyRow> rows_;
};

/// A line for each run, which a shell can carry out on any machine that sees the folder.
void list(const StudyOptions& options) {
  const Runs runs(options);
  for (std::size_t i = 0; i < runs.all().size(); ++i) {
    const std::vector<std::string> one = {"study",    options.file,
                                          "--output", runs.folder().string(),
                                          "--only",   fmt::format("{}", i + 1),
                                          "--quiet"};
    print(fmt::format("{}  # {}\n", shellCommand(one),
                      shellCommand(argumentsOf(runs.study(), runs.all()[i]))));
  }
}

/// The runs that are not finished, of those asked for.
std::vector<std::size_t> unfinished(const StudyOptions& options, Runs& runs) {
  std::vector<std::size_t> open;
  const std::size_t count = runs.all().size();
  const Interval asked = options.only.value_or(Interval{1, count});
  if (asked.first > count) {
    throw UsageError(
        fmt::format("--only begins with run {}, but the study has {}", asked.first, count));
  }
  for (std::size_t i = asked.first - 1; i < std::min(asked.last, count); ++i) {
    if (!runs.rows()[i].finished()) open.push_back(i);
  }
  return open;
}

/// Runs them; `ended` is told of each whose row is kept.
void runAll(const StudyOptions& options, Runs& runs, const std::vector<std::size_t>& open,
            const Console& console, const std::function<void(std::size_t)>& ended) {
  const std::size_t jobs = options.jobs > 0 ? options.jobs : processors();
  ProcessPool pool(std::min(jobs, std::max<std::size_t>(open.size(), 1)), runs.study().time_limit);
  Progress progress(console, "run", static_cast<std::int64_t>(open.size()));
  auto next = open.begin();
  std::int64_t done = 0;
  while (next != open.end() || !pool.idle()) {
    if (next != open.end() && !pool.full()) {
      stopIfInterrupted();
      pool.start(*next, runs.processArguments(*next));
      ++next;
      continue;
    }
    const ProcessEnd end = pool.wait();
    runs.keep(end);
    ended(end.task);
    progress.update(++done);
  }
}

/// The summary at the end.
void report(const StudyOptions& options, Runs& runs, std::size_t ran, const Console& console) {
  std::size_t finished = 0, failed = 0;
  for (std::size_t i = 0; i < runs.rows().size(); ++i) {
    const StudyRow& row = runs.rows()[i];
    if (row.key.empty()) continue;
    if (row.finished()) {
      ++finished;
      continue;
    }
    constexpr std::size_t kMostNamed = 10;
    if (++failed > kMostNamed) continue;
    console.warn(fmt::format("run {} failed with exit code {}: {}", i + 1, row.exit_code,
                             row.message.empty() ? "no message" : row.message));
  }
  const std::string csv = (runs.folder() / "study.csv").string();
  if (options.json) {
    Json json{{"runs", runs.all().size()},
              {"finished", finished},
              {"failed", failed},
              {"ran", ran},
              {"csv", csv}};
    print(json.dump() + "\n");
  } else {
    print(fmt::format("{} runs: {} finished, {} failed, {} missing; {} of them ran now\n",
                      runs.all().size(), finished, failed, runs.all().size() - finished - failed,
                      ran));
  }
  console.note(csv);
  if (failed > 0) {
    throw SimulationError(fmt::format("{} of {} runs failed; run the study again to repeat them",
                                      failed, runs.all().size()));
  }
}

/// One process among several, on any machine: it writes rows and nothing that others write, too.
void runOnly(const StudyOptions& options, Runs& runs, const Console& console) {
  const std::vector<std::size_t> open = unfinished(options, runs);
  std::size_t failed = 0;
  runAll(options, runs, open, console, [&](std::size_t run) {
    const StudyRow& row = runs.rows()[run];
    if (row.finished()) return;
    ++failed;
    console.warn(
        fmt::format("run {} failed with exit code {}: {}", run + 1, row.exit_code, row.message));
  });
  if (failed > 0) throw SimulationError(fmt::format("{} of {} runs failed", failed, open.size()));
}

void drawReport(const StudyOptions& options) {
  const fs::path file = fs::path(options.report) / "report.html";
  writeFile(file.string(), studyReport(StudyData(options.report)),
            {.everything = options.force, .ours = "<!DOCTYPE html>"});
  if (options.json) print(Json{{"report", file.string()}}.dump() + "\n");
  Console(options).note(file.string());
}

void study(const StudyOptions& options) {
  check(options);
  if (!options.report.empty()) return drawReport(options);
  if (options.list) return list(options);
  const Console console(options);
  catchInterrupts();
  Runs runs(options);
  prepareStudyFolder(runs.folder(), runs.study(), options.force);
  runs.readRows();
  if (options.only) return runOnly(options, runs, console);
  const FolderLock lock(runs.folder());
  const auto open = options.collect ? std::vector<std::size_t>() : unfinished(options, runs);
  for (const std::size_t run : open) runs.rows()[run] = {};  // which failed, and is redone
  GrowingTable table(runs.folder() / "study.csv", runs.study(), runs.all(), runs.rows());
  try {
    runAll(options, runs, open, console, [&](std::size_t run) { table.add(run); });
  } catch (const Interrupted&) {
    table.finish();
    throw;
  }
  table.finish();
  report(options, runs, open.size(), console);
}

}  // namespace

void addStudyCommand(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("study", "Run a scene many times, with parameters that vary");
  command->footer(kStudyExamples);
  const auto options = std::make_shared<StudyOptions>();
  command->add_option("FILE", options->file, "A study file: a grid or a random design")
      ->type_name("");
  constexpr const char* kGroup = "Study";
  addOutputOption(
      *command, "-o,--output", "DIR",
      [options](const std::string& s) { options->folder = readPath("--output", s); },
      "Folder of the rows and of study.csv (default: studies/<name>)")
      ->group(kGroup);
  addOption(
      *command, "-j,--jobs", "N",
      [options](const std::string& s) {
        options->jobs = static_cast<std::size_t>(readInteger("--jobs", s, 1, 4096));
      },
      "So many runs at a time (default: one per processor)")
      ->group(kGroup);
  command
      ->add_flag("--list", options->list,
                 "Print a command for each run, for GNU parallel, Slurm or Snakemake")
      ->group(kGroup);
  addOption(
      *command, "--only", "N[-M]",
      [options](const std::string& s) { options->only = readInterval(s); },
      "Run these of the list, beside other processes; study.csv is left alone")
      ->group(kGroup);
  command->add_flag("--collect", options->collect, "Run nothing; write study.csv")->group(kGroup);
  addOption(
      *command, "--report", "DIR",
      [options](const std::string& s) { options->report = readPath("--report", s); },
      "Draw the charts of the study in this folder as one page, report.html")
      ->group(kGroup);
  command->add_flag("--force", options->force, "Use a folder that has other files in it")
      ->group("General");
  addMessageOptions(*command, *options);
  command->callback([&action, options] { action = [options] { study(*options); }; });
}

}  // namespace merge2d
