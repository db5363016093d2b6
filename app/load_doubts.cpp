#include "app/load_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "src2d/core/error.h"
#include "src2d/geometry/box.h"
#include "src2d/scene/compliance.h"
#include "src2d/world.h"

namespace merge2d {
namespace {

/// The smaller side of the bounding box of a body's shapes [m].
double sizeOf(const std::vector<ConvexShape>& shapes) {
  std::vector<Vec2> outline;
  for (const ConvexShape& shape : shapes) {
    for (const Vec2& p : outlinePoints(shape)) outline.push_back(p);
  }
  return 2.0 * tightBox(outline).half.minCoeff();
}

/// Two bodies, the force between them [N], and how far their contacts will yield to it [m].
struct Press {
  BodyId a{}, b{};
  double force = 0.0, depth = 0.0;
};

/// 1/m and the smallest size of the bodies that respond to forces.
struct Ends {
  double inv_mass = 0.0;
  double size = std::numeric_limits<double>::infinity();

  void add(const BodyInfo& body) {
    if (body.motion != Motion::Dynamic) return;
    inv_mass += 1.0 / body.mass;
    size = std::min(size, sizeOf(body.shapes));
  }
};

/// As the full solve has it: a bias of erp · depth / h against C λ.
double depthUnder(double lambda, const Ends& ends, const Scene& scene) {
  const SolverSettings& s = scene.settings.solver;
  if (s.stabilisation == Stabilisation::Post || s.erp == 0.0) return 0.0;
  const double fall = scene.gravity.norm() * scene.step * scene.step;
  const double compliance = complianceFor(s, ends.size, fall);
  return compliance * ends.inv_mass * lambda * scene.step / s.erp;
}

/// The contact that yields most, by more than the given part of the size of its bodies.
Press heaviest(const World& world, double part) {
  constexpr double kResting = 0.05;  // [m/s]
  std::map<std::pair<BodyId, BodyId>, Press> loads;
  for (const ContactView& contact : world.capture().contacts) {
    Ends ends;
    ends.add(world.bodies()[index(contact.a)]);
    ends.add(world.bodies()[index(contact.b)]);
    // Where C λ is more than the fastest correction, the bodies sink without end.
    const bool sinks = contact.lambda_n > 0.0 && -contact.gap > part * ends.size;
    if (std::abs(contact.w_n) > kResting && !sinks) continue;
    const double depth =
        std::max(depthUnder(contact.lambda_n, ends, world.scene()), sinks ? -contact.gap : 0.0);
    Press& load = loads[{contact.a, contact.b}];
    load.a = contact.a;
    load.b = contact.b;
    load.force += contact.lambda_n / world.scene().step;
    if (depth > part * ends.size) load.depth = std::max(load.depth, depth);
  }
  Press most;
  for (const auto& [pair, load] : loads) {
    if (load.depth > most.depth) most = load;
  }
  return most;
}

}  // namespace

void warnOfHeavyLoads(Scene& scene) {
  constexpr int kSteps = 100;       // until the contact forces of a stack have settled
  constexpr double kLittle = 0.02;  // of the size
  World world(scene, {.mode = Mode::Reference, .timings = false});
  try {
    for (int i = 0; i < kSteps; ++i) world.step();
  } catch (const SimulationError&) {
    return;  // the run will tell
  }
  const Press load = heaviest(world, kLittle);
  if (load.depth == 0.0) return;
  const auto& bodies = world.bodies();
  scene.warnings.push_back(
      fmt::format("'{}' and '{}' press on each other with {:.3g} N, which pushes them {:.2g} m "
                  "into each other: "
                  "less where the lighter one is heavier, or with a smaller step",
                  bodies[index(load.a)].name, bodies[index(load.b)].name, load.force, load.depth));
}

void warnOfSmallBodies(Scene& scene) {
  const double fall = scene.gravity.norm() * scene.step * scene.step;
  const BodyDesc* smallest = nullptr;
  double size = fall;
  for (const BodyDesc& body : scene.bodies) {
    if (body.motion != Motion::Dynamic || sizeOf(body.shapes) >= size) continue;
    size = sizeOf(body.shapes);
    smallest = &body;
  }
  if (!smallest) return;
  scene.warnings.push_back(fmt::format(
      "'{}' is {:.2g} m small and falls by {:.2g} m in a step: a smaller step shows more",
      smallest->name, size, fall));
}

}  // namespace merge2d
