#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/console.h"
#include "app/interrupt.h"
#include "app/output_file.h"
#include "app/progress.h"
#include "app/provenance.h"
#include "app/reference_end.h"
#include "app/simulation.h"
#include "app/summary.h"
#include "app/usage_error.h"
#include "src2d/core/error.h"
#include "src2d/scene/file.h"
#include "src2d/state_file.h"
#include "src2d/trace/csv.h"
#include "src2d/trace/trace_writer.h"

namespace merge2d {
namespace {

constexpr const char* kRunExamples = R"(Examples:
  merge2d run tower-platform
  merge2d run pile --seconds 5 --mode reference --json
  merge2d run books --trace books.jsonl --decisions
  merge2d run pile --set merging.velocity=0.02 --csv pile.csv
  merge2d run spinner --trace - | head -n 2
  merge2d run tower-platform --steps 300 --snapshot hit.state
  merge2d run tower-platform --steps 600 --resume hit.state

Trace, CSV and snapshot files replace only files of their own kind, unless --force is given.)";

struct RunOptions : SceneOptions {
  std::string trace, csv;        ///< files, or empty
  std::string snapshot, resume;  ///< the same
  std::string reference_folder;  ///< the same
  int threads = 1;
  bool no_timings = false;
  bool decisions = false;
  bool reference_error = false;
};

void check(const RunOptions& options) {
  check(static_cast<const SceneOptions&>(options));
  if (options.decisions && options.trace.empty()) {
    throw UsageError("--decisions go into the trace; name it with --trace FILE.jsonl");
  }
  if (!options.reference_folder.empty() && !options.reference_error) {
    throw UsageError("--reference-folder keeps what --reference-error simulates; give both");
  }
  if (options.reference_error && !options.resume.empty()) {
    throw UsageError("--reference-error simulates from the start, and --resume does not");
  }
  requireDistinct(
      {{"--trace", options.trace}, {"--csv", options.csv}, {"--snapshot", options.snapshot}});
  if (options.snapshot == "-") throw UsageError("a snapshot is not written to the standard output");
  if (options.json && (options.trace == "-" || options.csv == "-")) {
    throw UsageError("--json and '-' would both write to the standard output");
  }
}

/// A trace in its file.
struct Trace {
  OutputFile file;
  TraceWriter writer;

  Trace(const RunOptions& options, const World& world)
      : file(options.trace, {.everything = options.force, .ours = kTraceStart}),
        writer(file.stream(), world.scene(), options.mode, world.bodies(),
               {.decisions = options.decisions, .timings = !options.no_timings}) {
    file.check();
  }
};

/// A table in its file.
struct Table {
  OutputFile file;
  CsvWriter writer;

  Table(const RunOptions& options, const Scene& scene)
      : file(options.csv, {.everything = options.force, .ours = kCsvStart}),
        writer(file.stream(), !options.no_timings, provenanceColumns(scene, options.mode)) {
    file.check();
  }
};

/// Everything that is written down while a run goes on.
class Record {
 public:
  Record(const RunOptions& options, const World& world) : summary_(world) {
    if (!options.trace.empty()) trace_.emplace(options, world);
    if (!options.csv.empty()) table_.emplace(options, world.scene());
    if (options.snapshot.empty()) return;
    state_.emplace(options.snapshot, Replaces{.everything = options.force, .ours = kStateStart});
    state_->check();
  }

  /// Takes note of the step that just ended.
  void add(const World& world) {
    summary_.add(world);
    if (!trace_ && !table_) return;
    trace_ ? world.capture(snapshot_) : world.captureMotion(snapshot_);
    if (trace_) trace_->writer.add(snapshot_), trace_->file.check();
    if (table_) table_->writer.add(snapshot_), table_->file.check();
  }

  /// The files appear.
  void finish() {
    if (trace_) trace_->file.finish();
    if (table_) table_->file.finish();
  }

  /// The state after the last step; only of a run that went well.
  void finish(const World& world) {
    finish();
    if (!state_) return;
    state_->stream() << world.save();
    state_->finish();
  }

  Summary& summary() { return summary_; }

