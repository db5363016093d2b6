#include "bench/report.h"

#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>

namespace merge2d::bench {
namespace {

using Cell = std::function<std::string(const Comparison&, const Measurement&)>;
using Filter = std::function<bool(const Comparison&)>;

std::string table(const std::vector<Comparison>& comparisons, const Filter& wanted,
                  const Cell& cell) {
  std::string text = "| scene | bodies |";
  std::string rule = "|---|--:|";
  for (const Measurement& m : comparisons.front().measurements) {
    text += fmt::format(" {} |", m.peer);
    rule += "--:|";
  }
  text += "\n" + rule + "\n";
  for (const Comparison& c : comparisons) {
    if (!wanted(c)) continue;
    text += fmt::format("| {} | {} |", c.scene, c.bodies);
    for (const Measurement& m : c.measurements) text += fmt::format(" {} |", cell(c, m));
    text += "\n";
  }
  return text;
}

bool always(const Comparison&) { return true; }

bool shouldStand(const Comparison& c) { return c.expectation == Expectation::Stands; }

std::string timeCell(const Comparison&, const Measurement& m) {
  return fmt::format("{:.3g} ({:.3g}×)", m.ms.median, m.ratio);
}

std::string rareCell(const Comparison&, const Measurement& m) {
  return fmt::format("{:.3g} / {:.3g} / {:.3g}", m.ms.mean, m.ms.p99, m.ms.slowest);
}

std::string driftCell(const Comparison&, const Measurement& m) {
  const std::string lost = m.lost == 0 ? "" : fmt::format(", {} lost", m.lost);
  return fmt::format("{:.3g} mm{}", 1e3 * m.drift, lost);
}

std::string memoryCell(const Comparison& c, const Measurement& m) {
  const auto per_body = [&](std::size_t bytes) { return bytes / c.bodies; };
  if (m.own_bytes == 0) return fmt::format("{}", per_body(m.heap_bytes));
  return fmt::format("{} ({} in tables)", per_body(m.heap_bytes), per_body(m.own_bytes));
}

}  // namespace

std::string markdown(const std::vector<Comparison>& comparisons) {
  if (comparisons.empty()) return "";
  std::string text =
      "## Time\nMilliseconds per step (median), and how many times as long as the first "
      "(median of the ratios of rounds in turns).\n\n";
  text += table(comparisons, always, timeCell);
  text += "\nThe mean, the 99th percentile and the slowest step, in milliseconds.\n\n";
  text += table(comparisons, always, rareCell);
  text +=
      "\n## What the boxes did meanwhile\nThe farthest that any moved against what it stands on, "
      "and how many were lost (went more than half a box sideways).\n\n";
  text += table(comparisons, shouldStand, driftCell);
  text += "\n## Memory\nBytes per body.\n\n";
  text += table(comparisons, always, memoryCell);
  return text;
}

std::string json(const std::vector<Comparison>& comparisons) {
  nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
  for (const Comparison& c : comparisons) {
    nlohmann::ordered_json engines = nlohmann::ordered_json::array();
    for (const Measurement& m : c.measurements) {
      engines.push_back({{"engine", m.peer},
                         {"ms_per_step", m.ms.median},
                         {"mean_ms", m.ms.mean},
                         {"p99_ms", m.ms.p99},
                         {"slowest_ms", m.ms.slowest},
                         {"ratio", m.ratio},
                         {"drift", m.drift},
                         {"lost", m.lost},
                         {"heap_bytes", m.heap_bytes},
                         {"own_bytes", m.own_bytes}});
    }
    scenes.push_back({{"scene", c.scene}, {"bodies", c.bodies}, {"engines", engines}});
  }
  return scenes.dump(2);
}

}  // namespace merge2d::bench
