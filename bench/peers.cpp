/// Measures merge2d side by side with the full Box2D and Chipmunk: the same scenes, step, friction
/// and number of iterations, one thread, nobody sleeps.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/measure.h"
#include "bench/peers/box2d_peer.h"
#include "bench/peers/chipmunk_peer.h"
#include "bench/peers/merge2d_peer.h"
#include "bench/report.h"

namespace {

using namespace merge2d::bench;

Peers allPeers() {
  Peers peers;
  peers.push_back(std::make_unique<Merge2dPeer>(merge2d::Mode::Merge));
  peers.push_back(std::make_unique<Merge2dPeer>(merge2d::Mode::Reference));
  peers.push_back(std::make_unique<Box2dPeer>());
  peers.push_back(std::make_unique<ChipmunkPeer>());
  return peers;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures merge2d, Box2D and Chipmunk side by side");
  bool quick = false;
  bool as_json = false;
  std::string only;
  app.add_flag("--quick", quick, "Fewer rounds, and not the largest scene");
  app.add_flag("--json", as_json, "Print JSON instead of Markdown tables");
  app.add_option("--only", only, "Only the scenes whose name contains this");
  CLI11_PARSE(app, argc, argv);

  Plan plan;
  if (quick) plan.rounds = 3;

  std::vector<Comparison> comparisons;
  for (const BenchScene& bench : benchScenes(quick)) {
    if (bench.scene.name.find(only) == std::string::npos) continue;
    fmt::print(stderr, "{} …\n", bench.scene.name);
    comparisons.push_back(compare(bench, allPeers(), plan));
  }
  if (comparisons.empty()) {
    fmt::print(stderr, "peers: no scene's name contains '{}'\n", only);
    return 2;
  }
  fmt::print("{}\n", as_json ? json(comparisons) : markdown(comparisons));
  return 0;
}
