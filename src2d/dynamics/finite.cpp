#include "src2d/dynamics/finite.h"

#include <fmt/format.h>

#include <cmath>

#include "src2d/core/error.h"

namespace merge2d {
namespace {

bool isFinite(const SolverVelocity& u) { return std::isfinite(u.vx + u.vy + u.omega); }

bool isFinite(const Rigid& r) { return std::isfinite(r.x.sum() + r.v.sum() + r.angle + r.omega); }

/// Names what went wrong, and where.
class Report {
 public:
  Report(const State& state, Stage stage, const std::function<std::string(BodyId)>& name_of)
      : state_(state), stage_(stage), name_of_(name_of) {}

  [[noreturn]] void place(RigidId id) const {
    const Rigid& r = state_[id];
    fail(state_.firstBody(id), "at a finite place",
         fmt::format("x = {}, {}; v = {}, {}; omega = {}", r.x.x(), r.x.y(), r.v.x(), r.v.y(),
                     r.omega));
  }

  [[noreturn]] void velocity(BodyId body, const SolverVelocity& u) const {
    fail(body, "of a finite velocity", fmt::format("v = {}, {}; omega = {}", u.vx, u.vy, u.omega));
  }

 private:
  [[noreturn]] void fail(BodyId body, const char* what, const std::string& numbers) const {
    throw SimulationError(
        fmt::format("body '{}' is no longer {} after {} in step {} ({}); try a smaller step, "
                    "softer springs or shorter levers",
                    name_of_(body), what, name(stage_), state_.step + 1, numbers));
  }

  const State& state_;
  Stage stage_;
  const std::function<std::string(BodyId)>& name_of_;
};

/// The velocities of members after a sweep.
void checkSweep(const State& state, const Scratch& scratch, const Report& report) {
  if (scratch.last_sweep != state.step) return;
  for (const Collection& c : state.collections) {
    if (c.id == kNoCollection || state[c.rigid].asleep) continue;
    for (const BodyId b : c.members) {
      const SolverVelocity& u = scratch.sweep_u[index(b)];
      if (scratch.swept[index(b)] != 0 && !isFinite(u)) report.velocity(b, u);
    }
  }
}

/// The velocities of all that touches something after the full solve.
void checkSolve(const State& state, const Scratch& scratch, const Report& report) {
  for (const std::uint32_t i : scratch.island_bodies) {
    const bool world = i >= state.rigids.size();
    if (!world && !isFinite(scratch.u[i]))
      report.velocity(state.firstBody(RigidId{i}), scratch.u[i]);
  }
}

void checkBodies(const State& state, const Report& report) {
  for (const RigidId id : state.present) {
    if (!isFinite(state[id])) report.place(id);
  }
}

}  // namespace

void checkFinite(const State& state, const Scratch& scratch, Stage stage,
                 const std::function<std::string(BodyId)>& name_of) {
  const Report report(state, stage, name_of);
  switch (stage) {
    case Stage::SingleIterationPGS:
      return checkSweep(state, scratch, report);
    case Stage::SolveLCP:
      return checkSolve(state, scratch, report);
    case Stage::AdvanceVelocities:
    case Stage::AdvancePositions:
      return checkBodies(state, report);
    default:
      return;
  }
}

}  // namespace merge2d
