#include "app/comparison_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>

#include "app/comparison_marks.h"
#include "app/json.h"
#include "src2d/core/utf8.h"

namespace merge2d {
namespace {

using Steps = std::span<const StepRow>;
/// Those of a run that are looked at.
using StepsOf = std::function<Steps(const ModeRun&)>;

Steps allSteps(const ModeRun& run) { return run.steps; }

constexpr std::size_t kSamples = 500;  // of the distance in JSON, at least

/// How many times faster than another mode; null where nothing was measured.
Json speedup(Steps steps, Steps others) {
  const double ms = meanMs(steps);
  return ms > 0.0 ? Json(meanMs(others) / ms) : Json();
}

/// Mean milliseconds, by the names of the stages; null where nothing was measured.
Json stagesJson(Steps steps, bool timings) {
  if (!timings) return {};
  Json out;
  for (std::size_t s = 0; s < kStages; ++s) {
    const auto stage = static_cast<Stage>(s);
    out[name(stage)] = meanMs(steps, stage);
  }
  return out;
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
  out["ms_per_stage"] = stagesJson(steps, timings);
}

Json windowJson(const Comparison& comparison, const ModeRun& run, const StepsOf& stepsOf) {
  Json out;
  addTimes(out, comparison, run, stepsOf);
  out["active_bodies"] = {{"mean", mean(stepsOf(run), &StepRow::active_bodies)}};
  out["contacts"] = {{"mean", mean(stepsOf(run), &StepRow::contacts)}};
  out["internal_contacts"] = {{"mean", mean(stepsOf(run), &StepRow::internal_contacts)}};
  return out;
}

Json tippingJson(const ModeRun& reference, const ModeRun& run) {
  const auto& times = run.tipping_times;
  Json out;
  out["bodies"] = times.size();
  out["first"] = times.empty() ? Json() : Json(times.front());
  out["median"] = times.empty() ? Json() : Json(times[times.size() / 2]);
  out["last"] = times.empty() ? Json() : Json(times.back());
  out["times"] = times;
  const TippingDifference difference = tippingDifference(reference, run);
  const bool any = difference.compared > 0;
  out["difference"] = {{"compared", difference.compared},
                       {"mean", any ? Json(difference.mean) : Json()},
                       {"largest", any ? Json(difference.largest) : Json()}};
  return out;
}

Json creepJson(const Creep& creep) {
  return {{"pairs", creep.pairs},
          {"mean", creep.mean},
          {"largest", creep.largest},
          {"largest_ever", creep.largest_ever}};
}

Json hitsJson(const Comparison& comparison) {
  Json out = Json::array();
  for (const Hit& hit : markedHits(comparison)) {
    out.push_back({{"time", hit.time},
                   {"striker", comparison.nameOf(hit.striker)},
                   {"struck", comparison.nameOf(hit.struck)},
                   {"both_moved", hit.both_moved},
                   {"label", labelOf(comparison, hit)},
                   {"energy", hit.energy}});
  }
  return out;
}

/// Every so many of them, and the last: from kSamples to twice as many where there are more.
Json overTime(const std::vector<Distance>& distances) {
  Json out = {{"time", Json::array()}, {"mean", Json::array()}, {"largest", Json::array()}};
  const std::size_t stride = std::max<std::size_t>(1, distances.size() / kSamples);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if ((i + 1) % stride != 0 && i + 1 != distances.size()) continue;
    out["time"].push_back(distances[i].time);
    out["mean"].push_back(distances[i].mean);
    out["largest"].push_back(distances[i].largest);
  }
  return out;
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
  if (!comparison.scene().joints.empty()) out["broken_joints"] = run.brokenJoints();
  out["late_events"] = run.lateEvents();
  out["flicker"] = run.flicker;
  out["max_penetration"] = run.max_penetration;
  out["tipped"] = tippingJson(comparison.runs()[0], run);
  out["creep"] = creepJson(run.creep);
  out["distance"] = {{"mean", atEnd(run).mean},
                     {"largest", atEnd(run).largest},
                     {"largest_ever", run.largestDistance()}};
  out["distance_over_time"] = overTime(run.distances);
  return out;
}

std::string timeText(const std::vector<double>& times, std::size_t k) {
  return k < times.size() ? fmt::format("{:.2f} s", times[k]) : "-";
}

/// A line of the table, of a column per mode.
using Cell = std::function<std::string(const ModeRun&)>;
std::string row(const Comparison& comparison, const std::string& what, const Cell& cell) {
  std::string line = fmt::format("{:<28}", what);
  for (const ModeRun& run : comparison.runs()) line += fmt::format("{:>13}", cell(run));
  return line + '\n';
}

/// The time of the steps, and the numbers of bodies and contacts.
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

/// How many bodies tipped over, and when: the k-th here against the k-th in the reference.
std::string tippingRows(const Comparison& comparison) {
  const auto line = [&](const std::string& what, const Cell& cell) {
    return row(comparison, what, cell);
  };
  const ModeRun& reference = comparison.runs()[0];
  std::string out = line("bodies that tipped over",
                         [](auto& r) { return std::to_string(r.tipping_times.size()); });
  const std::size_t tipped = reference.tipping_times.size();
  if (tipped == 0) return out;
  const auto difference = [&](double TippingDifference::*number) {
    return [&reference, number](const ModeRun& run) {
      const TippingDifference d = tippingDifference(reference, run);
      return d.compared == 0 ? std::string("-") : fmt::format("{:.3f} s", d.*number);
    };
  };
  out += line("  the first at", [](auto& r) { return timeText(r.tipping_times, 0); });
  out += line(fmt::format("  number {} at", tipped),
              [&](auto& r) { return timeText(r.tipping_times, tipped - 1); });
  out += line("  the k-th is off by, mean", difference(&TippingDifference::mean));
  out += line("                   largest", difference(&TippingDifference::largest));
  return out;
}

std::string distanceRows(const Comparison& comparison) {
  const auto line = [&](const char* what, double (*number)(const ModeRun&)) {
    return row(comparison, what, [&](const ModeRun& run) { return lengthText(number(run)); });
  };
  return "\ncreep of pairs that touch, in the last quarter\n" +
         line("  mean, at the end", [](auto& r) { return r.creep.mean; }) +
         line("  largest, at the end", [](auto& r) { return r.creep.largest; }) +
         line("  largest, of all steps", [](auto& r) { return r.creep.largest_ever; }) +
         "\ndistance from the reference\n" +
         line("  mean, at the end", [](auto& r) { return atEnd(r).mean; }) +
         line("  largest, at the end", [](auto& r) { return atEnd(r).largest; }) +
         line("  largest, of all steps", [](auto& r) { return r.largestDistance(); });
}

}  // namespace

