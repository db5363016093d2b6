#include "app/comparison_report.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "app/json.h"

namespace merge2d {
namespace {

/// How many times faster than another mode; null where nothing was measured.
Json speedup(const ModeRun& run, const ModeRun& other) {
  return run.meanMs() > 0.0 ? Json(other.meanMs() / run.meanMs()) : Json();
}

Json tippingJson(const ModeRun& run) {
  const auto& times = run.tipping_times;
  Json out;
  out["bodies"] = times.size();
  out["first"] = times.empty() ? Json() : Json(times.front());
  out["median"] = times.empty() ? Json() : Json(times[times.size() / 2]);
  out["last"] = times.empty() ? Json() : Json(times.back());
  return out;
}

double largestEver(const ModeRun& run) {
  double largest = 0.0;
  for (const Distance& d : run.distances) largest = std::max(largest, d.largest);
  return largest;
}

Distance atEnd(const ModeRun& run) {
  return run.distances.empty() ? Distance{} : run.distances.back();
}

Json modeJson(const Comparison& comparison, const ModeRun& run) {
  const auto& runs = comparison.runs();
  const bool timings = comparison.timings() && !run.steps.empty();
  Json out;
  out["mode"] = name(run.mode);
  out["ms_per_step"] = {{"mean", timings ? Json(run.meanMs()) : Json()},
                        {"median", timings ? Json(run.medianMs()) : Json()}};
  out["speedup"] = {{"reference", timings ? speedup(run, runs[0]) : Json()},
                    {"sleep", timings ? speedup(run, runs[1]) : Json()}};
  out["active_bodies"] = {{"mean", run.mean(&StepRow::active_bodies)},
                          {"last", run.last.active_bodies}};
  out["contacts"] = {{"mean", run.mean(&StepRow::contacts)}, {"last", run.last.contacts}};
  out["internal_contacts"] = {{"mean", run.mean(&StepRow::internal_contacts)},
                              {"last", run.last.internal_contacts}};
  out["collections"] = run.last.collections;
  out["asleep"] = run.last.asleep;
  out["merges"] = run.merges();
  out["unmerges"] = run.unmerges();
  out["late_events"] = run.lateEvents();
  out["flicker"] = run.flicker;
  out["max_penetration"] = run.max_penetration;
  out["tipped"] = tippingJson(run);
  out["distance"] = {{"mean", atEnd(run).mean},
                     {"largest", atEnd(run).largest},
                     {"largest_ever", largestEver(run)}};
  return out;
}

/// "3.2 mm", in the unit that suits it.
std::string lengthText(double metres) {
  if (metres == 0.0) return "0";
  if (metres < 1e-3) return fmt::format("{:.2g} um", 1e6 * metres);
  if (metres < 1.0) return fmt::format("{:.3g} mm", 1e3 * metres);
  return fmt::format("{:.3g} m", metres);
}

std::string timeText(const std::vector<double>& times, std::size_t k) {
  return k < times.size() ? fmt::format("{:.2f} s", times[k]) : "-";
}

}  // namespace

std::string comparisonTable(const Comparison& comparison) {
  const auto& runs = comparison.runs();
  const Scene& scene = comparison.scene();
  std::string out = fmt::format("{}: {}\n{} steps of {} s, {:.6g} s\n\n{:<26}", scene.name,
                                scene.title, comparison.stepsDone(), scene.step,
                                static_cast<double>(comparison.stepsDone()) * scene.step, "");
  using Cell = std::function<std::string(const ModeRun&)>;
  const auto row = [&](const char* what, const Cell& cell) {
    out += fmt::format("{:<26}", what);
    for (const ModeRun& run : runs) out += fmt::format("{:>13}", cell(run));
    out += '\n';
  };
  for (const ModeRun& run : runs) out += fmt::format("{:>13}", name(run.mode));
  out += '\n';
  const auto average = [&](int StepRow::*number) {
    return [number](const ModeRun& run) { return fmt::format("{:.1f}", run.mean(number)); };
  };
  if (comparison.timings() && comparison.stepsDone() > 0) {
    row("time per step, mean", [](auto& r) { return fmt::format("{:.3g} ms", r.meanMs()); });
    row("              median", [](auto& r) { return fmt::format("{:.3g} ms", r.medianMs()); });
    row("faster than reference",
        [&](auto& r) { return fmt::format("{:.1f} x", runs[0].meanMs() / r.meanMs()); });
    row("faster than sleep",
        [&](auto& r) { return fmt::format("{:.1f} x", runs[1].meanMs() / r.meanMs()); });
  }
  row("active bodies, mean", average(&StepRow::active_bodies));
  row("               at the end", [](auto& r) { return std::to_string(r.last.active_bodies); });
  row("contacts solved, mean", average(&StepRow::contacts));
  row("internal contacts, mean", average(&StepRow::internal_contacts));
  row("merges", [](auto& r) { return std::to_string(r.merges()); });
  row("unmerges", [](auto& r) { return std::to_string(r.unmerges()); });
  row("  both, in the last quarter", [](auto& r) { return std::to_string(r.lateEvents()); });
  row("welds gone in 20 steps", [](auto& r) { return std::to_string(r.flicker); });
  row("deepest overlap", [](auto& r) { return lengthText(r.max_penetration); });
  row("bodies that tipped over", [](auto& r) { return std::to_string(r.tipping_times.size()); });
  const std::size_t tipped = runs[0].tipping_times.size();
  if (tipped > 0) {
    row("  the first at", [](auto& r) { return timeText(r.tipping_times, 0); });
    row(fmt::format("  number {} at", tipped).c_str(),
        [&](auto& r) { return timeText(r.tipping_times, tipped - 1); });
  }
  out += "\ndistance from the reference\n";
  row("  mean, at the end", [](auto& r) { return lengthText(atEnd(r).mean); });
  row("  largest, at the end", [](auto& r) { return lengthText(atEnd(r).largest); });
  row("  largest, ever", [](auto& r) { return lengthText(largestEver(r)); });
  return out;
}

std::string comparisonJson(const Comparison& comparison, const std::vector<std::string>& charts) {
  const Scene& scene = comparison.scene();
  Json out;
  out["scene"] = scene.name;
  out["title"] = scene.title;
  out["h"] = scene.step;
  out["steps"] = comparison.stepsDone();
  out["time"] = static_cast<double>(comparison.stepsDone()) * scene.step;
  out["bodies"] = comparison.runs()[0].last.bodies;
  out["modes"] = Json::array();
  for (const ModeRun& run : comparison.runs()) out["modes"].push_back(modeJson(comparison, run));
  out["charts"] = charts;
  return out.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string comparisonCsv(const Comparison& comparison) {
  const double h = comparison.scene().step;
  std::string out(kComparisonCsvStart);
  out += "contacts,internal_contacts,merges,unmerges,mean_distance,largest_distance";
  out += comparison.timings() ? ",ms\n" : "\n";
  for (const ModeRun& run : comparison.runs()) {
    auto distance = run.distances.begin();
    for (std::size_t i = 0; i < run.steps.size(); ++i) {
      const StepRow& row = run.steps[i];
      const double t = h * static_cast<double>(i + 1);
      out +=
          fmt::format("{},{},{:.9g},{},{},{},{},{},", name(run.mode), i + 1, t, row.active_bodies,
                      row.contacts, row.internal_contacts, row.merges, row.unmerges);
      if (distance != run.distances.end() && std::abs(distance->time - t) < 0.5 * h) {
        out += fmt::format("{},{}", distance->mean, distance->largest);
        ++distance;
      } else {
        out += ',';
      }
      out += comparison.timings() ? fmt::format(",{}\n", row.ms) : "\n";
    }
  }
  return out;
}

}  // namespace merge2d
