/// The motion of two rigid things that become one: Eqs. (10)-(14).

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "src2d/collections/collection.h"
#include "tests/support/random.h"

namespace merge2d {
namespace {

Rigid anyRigid() {
  Rigid r;
  r.x = anyVec(10.0);
  r.angle = uniform(-3.0, 3.0);
  r.rotation = Rotation::of(r.angle);
  r.v = anyVec(5.0);
  r.omega = uniform(-4.0, 4.0);
  r.mass = uniform(0.1, 20.0);
  r.inertia = uniform(0.1, 20.0);
  return r;
}

Vec2 momentum(const Rigid& r) { return r.mass * r.v; }
double angularMomentum(const Rigid& r) {
  return r.inertia * r.omega + r.mass * cross(r.exactCenter(), r.v);
}

RC_GTEST_PROP(AddMotion, ConservesMomentum, ()) {  // Eqs. (10), (11)
  Rigid c = anyRigid();
  const Rigid b = anyRigid();
  const Vec2 linear = momentum(c) + momentum(b);
  const double angular = angularMomentum(c) + angularMomentum(b);
  const double scale = std::abs(angularMomentum(c)) + std::abs(angularMomentum(b)) + 1000.0;
  addMotion(c, b);
  RC_ASSERT((momentum(c) - linear).norm() <= 1e-13 * (linear.norm() + 100.0));
  RC_ASSERT(std::abs(angularMomentum(c) - angular) <= 1e-14 * scale);
}

RC_GTEST_PROP(AddMotion, LeavesACommonRigidMotionAsItIs, ()) {
  Rigid c = anyRigid(), b = anyRigid();
  b.v = c.velocityAt(b.x);
  b.omega = c.omega;
  const Rigid before = c;
  addMotion(c, b);
  RC_ASSERT(std::abs(c.omega - before.omega) < 1e-12);
  RC_ASSERT((c.v - before.velocityAt(c.exactCenter())).norm() < 1e-12);
}

RC_GTEST_PROP(AddMotion, LeavesTheFrameInItsPlace, ()) {
  Rigid c = anyRigid();
  const Pose before = c.frame();
  addMotion(c, anyRigid());
  RC_ASSERT((c.frame().position - before.position).norm() < 1e-12);
}

RC_GTEST_PROP(AddMotion, InertiaFollowsTheParallelAxisTheorem, ()) {  // Eqs. (12)-(14)
  Rigid c = anyRigid();
  const Rigid a = c, b = anyRigid();
  addMotion(c, b);
  const double reduced = a.mass * b.mass / (a.mass + b.mass);
  const double inertia = a.inertia + b.inertia + reduced * (a.x - b.x).squaredNorm();
  RC_ASSERT(std::abs(c.inertia - inertia) <= 1e-13 * inertia);
  RC_ASSERT((c.mass * c.x - a.mass * a.x - b.mass * b.x).norm() < 1e-11);
}

}  // namespace
}  // namespace merge2d
