#include "bench/peers/chipmunk_peer.h"

namespace merge2d::bench {
namespace {

constexpr double kSlop = 0.005;  // [m]

cpVect vect(const Vec2& a) { return cpv(a.x(), a.y()); }

// Mass and inertia follow from the shapes' densities.
cpBody* newBody(Motion motion) {
  switch (motion) {
    case Motion::Pinned:
      return cpBodyNewStatic();
    case Motion::Scripted:
      return cpBodyNewKinematic();
    case Motion::Dynamic:
      break;
  }
  return cpBodyNew(0.0, 0.0);
}

cpShape* newShape(cpBody* body, const Circle& circle) {
  return cpCircleShapeNew(body, circle.radius, vect(circle.center));
}

cpShape* newShape(cpBody* body, const Polygon& polygon) {
  std::vector<cpVect> vertices;
  for (const Vec2& vertex : polygon.vertices) vertices.push_back(vect(vertex));
  return cpPolyShapeNewRaw(body, static_cast<int>(vertices.size()), vertices.data(), 0.0);
}

}  // namespace

void ChipmunkPeer::addShape(cpBody* body, const BodyDesc& desc, const ConvexShape& shape) {
  shapes_.emplace_back(std::visit([&](const auto& s) { return newShape(body, s); }, shape));
  cpShape* added = cpSpaceAddShape(space_.get(), shapes_.back().get());
  if (desc.motion == Motion::Dynamic) cpShapeSetDensity(added, desc.density);
  // Chipmunk multiplies two bodies' frictions, the others take the geometric mean.
  cpShapeSetFriction(added, std::sqrt(desc.friction));
  cpShapeSetElasticity(added, desc.restitution);
}

void ChipmunkPeer::load(const Scene& scene) {
  step_ = scene.step;
  time_ = 0.0;
  scripted_.clear();
  space_.reset(cpSpaceNew());
  shapes_.clear();
  bodies_.clear();
  cpSpaceSetIterations(space_.get(), scene.settings.solver.iterations);
  cpSpaceSetGravity(space_.get(), vect(scene.gravity));
  cpSpaceSetCollisionSlop(space_.get(), kSlop);
  for (const BodyDesc& desc : scene.bodies) add(desc);
  cpSpaceReindexStatic(space_.get());
}

void ChipmunkPeer::add(const BodyDesc& desc) {
  bodies_.emplace_back(newBody(desc.motion));
  cpBody* body = cpSpaceAddBody(space_.get(), bodies_.back().get());
  cpBodySetPosition(body, vect(desc.at));
  cpBodySetAngle(body, desc.angle);
  for (const ConvexShape& shape : desc.shapes) addShape(body, desc, shape);
  if (desc.motion == Motion::Dynamic) {
    cpBodySetVelocity(body, vect(desc.velocity));
    cpBodySetAngularVelocity(body, desc.spin);
  }
  if (desc.script) scripted_.push_back({body, &*desc.script});
}

void ChipmunkPeer::step() {
  for (const Scripted& s : scripted_) {
    const ScriptedVelocity velocity = scriptedVelocity(*s.script, time_, step_);
    cpBodySetVelocity(s.body, vect(velocity.v));
    cpBodySetAngularVelocity(s.body, velocity.omega);
  }
  cpSpaceStep(space_.get(), step_);
  time_ += step_;
}

std::vector<Vec2> ChipmunkPeer::positions() const {
  std::vector<Vec2> result;
  for (const auto& body : bodies_) {
    const cpVect center = cpBodyLocalToWorld(body.get(), cpBodyGetCenterOfGravity(body.get()));
    result.emplace_back(center.x, center.y);
  }
  return result;
}

}  // namespace merge2d::bench
