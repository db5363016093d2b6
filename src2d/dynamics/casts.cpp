#include "src2d/dynamics/casts.h"

namespace merge2d {

double touchingGap(const State& state, const ContactKey& key) {
  constexpr double kTouching = 1e-4, kPart = 1e-3;  // m, of the smaller shape
  const double size = state.thickness(key.shape_a, key.shape_b);
  return std::min(kTouching, kPart * size);
}

const Cast* castOf(const Scratch& scratch, const Contact& contact) {
  if (scratch.casts.empty() || contact.count == 0 || contact.points[0].gap <= 0.0) return nullptr;
  const auto cast = std::ranges::lower_bound(scratch.casts, contact.key, {}, &Cast::key);
  const bool known = cast != scratch.casts.end() && cast->key == contact.key;
  return known && cast->normal == contact.normal ? &*cast : nullptr;
}

const CastEnd* castOf(const Scratch& scratch, const Contact& contact, const ContactPoint& point) {
  const Cast* cast = castOf(scratch, contact);
  for (std::size_t k = 0; cast && k < cast->ends.size(); ++k) {
    if (cast->ends[k].feature == point.feature) return &cast->ends[k];
  }
  return nullptr;
}

Vec2 surfaceOfA(const Scratch& scratch, const Contact& contact, const ContactPoint& point) {
  const CastEnd* end = castOf(scratch, contact, point);
  return point.position - 0.5 * (end ? end->gap : point.gap) * contact.normal;
}

Vec2 surfaceOfB(const Scratch& scratch, const Contact& contact, const ContactPoint& point,
                const Pose& b_in_a) {
  const CastEnd* end = castOf(scratch, contact, point);
  const Vec2 half = 0.5 * (end ? end->gap : point.gap) * contact.normal;
  const Vec2 on_b = end ? end->on_b : b_in_a.toLocal(point.position);
  return on_b + b_in_a.rotation.inverse() * half;
}

}  // namespace merge2d
