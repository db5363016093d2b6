#include "app/summary.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "app/provenance.h"
#include "app/statistics.h"

namespace merge2d {
namespace {

/// How many times faster than real time.
double realTimeFactor(const Simulation& simulation) {
  const auto& ms = simulation.milliseconds();
  return simulation.world().time() / (1e-3 * std::accumulate(ms.begin(), ms.end(), 0.0));
}

}  // namespace

Summary::Summary(const World& world) : max_penetration_(world.capture().stats.max_penetration) {}

void Summary::add(const World& world) {
  for (const Event& event : world.events()) {
    merges_ += event.type == EventType::Merge ? 1 : 0;
    unmerges_ += event.type == EventType::Unmerge ? 1 : 0;
    if (event.type == EventType::Unmerge) ++reasons_[static_cast<std::size_t>(event.reason)];
    broken_joints_ += event.type == EventType::Break ? 1 : 0;
  }
  max_penetration_ = std::max(max_penetration_, world.deepestOverlap());
}

std::string Summary::table(const Simulation& simulation, bool timings) const {
  const World& world = simulation.world();
  const Stats& stats = world.stats();
  std::string out;
  const auto row = [&](const std::string& what, const std::string& value) {
    out += fmt::format("{:<20}{}\n", what, value);
  };
  row("scene", world.scene().name);
  row("mode", name(world.mode()));
  row("steps", fmt::format("{} of {} s", world.steps(), world.scene().step));
  row("time", fmt::format("{:.6g} s", world.time()));
  row("bodies", fmt::format("{}, {} asleep", stats.bodies, stats.asleep));
  row("active bodies", fmt::format("{}", stats.active_bodies));
  row("collections", fmt::format("{}", stats.collections));
  row("contacts", fmt::format("{} solved, {} inside collections that are awake", stats.contacts,
                              stats.internal_contacts));
  row("merges", fmt::format("{}", merges_));
  row("unmerges", fmt::format("{}", unmerges_));
  if (!world.scene().joints.empty()) row("broken joints", fmt::format("{}", broken_joints_));
  row("deepest overlap", fmt::format("{:.3g} mm", 1e3 * max_penetration_));
  if (error_) {
    row("from reference", fmt::format("{:.3g} m, at most {:.3g} m", error_->mean, error_->max));
  }
  if (timings && !simulation.milliseconds().empty()) {
    row("time per step", fmt::format("{:.3g} ms, median {:.3g} ms", mean(simulation.milliseconds()),
                                     median(simulation.milliseconds())));
    const double speed = realTimeFactor(simulation);
    const int digits = speed < 10.0 ? 2 : speed < 100.0 ? 1 : 0;
    row("speed", fmt::format("{:.{}f} x real time", speed, digits));
  }
  return out;
}

std::string Summary::json(const Simulation& simulation, bool timings) const {
  const World& world = simulation.world();
  const Stats& stats = world.stats();
  nlohmann::ordered_json out;
  out["scene"] = world.scene().name;
  out["mode"] = name(world.mode());
  out["steps"] = world.steps();
  out["time"] = world.time();
  out["bodies"] = stats.bodies;
  out["active_bodies"] = stats.active_bodies;
  out["collections"] = stats.collections;
  out["asleep"] = stats.asleep;
  out["contacts"] = stats.contacts;
  out["internal_contacts"] = stats.internal_contacts;
  out["merges"] = merges_;
  out["unmerges"] = unmerges_;
  if (!world.scene().joints.empty()) out["broken_joints"] = broken_joints_;
  out["max_penetration"] = max_penetration_;
  out["ms_per_step"] = {{"mean", nullptr}, {"median", nullptr}};
  out["real_time_factor"] = nullptr;
  if (timings && !simulation.milliseconds().empty()) {
    out["ms_per_step"] = {{"mean", mean(simulation.milliseconds())},
                          {"median", median(simulation.milliseconds())}};
    out["real_time_factor"] = realTimeFactor(simulation);
  }
  out["unmerges_by_reason"] = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < reasons_.size(); ++i) {
    const auto reason = static_cast<EventReason>(i);
    if (reason != EventReason::None) out["unmerges_by_reason"][name(reason)] = reasons_[i];
  }
  Snapshot end;
  world.captureMotion(end);
  out["kinetic_energy"] = end.stats.kinetic_energy;  // null when it is not finite
  out["potential_energy"] = end.stats.potential_energy;
  if (error_) out["reference_error"] = {{"mean", error_->mean}, {"max", error_->max}};
  out["provenance"] = provenanceJson(world.scene());
  out["provenance"]["cpu_seconds"] = nullptr;
  out["provenance"]["wall_seconds"] = nullptr;
  if (timings) {
    const auto& ms = simulation.milliseconds();
    out["provenance"]["cpu_seconds"] = simulation.cpuSeconds();
    out["provenance"]["wall_seconds"] = 1e-3 * std::accumulate(ms.begin(), ms.end(), 0.0);
  }
  return out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace merge2d
