#include "render/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace merge2d {
namespace {

constexpr double kHuge = 2.5;        // times the rest: such a fixed body is not shown whole
constexpr double kNear = 0.1;        // of the height: how far around the rest it is shown
constexpr double kSpareAbove = 0.3;  // of spare room, by which the picture moves up; 0.5 is all
constexpr double kSmallest = 1e-4;   // [m]
constexpr double kFarthest = 10.0;   // times the size of the beginning

Aabb intersection(const Aabb& a, const Aabb& b) {
  return {a.lower.cwiseMax(b.lower), a.upper.cwiseMin(b.upper)};
}

}  // namespace

Aabb bodyBounds(const BodyInfo& info, const Pose& pose) {
  Aabb box;
  for (const ConvexShape& shape : info.shapes) box.include(bounds(shape, pose));
  return box;
}

void Coverage::add(const Snapshot& snapshot, const std::vector<BodyInfo>& bodies) {
  bodies_.resize(bodies.size());
  const auto boxOf = [&](const BodyState& b) { return bodyBounds(bodies[index(b.id)], b.pose()); };
  if (home_.empty() && !snapshot.bodies.empty()) {
    for (const BodyState& body : snapshot.bodies) home_.include(boxOf(body));
    home_ = home_.grown(kFarthest * home_.extent().maxCoeff());
  }
  for (const BodyState& body : snapshot.bodies) {
    const Aabb part = intersection(boxOf(body), home_);
    if (!part.empty() && part.lower.y() <= part.upper.y()) bodies_[index(body.id)].include(part);
  }
  for (const SpringView& spring : snapshot.springs) {
    marks_.include(spring.from);
    marks_.include(spring.to);
  }
  for (const JointView& joint : snapshot.joints) {
    if (!joint.broken && joint.to_world) marks_.include(joint.to);
  }
}

Camera fitCamera(const Snapshot& snapshot, const std::vector<BodyInfo>& bodies, double aspect,
                 double margin) {
  return fitCamera(Coverage(snapshot, bodies), bodies, aspect, margin);
}

Camera fitCamera(const Coverage& seen, const std::vector<BodyInfo>& bodies, double aspect,
                 double margin) {
  Aabb moving, all;
  for (std::size_t i = 0; i < seen.ofBodies().size(); ++i) {
    all.include(seen.ofBodies()[i]);
    if (bodies[i].motion == Motion::Dynamic) moving.include(seen.ofBodies()[i]);
  }
  Aabb shown = moving.empty() ? all : moving;
  if (shown.empty()) return {};

  // Fixed bodies of the same size belong to the scene; of larger ones what is near.
  const double size = std::max(shown.extent().maxCoeff(), kSmallest);
  const Aabb near = shown.grown(kNear * std::max(shown.extent().y(), shown.extent().x() / aspect));
  for (std::size_t i = 0; i < seen.ofBodies().size(); ++i) {
    const Aabb& box = seen.ofBodies()[i];
    if (moving.empty() || box.empty() || bodies[i].motion == Motion::Dynamic) continue;
    const bool huge = box.extent().maxCoeff() > kHuge * size;
    const Aabb part = huge ? intersection(box, near) : box;
    if (!part.empty() && part.lower.y() <= part.upper.y()) shown.include(part);
  }
  shown.include(seen.ofMarks());
  const Vec2 extent = shown.extent();
  const double needed = (1.0 + 2.0 * margin) * extent.y();
  const double height = std::max({needed, (1.0 + 2.0 * margin) * extent.x() / aspect, kSmallest});
  // In a wide scene most of the spare room is above, where things come from.
  return {shown.center() + Vec2(0.0, kSpareAbove * (height - needed)), height};
}

View::View(const Camera& camera, const PixelBox& where)
    : panel(where), center(camera.center), scale(where.height / camera.height) {}

Aabb View::visible(double margin) const {
  const Vec2 half(0.5 * panel.width + margin, 0.5 * panel.height + margin);
  return {center - half / scale, center + half / scale};
}

double roundLength(double longest) {
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= longest) return digit * power;
  }
  return power;
}

std::string lengthLabel(double metres) {
  if (metres >= 1000.0) return fmt::format("{:g} km", metres / 1000.0);
  if (metres >= 1.0) return fmt::format("{:g} m", metres);
  if (metres >= 0.01) return fmt::format("{:g} cm", metres * 100.0);
  return fmt::format("{:g} mm", metres * 1000.0);
}

}  // namespace merge2d
