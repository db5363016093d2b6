#include "bench/measure.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <thread>

namespace merge2d::bench {
namespace {

constexpr double kLost = 0.5;  // [m]

using Positions = std::vector<Vec2>;

std::size_t heapBytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// A step, before which a body may come.
void stepOf(Peer& peer, const Rain& rain, std::int64_t& steps) {
  if (rain.every > 0 && steps % rain.every == 0) peer.add(dropOf(rain, steps));
  ++steps;
  peer.step();
}

/// Loads and warms up an engine in a thread of its own: what that has freed but keeps for itself,
/// which mallinfo2 counts as in use, goes back when the thread ends.
void loadAndWarmUp(Peer& peer, const BenchScene& bench, int steps, Positions& start) {
  std::thread([&] {
    peer.load(bench.scene);
    start = peer.positions();
    for (std::int64_t i = 0; i < steps;) stepOf(peer, bench.rain, i);
  }).join();
}

/// Appends the milliseconds of each step; returns their median, which a machine that is busy for a
/// moment disturbs least.
double timeSteps(Peer& peer, const Rain& rain, std::int64_t& done, int steps,
                 std::vector<double>& times) {
  stepOf(peer, rain, done);  // brings its data back into the caches
  for (int i = 0; i < steps; ++i) {
    const auto start = std::chrono::steady_clock::now();
    stepOf(peer, rain, done);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    times.push_back(took.count());
  }
  return median({times.end() - steps, times.end()});
}

/// How far body i went against body 0.
Vec2 displacement(const Positions& from, const Positions& to, std::size_t i) {
  return (to[i] - to[0]) - (from[i] - from[0]);
}

void judge(Measurement& m, const Positions& start, const Positions& warm, const Positions& end) {
  for (std::size_t i = 1; i < start.size(); ++i) {
    // Downwards a high wall sags by as much, without a box out of place.
    if (std::abs(displacement(start, end, i).x()) > kLost) {
      ++m.lost;
    } else {
      m.drift = std::max(m.drift, displacement(warm, end, i).norm());
    }
  }
}

}  // namespace

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

StepTimes distributionOf(std::vector<double> times) {
  std::ranges::sort(times);
  const auto part = [&](double share) {
    return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
  };
  const double total = std::accumulate(times.begin(), times.end(), 0.0);
  return {part(0.5), total / static_cast<double>(times.size()), part(0.99), times.back()};
}

namespace {

/// Of a large scene fewer steps: its engines take a tenth of a second for each.
Plan planFor(const BenchScene& bench, Plan plan) {
  if (!bench.large) return plan;
  plan.warmup /= 2;
  plan.rounds = std::min(plan.rounds, 4);
  return plan;
}

}  // namespace

Comparison compare(const BenchScene& bench, const Peers& peers, const Plan& for_all) {
  const Plan plan = planFor(bench, for_all);
  Comparison result{bench.scene.name, bench.scene.bodies.size(), bench.expectation, {}};
  result.measurements.resize(peers.size());

  // Load and warm up, one engine after the other, so that each one's memory can be told.
  std::vector<Positions> start, warm;
  for (std::size_t p = 0; p < peers.size(); ++p) {
    Measurement& m = result.measurements[p];
    m.peer = peers[p]->name();
    const std::size_t before = heapBytes();
    start.emplace_back();
    loadAndWarmUp(*peers[p], bench, plan.warmup, start.back());
    m.heap_bytes = heapBytes() - before;
    m.own_bytes = peers[p]->ownBytes();
    warm.push_back(peers[p]->positions());
  }

  // Take turns; each round begins with another engine.
  std::vector<std::vector<double>> ms(peers.size()), ratios(peers.size());
  std::vector<double> turn_ms(peers.size());
  std::vector<std::int64_t> done(peers.size(), plan.warmup);
  for (int round = 0; round < plan.rounds; ++round) {
    for (std::size_t turn = 0; turn < peers.size(); ++turn) {
      const std::size_t p = (turn + static_cast<std::size_t>(round)) % peers.size();
      turn_ms[p] = timeSteps(*peers[p], bench.rain, done[p], plan.steps, ms[p]);
    }
    for (std::size_t p = 0; p < peers.size(); ++p) ratios[p].push_back(turn_ms[p] / turn_ms[0]);
  }

  for (std::size_t p = 0; p < peers.size(); ++p) {
    Measurement& m = result.measurements[p];
    m.ms = distributionOf(ms[p]);
    m.ratio = median(ratios[p]);
    judge(m, start[p], warm[p], peers[p]->positions());
  }
  return result;
}

}  // namespace merge2d::bench
