#include "app/joint_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src2d/geometry/box.h"

namespace merge2d {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// The longer side of the bounding box of a body's shapes [m].
double lengthOf(const std::vector<ConvexShape>& shapes) {
  std::vector<Vec2> outline;
  for (const ConvexShape& shape : shapes) {
    for (const Vec2& p : outlinePoints(shape)) outline.push_back(p);
  }
  return 2.0 * tightBox(outline).half.maxCoeff();
}

/// How far the two ends of a joint are from where it holds them [m].
double openingOf(const JointView& joint) {
  if (joint.broken || joint.kind == JointKind::Distance) return 0.0;
  const Vec2 apart = joint.to - joint.from;
  return joint.kind == JointKind::Prismatic ? std::abs(cross(joint.axis, apart)) : apart.norm();
}

}  // namespace

JointWatch::JointWatch(const World& world) : world_(world) {
  constexpr double kPart = 0.01;  // of the length; and 1 cm
  const auto joints = world.capture().joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    double length = 1.0;
    const auto shorten = [&](BodyId b) {
      const BodyInfo& body = world.bodies()[index(b)];
      if (body.motion == Motion::Dynamic) length = std::min(length, lengthOf(body.shapes));
    };
    shorten(joints[i].a);
    if (!joints[i].to_world) shorten(joints[i].b);
    const bool yields = world.scene().joints[i].compliance > 0.0;
    thresholds_.push_back(yields ? kUnlimited : kPart * length + openingOf(joints[i]));
  }
}

void JointWatch::update() {
  if (thresholds_.empty()) return;
  const auto joints = world_.capture().joints;
  for (std::size_t i = 0; i < thresholds_.size(); ++i) {
    const double opening = openingOf(joints[i]);
    if (opening <= std::max(opening_, thresholds_[i])) continue;
    opening_ = opening;
    worst_ = i;
  }
}

std::optional<std::string> JointWatch::warning() const {
  if (opening_ == 0.0) return std::nullopt;
  const auto& name = world_.scene().bodies[world_.scene().joints[worst_].a].name;
  return fmt::format(
      "joint[{}] of '{}' is pulled open by {:.2g} m: less with a smaller step, or where a chain "
      "between two fixed ends has some slack",
      worst_, name, opening_);
}

}  // namespace merge2d
