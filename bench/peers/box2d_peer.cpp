#include "bench/peers/box2d_peer.h"

namespace merge2d::bench {
namespace {

constexpr int kPositionIterations = 3;

b2Vec2 single(const Vec2& a) { return {static_cast<float>(a.x()), static_cast<float>(a.y())}; }

b2BodyType type(Motion motion) {
  switch (motion) {
    case Motion::Pinned:
      return b2_staticBody;
    case Motion::Scripted:
      return b2_kinematicBody;
    case Motion::Dynamic:
      break;
  }
  return b2_dynamicBody;
}

void addFixture(b2Body& body, const BodyDesc& desc, const b2Shape& shape) {
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.density = static_cast<float>(desc.density);
  fixture.friction = static_cast<float>(desc.friction);
  fixture.restitution = static_cast<float>(desc.restitution);
  body.CreateFixture(&fixture);
}

void addShape(b2Body& body, const BodyDesc& desc, const Circle& circle) {
  b2CircleShape shape;
  shape.m_p = single(circle.center);
  shape.m_radius = static_cast<float>(circle.radius);
  addFixture(body, desc, shape);
}

void addShape(b2Body& body, const BodyDesc& desc, const Polygon& polygon) {
  std::vector<b2Vec2> vertices;
  for (const Vec2& vertex : polygon.vertices) vertices.push_back(single(vertex));
  b2PolygonShape shape;
  shape.Set(vertices.data(), static_cast<int>(vertices.size()));
  // The skin of two boxes that touch is as thick as the overlap that Box2D lets be: with the
  // thicker one that it comes with, walls would burst in the first steps.
  shape.m_radius = 0.5F * b2_linearSlop;
  addFixture(body, desc, shape);
}

}  // namespace

void Box2dPeer::load(const Scene& scene) {
  step_ = scene.step;
  iterations_ = scene.settings.solver.iterations;
  time_ = 0.0;
  bodies_.clear();
  scripted_.clear();
  world_ = std::make_unique<b2World>(single(scene.gravity));
  world_->SetAllowSleeping(false);
  world_->SetContinuousPhysics(false);
  for (const BodyDesc& desc : scene.bodies) add(desc);
}

void Box2dPeer::add(const BodyDesc& desc) {
  b2BodyDef definition;
  definition.type = type(desc.motion);
  definition.position = single(desc.at);
  definition.angle = static_cast<float>(desc.angle);
  definition.linearVelocity = single(desc.velocity);
  definition.angularVelocity = static_cast<float>(desc.spin);
  b2Body* body = world_->CreateBody(&definition);
  for (const ConvexShape& shape : desc.shapes) {
    std::visit([&](const auto& s) { addShape(*body, desc, s); }, shape);
  }
  if (desc.script) scripted_.push_back({body, &*desc.script});
  bodies_.push_back(body);
}

void Box2dPeer::step() {
  for (const Scripted& s : scripted_) {
    const ScriptedVelocity velocity = scriptedVelocity(*s.script, time_, step_);
    s.body->SetLinearVelocity(single(velocity.v));
    s.body->SetAngularVelocity(static_cast<float>(velocity.omega));
  }
  world_->Step(static_cast<float>(step_), iterations_, kPositionIterations);
  time_ += step_;
}

std::vector<Vec2> Box2dPeer::positions() const {
  std::vector<Vec2> result;
  for (const b2Body* body : bodies_) {
    const b2Vec2& center = body->GetWorldCenter();
    result.emplace_back(center.x, center.y);
  }
  return result;
}

}  // namespace merge2d::bench