std::string lengthText(double metres) {
  if (metres == 0.0) return "0";
  if (metres < 1e-12) return "< 0.001 nm";
  if (metres < 1e-7) return fmt::format("{:.2g} nm", 1e9 * metres);
  if (metres < 0.995e-4) return fmt::format("{:.2g} µm", 1e6 * metres);
  if (metres < 0.9995) return fmt::format("{:.3g} mm", 1e3 * metres);
  if (metres < 999.5) return fmt::format("{:.3g} m", metres);
  return fmt::format("{:.0f} m", metres);
}

std::string comparisonTable(const Comparison& comparison, const std::optional<Window>& window) {
  const Scene& scene = comparison.scene();
  std::string out = fmt::format("{}: {}\n{} steps of {} s, {:.6g} s\n\n{:<28}", escaped(scene.name),
                                escaped(scene.title), comparison.stepsDone(), scene.step,
                                static_cast<double>(comparison.stepsDone()) * scene.step, "");
  const auto add = [&](const std::string& what, const Cell& cell) {
    out += row(comparison, what, cell);
  };
  for (const ModeRun& run : comparison.runs()) out += fmt::format("{:>13}", name(run.mode));
  out += '\n' + meanRows(comparison, allSteps);
  add("active bodies, at the end", [](auto& r) { return std::to_string(r.last.active_bodies); });
  add("collections, at the end", [](auto& r) { return std::to_string(r.last.collections); });
  add("bodies asleep, at the end", [](auto& r) { return std::to_string(r.last.asleep); });
  add("merges", [](auto& r) { return std::to_string(r.merges()); });
  add("unmerges", [](auto& r) { return std::to_string(r.unmerges()); });
  add("  both, in the last quarter", [](auto& r) { return std::to_string(r.lateEvents()); });
  add("welds gone in 20 steps", [](auto& r) { return std::to_string(r.flicker); });
  if (!scene.joints.empty()) {
    add("broken joints", [](auto& r) { return std::to_string(r.brokenJoints()); });
  }
  add("deepest overlap, all steps", [](auto& r) { return lengthText(r.max_penetration); });
  out += tippingRows(comparison) + distanceRows(comparison);
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
  out["hits"] = hitsJson(comparison);
  out["charts"] = charts;
  return out.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string comparisonCsv(const Comparison& comparison) {
  const double h = comparison.scene().step;
  std::string out(kComparisonCsvStart);
  out +=
      "contacts,internal_contacts,merges,unmerges,mean_distance,largest_distance,collections,"
      "asleep,broken_joints,max_penetration";
  if (comparison.timings()) {
    out += ",ms";
    for (std::size_t s = 0; s < kStages; ++s) out += fmt::format(",ms_{}", name(Stage(s)));
  }
  out += '\n';
  for (const ModeRun& run : comparison.runs()) {
    for (std::size_t i = 0; i < run.steps.size(); ++i) {
      const StepRow& row = run.steps[i];
      const Distance& distance = run.distances[i];
      out += fmt::format("{},{},{:.9g},{},{},{},{},{},{},{},{},{},{},{}", name(run.mode), i + 1,
                         h * static_cast<double>(i + 1), row.active_bodies, row.contacts,
                         row.internal_contacts, row.merges, row.unmerges, distance.mean,
                         distance.largest, row.collections, row.asleep, row.broken_joints,
                         row.max_penetration);
      const StepTime& took = row.time;
      if (comparison.timings()) {
        out += fmt::format(",{},{}", took.ms, fmt::join(took.stage_ms, ","));
      }
      out += '\n';
    }
  }
  return out;
}

}  // namespace merge2d
