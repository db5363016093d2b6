#include "src2d/merging/pair_metric.h"

namespace merge2d {

VelocityField motionField(const Rigid& r) { return {r.x, r.v, r.omega}; }

OrientedBox worldBox(const State& state, const Rigid& r) {
  OrientedBox box = state.extent(r).box;
  box.frame = r.frame() * box.frame;
  return box;
}

bool isNaive(const State& state, const BodyPair& pair) {
  return pair.count > 0 && state.settings.merging.metric == Metric::Naive;
}

namespace {

/// Calls `f` with the box of each floating thing of a pair.
template <class F>
void forEachBox(const State& state, const BodyPair& pair, F&& f) {
  for (const BodyId b : {pair.a, pair.b}) {
    const Rigid& r = state.rigid(b);
    if (r.floating()) f(worldBox(state, r));
  }
}

/// The naive metric: the fastest of a pair's contact points, which misses a beam that turns about
/// one.
double fastestContactPoint(const State& state, const BodyPair& pair) {
  const Pose pose = state.pose(pair.a);
  double fastest = 0.0;
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const Contact& contact = state.contacts[state.contacts.order[i]];
    for (int k = 0; k < contact.count; ++k) {
      const Vec2 at = pose * contact.points[static_cast<std::size_t>(k)].position;
      const Vec2 w =
          motionField(state.rigid(pair.a)).at(at) - motionField(state.rigid(pair.b)).at(at);
      fastest = std::max(fastest, w.norm());
    }
  }
  return fastest;
}

}  // namespace

double relativeMotion(const State& state, const BodyPair& pair) {
  if (isNaive(state, pair)) return fastestContactPoint(state, pair);
  const VelocityField a = motionField(state.rigid(pair.a)), b = motionField(state.rigid(pair.b));
  double fastest = 0.0;
  forEachBox(state, pair, [&](const OrientedBox& box) {
    fastest = std::max(fastest, fastestCorner(box, a, b));
  });
  return fastest;
}

void noteCorners(const State& state, const BodyPair& pair, Notes* notes) {
  if (!notes || isNaive(state, pair)) return;
  const VelocityField a = motionField(state.rigid(pair.a)), b = motionField(state.rigid(pair.b));
  forEachBox(state, pair, [&](const OrientedBox& box) {
    NotedCorners seen{.a = pair.a, .b = pair.b, .at = box.corners()};
    for (std::size_t i = 0; i < seen.at.size(); ++i) {
      seen.velocity[i] = a.at(seen.at[i]) - b.at(seen.at[i]);
    }
    notes->corners.push_back(seen);
  });
}

}  // namespace merge2d
