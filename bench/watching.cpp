/// The cost of observation: steps of a world that nobody watches, of one that notes its
/// decisions, and of one whose stages are recorded, in turns on the same machine.

#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <vector>

#include "bench/measure.h"
#include "src2d/recorder.h"
#include "src2d/scene/load.h"

namespace merge2d::bench {
namespace {

constexpr int kRounds = 15, kSteps = 20;

/// Milliseconds per step.
double timed(const std::function<void()>& step) {
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < kSteps; ++i) step();
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
  return spent.count() / kSteps;
}

void measure(const char* name, Mode mode, std::int64_t warmup) {
  const Scene scene = loadScene(name);
  Recorder recorder(scene, mode);
  World silent(scene, {.mode = mode, .timings = false});
  World asked(scene, {.mode = mode, .timings = false, .decisions = true});
  recorder.skipTo(warmup);
  while (silent.steps() < warmup) silent.step(), asked.step();
  std::vector<double> times[3];
  for (int round = 0; round < kRounds; ++round) {
    times[0].push_back(timed([&] { silent.step(); }));
    times[1].push_back(timed([&] { asked.step(); }));
    times[2].push_back(timed([&] { recorder.record(); }));
  }
  fmt::print("| {} | {} |", name, merge2d::name(mode));
  for (const std::vector<double>& t : times) fmt::print(" {:.3g} |", median(t));
  fmt::print("\n");
}

}  // namespace
}  // namespace merge2d::bench

int main() {
  using namespace merge2d;
  fmt::print(
      "Milliseconds per step.\n\n| scene | mode | nobody asks | notes taken | stages recorded |\n"
      "|---|---|--:|--:|--:|\n");
  for (const Mode mode : {Mode::Reference, Mode::Merge}) {
    bench::measure("tower-platform", mode, 250);
    bench::measure("pile", mode, 300);
  }
}