 private:
  Summary summary_;
  Snapshot snapshot_;  ///< its memory is kept
  std::optional<Trace> trace_;
  std::optional<Table> table_;
  std::optional<OutputFile> state_;
};

/// Brings a fresh simulation to where a snapshot was taken.
void resume(const RunOptions& options, Simulation& simulation) {
  if (options.resume.empty()) return;
  constexpr std::size_t kMost = std::size_t{2} << 30;  // a hundred thousand bodies take a tenth
  const std::string bytes =
      readFile(options.resume, {.what = "a snapshot", .most = kMost, .start = kStateStart});
  simulation.resume(bytes, options.resume);
  if (!simulation.done()) return;
  throw UsageError(
      fmt::format("{} was taken after step {}, and the run ends with step {}; steps "
                  "count from the scene's start: ask for more with --steps",
                  options.resume, simulation.world().steps(), simulation.steps()));
}

void simulate(Simulation& simulation, Record& record, const Console& console) {
  Progress progress(console, "step", simulation.steps());
  while (!simulation.done()) {
    simulation.step();
    record.add(simulation.world());
    progress.update(simulation.world().steps());
  }
  console.detail(fmt::format("{:.3g} MB of memory for the simulation",
                             1e-6 * static_cast<double>(simulation.world().memoryBytes())));
}

/// How far the run ended from the reference, where that was asked for.
void judge(const RunOptions& options, const Simulation& simulation, Summary& summary) {
  if (!options.reference_error) return;
  const ReferenceFolder references(options.reference_folder);
  const BodyCenters end = centersOf(simulation.world());
  if (options.mode == Mode::Reference) {
    references.keep(simulation.world().scene(), simulation.steps(), end);
    summary.setError({});
    return;
  }
  summary.setError(errorBetween(references.endOf(simulation.shared(), simulation.steps()), end));
}

void report(const RunOptions& options, const Simulation& simulation, const Summary& summary) {
  const bool timings = !options.no_timings;
  if (options.json) {
    print(summary.json(simulation, timings));
  } else if (options.trace == "-" || options.csv == "-") {
    Console(options).note(summary.table(simulation, timings));
  } else {
    print(summary.table(simulation, timings));
  }
}

/// A look at the clock after each stage is a sixth of a step of two bodies: only for those who read
/// the times of stages.
bool timesStages(const RunOptions& options) {
  return !options.no_timings && !(options.trace.empty() && options.csv.empty());
}

void run(const RunOptions& options) {
  check(options);
  const Console console(options);
  catchInterrupts();
  Simulation simulation(std::make_shared<const Scene>(loadScene(options, console)),
                        {.mode = options.mode,
                         .timings = timesStages(options),
                         .decisions = options.decisions,
                         .threads = options.threads});
  if (!options.no_timings) simulation.measureProcessor();
  resume(options, simulation);
  Record record(options, simulation.world());
  try {
    simulate(simulation, record, console);
  } catch (const SimulationError&) {
    record.finish();  // what there is up to here helps to find out why
    report(options, simulation, record.summary());
    throw;
  }
  record.finish(simulation.world());
  judge(options, simulation, record.summary());
  report(options, simulation, record.summary());
}

}  // namespace

void addRunCommand(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("run", "Simulate a scene and print a summary");
  command->footer(kRunExamples);
  const auto options = std::make_shared<RunOptions>();
  addSceneOptions(*command, *options);
  addOption(
      *command, "--threads", "N",
      [options](const std::string& s) {
        options->threads = static_cast<int>(readInteger("--threads", s, 1, 64));
      },
      "Threads that share the work of each step, 1 unless given; the results are the same")
      ->group("Simulation");
  constexpr const char* kGroup = "Files";
  addOutputOption(
      *command, "--trace", "FILE.jsonl",
      [options](const std::string& s) { options->trace = readPath("--trace", s); },
      "Write every time step as a line of JSON; - is the standard output")
      ->group(kGroup);
  addOutputOption(
      *command, "--csv", "FILE.csv",
      [options](const std::string& s) { options->csv = readPath("--csv", s); },
      "Write a table with a row per time step")
      ->group(kGroup);
  addOutputOption(
      *command, "--snapshot", "FILE",
      [options](const std::string& s) { options->snapshot = readPath("--snapshot", s); },
      "Save the state after the last step, to continue from")
      ->group(kGroup);
  addOption(
      *command, "--resume", "FILE",
      [options](const std::string& s) { options->resume = readPath("--resume", s); },
      "Continue from a snapshot of the same scene and mode; steps count from the scene's start")
      ->group(kGroup);
  command
      ->add_flag("--decisions", options->decisions,
                 "Add every merge and unmerge decision to the trace")
      ->group(kGroup);
  command
      ->add_flag("--no-timings", options->no_timings,
                 "Leave out measured seconds, so that two runs give the same bytes")
      ->group(kGroup);
  command
      ->add_flag("--reference-error", options->reference_error,
                 "Simulate in reference mode too, and tell how far the bodies end from there")
      ->group(kGroup);
  addOption(
      *command, "--reference-folder", "DIR",
      [options](const std::string& s) {
        options->reference_folder = readPath("--reference-folder", s);
      },
      "Keep the ends of reference runs in this folder, and take them from there")
      ->group(kGroup);
  addGeneralOptions(*command, *options);
  command->callback([&action, options] { action = [options] { run(*options); }; });
}

}  // namespace merge2d
