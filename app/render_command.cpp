#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>

#include "app/commands.h"
#include "app/console.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/simulation.h"
#include "render/sequence.h"

namespace merge2d {
namespace {

struct RenderOptions : SceneOptions {
  std::string folder;  ///< default: frames/<scene>
  int fps = 30;
  FrameStyle style;
};

/// The number of the step that frame `k` shows: the first one whose time is at least k / fps,
/// within half a step.
std::int64_t stepOfFrame(std::int64_t k, int fps, double h) {
  constexpr double kRounding = 1e-6;
  const double exact = static_cast<double>(k) / (fps * h);
  return std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil(exact - 0.5 - kRounding)));
}

void render(const RenderOptions& options) {
  const Console console(options);
  catchInterrupts();
  Simulation simulation(loadScene(options, console), {.mode = options.mode, .timings = false});
  const World& world = simulation.world();
  const Scene& scene = world.scene();
  const std::string folder = options.folder.empty() ? "frames/" + scene.name : options.folder;

  FrameStyle style = options.style;
  style.mode = options.mode;
  Snapshot snapshot = world.capture();
  adaptToScene(style, scene, snapshot, world.bodies());
  SequenceWriter writer(world.bodies(), style, {.folder = folder});
  const auto last = static_cast<std::int64_t>(std::floor(scene.duration * options.fps + 1e-6));
  Progress progress(console, "frame", last + 1);
  for (std::int64_t k = 0; k <= last; ++k) {
    while (world.steps() < stepOfFrame(k, options.fps, scene.step)) simulation.step();
    world.capture(snapshot);
    writer.add(snapshot);
    progress.update(k);
  }
  writer.finish();
  print(fmt::format("{}/frame_%06d.png\n", folder));
}

}  // namespace

void addRenderCommand(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("render", "Draw a scene as a sequence of PNG files");
  const auto options = std::make_shared<RenderOptions>();
  addSceneOptions(*command, *options);
  command->add_option("-o", options->folder, "Folder for the frames (default: frames/<scene>)");
  command->callback([&action, options] { action = [options] { render(*options); }; });
}

}  // namespace merge2d
