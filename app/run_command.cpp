#include <memory>

#include "app/commands.h"
#include "app/console.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/simulation.h"
#include "app/summary.h"

namespace merge2d {
namespace {

struct RunOptions : SceneOptions {
  bool no_timings = false;
};

void simulate(const RunOptions& options) {
  const Console console(options);
  catchInterrupts();
  Simulation simulation(loadScene(options, console),
                        {.mode = options.mode, .timings = !options.no_timings});
  Summary summary;
  Snapshot snapshot;
  Progress progress(console, "step", simulation.steps());
  while (!simulation.done()) {
    simulation.step();
    simulation.world().capture(snapshot);
    summary.add(snapshot);
    progress.update(simulation.world().steps());
  }
  print(options.json ? summary.json(simulation, !options.no_timings)
                     : summary.table(simulation, !options.no_timings));
}

}  // namespace

void addRunCommand(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("run", "Simulate a scene without pictures");
  const auto options = std::make_shared<RunOptions>();
  addSceneOptions(*command, *options);
  command->add_flag("--no-timings", options->no_timings, "Leave out measured seconds");
  command->callback([&action, options] { action = [options] { simulate(*options); }; });
}

}  // namespace merge2d
