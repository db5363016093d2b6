/// How well the cycle criteria judge, and what they cost: Markdown tables for docs/cycles.md.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>

#include "bench/judge.h"
#include "bench/judging_time.h"
#include "bench/random_pile.h"
#include "src2d/scene/load.h"
#include "src2d/world.h"

namespace merge2d {
namespace {

constexpr double kLongest = 10.0;  // s of a scene that are judged

void printRow(const std::string& name, const Judgement& judgement) {
  fmt::print("| {} |", name);
  for (const Score& s : judgement.scores) {
    fmt::print(" {} | {} | {} | {} |", s.welded, s.false_soon, s.false_later, s.missed);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void printCauses(const Causes& c) {
  fmt::print("\n| a weld of `rigid` was false, for of what held it first | |\n|---|---:|\n");
  fmt::print("| something was hit by what did not touch it before | {} |\n", c.hit);
  fmt::print("| a contact opened | {} |\n", c.opened);
  fmt::print("| a contact slid, on the edge of its friction cone | {} |\n", c.slid);
  fmt::print("| a contact crept, inside its cone | {} |\n", c.crept);
  fmt::print("| nothing was lost | {} |\n", c.none);
  fmt::print("\n| a weld of `rigid` was missed | |\n|---|---:|\n");
  fmt::print("| some contacts that hold the pair were not ready yet | {} |\n", c.early);
  fmt::print("| the pair was free to turn, but in balance | {} |\n", c.balanced);
}

void judgeScenes(int piles) {
  fmt::print("| single-contact pairs of |");
  for (const char* name : kCriterionNames) {
    fmt::print(" {}: welded | false, 1 s | false, 5 s | missed |", name);
  }
  fmt::print("\n|---|");
  for (int i = 0; i < 12; ++i) fmt::print("---:|");
  fmt::print("\n");
  Judgement total;
  for (const BuiltinScene& builtin : builtinScenes()) {
    const Scene scene = loadScene(builtin.name);
    const Judgement judgement = judgeScene(scene, 0.0, std::min(kLongest, scene.duration));
    printRow(fmt::format("`{}`{}", builtin.name, scene.duration > kLongest ? " \\*" : ""),
             judgement);
    total += judgement;
  }
  Judgement all_piles;
  for (int i = 0; i < piles; ++i) {
    all_piles += judgeScene(randomPile(static_cast<std::uint64_t>(i), 50, 7), 1.0, 6.0);
  }
  printRow(fmt::format("{} random piles of 50", piles), all_piles);
  total += all_piles;
  printRow("**all**", total);
  fmt::print("\n\\* the first {:.0f} s of it.\n", kLongest);
  printCauses(total.causes);
}

/// A part of the time in which a pile comes to rest.
struct Phase {
  const char* name;
  double from = 0.0, until = 0.0;  ///< [s]
};
constexpr Phase kPhases[] = {
    {"falling", 0.0, 2.0}, {"settling", 2.0, 6.0}, {"settled", 16.0, 20.0}};

/// The share of judging in a step while a large pile falls and comes to rest.
void measureCost(int bodies) {
  fmt::print("| pile of {} mixed bodies | phase | ms per step | of which judging |", bodies);
  fmt::print(" share | most in one step | judged in |\n|---|---|---:|---:|---:|---:|---:|\n");
  for (std::size_t c = 0; c < kCriteria.size(); ++c) {
    Scene scene = randomPile(1, bodies, 40);
    scene.settings.merging.cycles = kCriteria[c];
    World world(scene, {.mode = Mode::Merge});
    for (const Phase& phase : kPhases) {
      while (world.time() < phase.from) world.step();
      double total = 0.0, judging = 0.0, most = 0.0;
      int steps = 0, judged = 0;
      while (world.time() < phase.until) {
        const JudgingTime before = judgingTime();
        world.step();
        const JudgingTime after = judgingTime();
        double step = 0.0;
        for (const double seconds : world.stats().seconds) step += seconds;
        total += step;
        judging += after.seconds - before.seconds;
        most = std::max(most, after.seconds - before.seconds);
        judged += after.calls > before.calls ? 1 : 0;
        ++steps;
      }
      fmt::print(
          "| `{}` | {}, {:.0f} to {:.0f} s | {:.2f} | {:.4f} | {:.2f} % | {:.2f} ms | {} % |\n",
          kCriterionNames[c], phase.name, phase.from, phase.until, 1e3 * total / steps,
          1e3 * judging / steps, 1e2 * judging / total, 1e3 * most, 100 * judged / steps);
      std::fflush(stdout);
    }
  }
  if (judgingTime().calls == 0) throw std::runtime_error("heldGroups was never timed");
}

}  // namespace
}  // namespace merge2d

int main(int argc, char** argv) {
  CLI::App program("Judges the cycle criteria by what the reference does");
  int piles = 50, bodies = 2000;
  bool no_verdicts = false;
  program.add_option("--piles", piles, "Number of random piles");
  program.add_option("--bodies", bodies, "Bodies of the pile that is timed; 0: none");
  program.add_flag("--no-verdicts", no_verdicts, "Only time the pile");
  CLI11_PARSE(program, argc, argv);
  if (!no_verdicts) merge2d::judgeScenes(piles);
  if (bodies > 0) merge2d::measureCost(bodies);
}
