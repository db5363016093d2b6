#include "app/comparison_marks.h"

#include <fmt/format.h>

#include <algorithm>

namespace merge2d {
namespace {

/// Of a run; hits that are closer together could not be told apart in a chart.
constexpr double kApart = 1.0 / 20.0;

/// The scene's own events.
std::vector<ChartMark> scheduled(const Scene& scene) {
  std::vector<ChartMark> marks;
  const auto& body = scene.bodies;
  for (const ImpulseDesc& impulse : scene.impulses) {
    marks.push_back({impulse.time, "impulse on " + body[impulse.body].name});
  }
  for (const ForceDesc& force : scene.forces) {
    if (force.from > 0.0) marks.push_back({force.from, "force on " + body[force.body].name});
    if (force.until < scene.duration) marks.push_back({force.until, "force ends"});
  }
  for (const BodyDesc& one : body) {
    if (one.pinned_until > 0.0) marks.push_back({one.pinned_until, one.name + " let go"});
  }
  for (const MagnetDesc& magnet : scene.magnets) {
    for (const MagnetDesc::Interval& on : magnet.on) {
      if (on.from > 0.0) marks.push_back({on.from, "magnet on"});
      if (on.until < scene.duration) marks.push_back({on.until, "off"});
    }
  }
  return marks;
}

}  // namespace

std::vector<Hit> markedHits(const Comparison& comparison) {
  const double run = static_cast<double>(comparison.stepsDone()) * comparison.scene().step;
  return outstandingHits(comparison.runs()[0].hits, kApart * run);
}

std::string labelOf(const Comparison& comparison, const Hit& hit) {
  const std::string& striker = comparison.nameOf(hit.striker);
  const std::string& struck = comparison.nameOf(hit.struck);
  return hit.both_moved ? fmt::format("{} and {} meet", striker, struck)
                        : fmt::format("{} hits {}", striker, struck);
}

std::vector<ChartMark> marksOf(const Comparison& comparison) {
  std::vector<ChartMark> marks = scheduled(comparison.scene());
  for (const Hit& hit : markedHits(comparison)) {
    marks.push_back({hit.time, labelOf(comparison, hit)});
  }
  std::ranges::stable_sort(marks, {}, &ChartMark::x);
  const auto at_once = [](const ChartMark& a, const ChartMark& b) { return a.x == b.x; };
  marks.erase(std::unique(marks.begin(), marks.end(), at_once), marks.end());
  return marks;
}

}  // namespace merge2d
