#include "src2d/merging/pair_metric.h"

namespace merge2d {

VelocityField motionField(const Rigid& r) { return {r.x, r.v, r.omega}; }

OrientedBox worldBox(const State& state, const Rigid& r) {
  OrientedBox box = state.extent(r).box;
  box.frame = r.frame() * box.frame;
  return box;
}

namespace {

/// Notes the corners of a box and the relative velocities of the two there.
void noteCorners(Notes* notes, const BodyPair& pair, const OrientedBox& box, const Rigid& a,
                 const Rigid& b) {
  if (!notes) return;
  NotedCorners seen{.a = pair.a, .b = pair.b, .at = box.corners()};
  for (std::size_t i = 0; i < seen.at.size(); ++i) {
    seen.velocity[i] = motionField(a).at(seen.at[i]) - motionField(b).at(seen.at[i]);
  }
  notes->corners.push_back(seen);
}

/// The naive metric: the fastest of a pair's contact points, which misses a beam that turns about
/// one.
double fastestContact(const State& state, const BodyPair& pair) {
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

double relativeMotion(const State& state, const BodyPair& pair, Notes* notes) {
  const bool touches = pair.count > 0;  // or is held by joints alone
  if (touches && state.settings.merging.metric == Metric::Naive) return fastestContact(state, pair);
  const Rigid &a = state.rigid(pair.a), &b = state.rigid(pair.b);
  double fastest = 0.0;
  for (const Rigid* r : {&a, &b}) {
    if (!r->floating()) continue;
    const OrientedBox box = worldBox(state, *r);
    fastest = std::max(fastest, fastestCorner(box, motionField(a), motionField(b)));
    noteCorners(notes, pair, box, a, b);
  }
  return fastest;
}

}  // namespace merge2d
