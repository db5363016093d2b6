#include "app/comparison_report.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <span>

#include "app/json.h"

namespace merge2d {
namespace {

using Steps = std::span<const StepRow>;
/// Those of a run that are looked at.
using StepsOf = std::function<Steps(const ModeRun&)>;

Steps allSteps(const ModeRun& run) { return run.steps; }

/// How many times faster than another mode; null where nothing was measured.
Json speedup(Steps steps, Steps others) {
  const double ms = meanMs(steps);
  return ms > 0.0 ? Json(meanMs(others) / ms) : Json();
}

/// Times, and how they compare.
void addTimes(Json& out, const Comparison& comparison, const ModeRun& run, const StepsOf& stepsOf) {
  const Steps steps = stepsOf(run);
  const auto& runs = comparison.runs();
  const bool timings = comparison.timings() && !steps.empty();
  out["ms_per_step"] = {{"mean", timings ? Json(meanMs(steps)) : Json()},
                        {"median", timings ? Json(medianMs(steps)) : Json()}};
  out["speedup"] = {{"reference", timings ? speedup(steps, stepsOf(runs[0])) : Json()},
                    {"sleep", timings ? speedup(steps, stepsOf(runs[1])) : Json()}};
}

Json windowJson(const Comparison& comparison, const ModeRun& run, const StepsOf& stepsOf) {
  Json out;
  addTimes(out, comparison, run, stepsOf);
  out["active_bodies"] = {{"mean", mean(stepsOf(run), &StepRow::active_bodies)}};
  out["contacts"] = {{"mean", mean(stepsOf(run), &StepRow::contacts)}};
  out["internal_contacts"] = {{"mean", mean(stepsOf(run), &StepRow::internal_contacts)}};
  return out;
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
  Json out;
  out["mode"] = name(run.mode);
  addTimes(out, comparison, run, allSteps);
  const auto average = [&](int StepRow::*number) { return mean(run.steps, number); };
  out["active_bodies"] = {{"mean", average(&StepRow::active_bodies)},
                          {"last", run.last.active_bodies}};
  out["contacts"] = {{"mean", average(&StepRow::contacts)}, {"last", run.last.contacts}};
  out["internal_contacts"] = {{"mean", average(&StepRow::internal_contacts)},
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

/// A line of the table, of a column per mode.
using Cell = std::function<std::string(const ModeRun&)>;
std::string row(const Comparison& comparison, const std::string& what, const Cell& cell) {
  std::string line = fmt::format("{:<26}", what);
  for (const ModeRun& run : comparison.runs()) line += fmt::format("{:>13}", cell(run));
  return line + '\n';
}

/// What the steps took, and how many bodies and contacts there were.
std::string meanRows(const Comparison& comparison, const StepsOf& stepsOf) {
  const auto& runs = comparison.runs();
  const auto line = [&](const char* what, const Cell& cell) { return row(comparison, what, cell); };
  const auto factor = [&](const ModeRun& other) {
    const double ms = meanMs(stepsOf(other));
    return [&, ms](auto& r) { return fmt::format("{:.1f} x", ms / meanMs(stepsOf(r))); };
  };
  const auto average = [&](int StepRow::*number) {
    return [&, number](auto& r) { return fmt::format("{:.1f}", mean(stepsOf(r), number)); };
  };
  std::string out;
  if (comparison.timings() && !stepsOf(runs[0]).empty()) {
    out += line("time per step, mean",
                [&](auto& r) { return fmt::format("{:.3g} ms", meanMs(stepsOf(r))); });
    out += line("              median",
                [&](auto& r) { return fmt::format("{:.3g} ms", medianMs(stepsOf(r))); });
    out += line("faster than reference", factor(runs[0]));
    out += line("faster than sleep", factor(runs[1]));
  }
  out += line("active bodies, mean", average(&StepRow::active_bodies));
  out += line("contacts solved, mean", average(&StepRow::contacts));
  out += line("internal contacts, mean", average(&StepRow::internal_contacts));
  return out;
}

std::string windowRows(const Comparison& comparison, const Window& window) {
  const double h = comparison.scene().step;
  return fmt::format("\nfrom {:.6g} s to {:.6g} s\n", window.from, window.to) +
         meanRows(comparison, [&](const ModeRun& run) { return run.within(window, h); });
}

}  // namespace

std::string comparisonTable(const Comparison& comparison, const std::optional<Window>& window) {
  const auto& runs = comparison.runs();
  const Scene& scene = comparison.scene();
  std::string out = fmt::format("{}: {}\n{} steps of {} s, {:.6g} s\n\n{:<26}", scene.name,
                                scene.title, comparison.stepsDone(), scene.step,
                                static_cast<double>(comparison.stepsDone()) * scene.step, "");
  const auto add = [&](const std::string& what, const Cell& cell) {
    out += row(comparison, what, cell);
  };
  for (const ModeRun& run : runs) out += fmt::format("{:>13}", name(run.mode));
  out += '\n' + meanRows(comparison, allSteps);
  add("active bodies, at the end", [](auto& r) { return std::to_string(r.last.active_bodies); });
  add("merges", [](auto& r) { return std::to_string(r.merges()); });
  add("unmerges", [](auto& r) { return std::to_string(r.unmerges()); });
  add("  both, in the last quarter", [](auto& r) { return std::to_string(r.lateEvents()); });
  add("welds gone in 20 steps", [](auto& r) { return std::to_string(r.flicker); });
  add("deepest overlap", [](auto& r) { return lengthText(r.max_penetration); });
  add("bodies that tipped over", [](auto& r) { return std::to_string(r.tipping_times.size()); });
  const std::size_t tipped = runs[0].tipping_times.size();
  if (tipped > 0) {
    add("  the first at", [](auto& r) { return timeText(r.tipping_times, 0); });
    add(fmt::format("  number {} at", tipped),
        [&](auto& r) { return timeText(r.tipping_times, tipped - 1); });
  }
  out += "\ndistance from the reference\n";
  add("  mean, at the end", [](auto& r) { return lengthText(atEnd(r).mean); });
  add("  largest, at the end", [](auto& r) { return lengthText(atEnd(r).largest); });
  add("  largest, ever", [](auto& r) { return lengthText(largestEver(r)); });
  if (window) out += windowRows(comparison, *window);
  return out;
}

std::string comparisonJson(const Comparison& comparison, const std::optional<Window>& window,
                           const std::vector<std::string>& charts) {
  const Scene& scene = comparison.scene();
  Json out;
  out["scene"] = scene.name;
  out["title"] = scene.title;
  out["h"] = scene.step;
  out["steps"] = comparison.stepsDone();
  out["time"] = static_cast<double>(comparison.stepsDone()) * scene.step;
  out["bodies"] = comparison.runs()[0].last.bodies;
  out["modes"] = Json::array();
  const auto within = [&](const ModeRun& run) { return run.within(*window, scene.step); };
  if (window) out["window"] = {window->from, window->to};
  for (const ModeRun& run : comparison.runs()) {
    Json mode = modeJson(comparison, run);
    if (window) mode["window"] = windowJson(comparison, run, within);
    out["modes"].push_back(std::move(mode));
  }
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
