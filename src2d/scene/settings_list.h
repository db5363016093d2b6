#pragma once
/// Every setting by its table and key, in one place: loading, writing, `--set` and whoever prints
/// the parameters of a run go through this list.

#include "src2d/scene/range.h"
#include "src2d/scene/settings.h"

namespace merge2d {

/// Calls `f(table, key, value, range)` for each setting; `value` is a reference to a double, int,
/// bool or enumeration with names (scene/names.h). `S` is `Settings` or `const Settings`.
template <class S, class F>
void forEachSetting(S& settings, F&& f) {
  auto& solver = settings.solver;
  f("solver", "method", solver.method, kAnyNumber);
  f("solver", "iterations", solver.iterations, kAtLeastOne);
  f("solver", "stabilisation", solver.stabilisation, kAnyNumber);
  f("solver", "erp", solver.erp, kFraction);
  f("solver", "compliance", solver.compliance, kNotNegative);
  f("solver", "max_correction", solver.max_correction, kNotNegative);
  f("solver", "margin", solver.margin, kNotNegative);
  f("solver", "restitution_velocity", solver.restitution_velocity, kNotNegative);

  auto& merging = settings.merging;
  f("merging", "rule", merging.rule, kAnyNumber);
  f("merging", "velocity", merging.velocity, kNotNegative);
  f("merging", "breathing", merging.breathing, kNotNegative);
  f("merging", "sliding", merging.sliding, kNotNegative);
  f("merging", "steps", merging.steps, kCountedSteps);
  f("merging", "cycles", merging.cycles, kAnyNumber);
  f("merging", "metric", merging.metric, kAnyNumber);

  auto& unmerging = settings.unmerging;
  f("unmerging", "rule", unmerging.rule, kAnyNumber);
  f("unmerging", "velocity", unmerging.velocity, kNotNegative);
  f("unmerging", "sliding", unmerging.sliding, kNotNegative);
  f("unmerging", "steps", unmerging.steps, kCountedSteps);
  f("unmerging", "sweeps", unmerging.sweeps, kAtLeastOne);
  f("unmerging", "ordering", unmerging.ordering, kAnyNumber);

  auto& sleeping = settings.sleeping;
  f("sleeping", "velocity", sleeping.velocity, kNotNegative);
  f("sleeping", "steps", sleeping.steps, kAtLeastOne);
  f("sleeping", "time", sleeping.time, kNotNegative);

  auto& material = settings.material;
  f("material", "friction", material.friction, kNotNegative);
  f("material", "restitution", material.restitution, kFraction);
  f("material", "rolling", material.rolling, kNotNegative);
  f("material", "density", material.density, kPositive);

  auto& drawing = settings.drawing;
  f("drawing", "pixel", drawing.pixel, kLength);
  f("drawing", "stiffness", drawing.stiffness, kNotNegative);
  f("drawing", "damping", drawing.damping, kNotNegative);
  f("drawing", "pinned_until", drawing.pinned_until, kNotNegative);
}

}  // namespace merge2d
