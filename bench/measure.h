#pragma once
/// Interleaved measurement: the engines take turns on the same scene, so that a machine that is
/// busy for a moment is busy for all of them, and medians of ratios are trusted more than times.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bench/bench_scenes.h"
#include "bench/peers/peer.h"

namespace merge2d::bench {

struct Plan {
  int warmup = 800;  ///< steps before any is timed: by then walls rest, and what merges has merged
  int rounds = 16;   ///< turns of each engine
  int steps = 24;    ///< timed steps per turn, after one that is not
};

/// How the cost of a step is distributed: a median alone hides the steps in which much happens.
struct StepTimes {
  double median = 0.0, mean = 0.0, p99 = 0.0, slowest = 0.0;  ///< p99: of the 99th percentile
};
StepTimes distributionOf(std::vector<double> times);

/// One engine on one scene.
struct Measurement {
  std::string peer;
  StepTimes ms;        ///< of all steps that were timed
  double ratio = 1.0;  ///< median over the rounds of its median by the first engine's
  double drift = 0.0;  ///< how far a body moved against body 0 after the warm-up, at most [m]
  int lost = 0;        ///< bodies that went more than half a box sideways, left out of `drift`
  std::size_t heap_bytes = 0;  ///< more on the heap than before loading
  std::size_t own_bytes = 0;   ///< by its own account; 0 when it gives none
};

struct Comparison {
  std::string scene;
  std::size_t bodies = 0;
  Expectation expectation = Expectation::Stands;
  std::vector<Measurement> measurements;  ///< in the order of the peers
};

using Peers = std::vector<std::unique_ptr<Peer>>;

/// Ratios are to the first of the peers.
Comparison compare(const BenchScene& bench, const Peers& peers, const Plan& plan);

double median(std::vector<double> values);

}  // namespace merge2d::bench
