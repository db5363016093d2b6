#include "app/load_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "app/joint_watch.h"
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
  bool sinks = false;  ///< by a quarter of their size, as no blow does
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

/// A warning tells of deeper overlaps than this [m].
double thresholdFor(const Ends& ends) {
  constexpr double kLittle = 0.02;  // of the size; and 2 cm
  return kLittle * std::min(ends.size, 1.0);
}

/// The loads on the contacts of a world, and how deep they push its bodies into each other.
class LoadWatch {
 public:
  explicit LoadWatch(const World& world) : world_(world) {}

  /// After each step: overlaps as they are, of blows too, but for those of the start and those of
  /// bodies that press each other with little more than their own mass.
  void update() {
    const bool first = seen_++ == 0;
    const std::vector<double> heaviest = heaviestNeighbours();
    for (const auto& [pair, load] : loads(&overlapNow)) {
      if (load.depth == 0.0) continue;
      if (!first && !load.sinks && !isPressed(pair, heaviest)) continue;
      if (first) from_the_start_.insert(pair);
      if (from_the_start_.contains(pair)) continue;
      if (load.depth > deepest_.depth) deepest_ = load;
    }
  }

  /// At the end: contacts at rest may have further to go.
  Press deepest() const {
    Press most = deepest_;
    for (const auto& [pair, load] : loads(&overlapToCome)) {
      if (load.depth > most.depth) most = load;
    }
    return most;
  }

 private:
  using Pair = std::pair<BodyId, BodyId>;

  static bool responds(const BodyInfo& body) { return body.motion == Motion::Dynamic; }

  /// Per body: the mass of the heaviest dynamic body that it touches [kg].
  std::vector<double> heaviestNeighbours() const {
    std::vector<double> heaviest(world_.bodies().size(), 0.0);
    const auto add = [&](BodyId to, BodyId of) {
      const BodyInfo& body = world_.bodies()[index(of)];
      if (responds(body)) heaviest[index(to)] = std::max(heaviest[index(to)], body.mass);
    };
    for (const ContactView& contact : world_.capture().contacts) {
      add(contact.a, contact.b);
      add(contact.b, contact.a);
    }
    return heaviest;
  }

  /// By something of ten times the mass of one of the two.
  bool isPressed(const Pair& pair, const std::vector<double>& heaviest) const {
    constexpr double kHeavy = 10.0;
    const auto pressed = [&](BodyId b) {
      const BodyInfo& body = world_.bodies()[index(b)];
      return responds(body) && heaviest[index(b)] >= kHeavy * body.mass;
    };
    return pressed(pair.first) || pressed(pair.second);
  }

  static double overlapNow(const ContactView& contact, const Ends&, const Scene&) {
    return contact.lambda_n > 0.0 ? -contact.gap : 0.0;
  }
  static double overlapToCome(const ContactView& contact, const Ends& ends, const Scene& scene) {
    constexpr double kResting = 0.05;  // [m/s]
    if (std::abs(contact.w_n) > kResting) return 0.0;
    return depthUnder(contact.lambda_n, ends, scene);
  }

  /// The force of each pair, and the depth of its contacts where it is much.
  template <class Depth>
  std::map<Pair, Press> loads(Depth&& depthOf) const {
    std::map<Pair, Press> loads;
    for (const ContactView& contact : world_.capture().contacts) {
      Ends ends;
      ends.add(world_.bodies()[index(contact.a)]);
      ends.add(world_.bodies()[index(contact.b)]);
      Press& load = loads[{contact.a, contact.b}];
      load.a = contact.a;
      load.b = contact.b;
      load.force += contact.lambda_n / world_.scene().step;
      const double depth = depthOf(contact, ends, world_.scene());
      load.sinks |= depth > 0.25 * ends.size;
      if (depth > thresholdFor(ends)) load.depth = std::max(load.depth, depth);
    }
    return loads;
  }

  const World& world_;
  std::set<Pair> from_the_start_;
  Press deepest_;
  int seen_ = 0;
};

void warnOfPress(const World& world, const Press& load, Scene& scene) {
  if (load.depth == 0.0) return;
  const auto& bodies = world.bodies();
  scene.warnings.push_back(
      fmt::format("'{}' and '{}' press on each other with {:.3g} N, which pushes them {:.2g} m "
                  "into each other: "
                  "less where the lighter one is heavier, or with a smaller step",
                  bodies[index(load.a)].name, bodies[index(load.b)].name, load.force, load.depth));
}

/// When the last impulse comes, force sets in, or body is let go [s].
double lastChange(const Scene& scene) {
  double last = 0.0;
  for (const ImpulseDesc& impulse : scene.impulses) last = std::max(last, impulse.time);
  for (const ForceDesc& force : scene.forces) last = std::max(last, force.from);
  for (const BodyDesc& body : scene.bodies) last = std::max(last, body.pinned_until);
  return last;
}

/// How long a scene is watched: until the contact forces of a stack have settled, and most falls
/// have ended, after all that is to come, where that does not take long.
int stepsToWatch(const Scene& scene) {
  constexpr int kLeast = 100, kWork = 200'000;  // steps, and steps times bodies
  constexpr double kLong = 3.0;                 // [s]
  const auto bodies = static_cast<int>(scene.bodies.size()) + 1;
  const double wanted = std::min(lastChange(scene) + kLong, scene.duration) / scene.step;
  return std::max(kLeast, std::min(static_cast<int>(wanted), kWork / bodies));
}

}  // namespace

void warnOfHeavyLoads(Scene& scene) {
  World world(scene, {.mode = Mode::Reference, .timings = false});
  LoadWatch loads(world);
  JointWatch joints(world);
  try {
    for (int i = stepsToWatch(scene); i > 0; --i) {
      world.step();
      loads.update();
      joints.update();
    }
  } catch (const SimulationError&) {
    return;  // the run will tell
  }
  warnOfPress(world, loads.deepest(), scene);
  if (const auto warning = joints.warning()) scene.warnings.push_back(*warning);
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
