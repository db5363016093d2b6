#include "src2d/contact/internal_edges.h"

#include <algorithm>

namespace merge2d {
namespace {

constexpr double kBeside = 3e-3;    ///< how far beside the point, along the surface, we look [m]
constexpr double kBehind = 1.5e-3;  ///< how far before the surface [m]
constexpr double kSkin = 1e-4;      ///< a place within this of a shape belongs to it [m]

bool insideSibling(const State& state, std::uint32_t shape, const Vec2& p) {
  const auto begin = state.siblings.begin() + state.first_sibling[shape];
  const auto end = state.siblings.begin() + state.first_sibling[shape + 1];
  return std::any_of(begin, end, [&](std::uint32_t sibling) {
    return signedDistance(state.collider(sibling), p) < kSkin;
  });
}

/// True when what lies before the surface at `p`, on both sides along it, is the body itself.
/// `normal` leads out of the shape; all in the body's frame.
bool onInternalEdge(const State& state, std::uint32_t shape, const Vec2& p, const Vec2& normal) {
  bool covered = false;
  for (const double side : {-kBeside, kBeside}) {
    const Vec2 beside = p + side * perpendicular(normal);
    if (signedDistance(state.collider(shape), beside) > kSkin)
      continue;  // beyond the surface's end
    if (!insideSibling(state, shape, beside + kBehind * normal)) return false;
    covered = true;
  }
  return covered;
}

}  // namespace

double signedDistance(const Collider& shape, const Vec2& p) {
  if (shape.isCircle()) return (p - shape.origin()).norm() - shape.radius();
  double most = -1e300;
  for (int i = 0; i < shape.count(); ++i) {
    most = std::max(most, shape.normal(i).dot(p - shape.vertex(i)));
  }
  return most;
}

void listSiblings(State& state) {
  state.siblings.clear();
  state.first_sibling.assign(state.shape_body.size() + 1, 0);
  for (const Body& body : state.bodies) {
    AabbTree tree;
    const std::uint32_t first = body.first_shape, last = first + body.shape_count;
    for (std::uint32_t s = first; s < last && body.shape_count > 1; ++s) {
      tree.insert(state.bounds(s), s);
    }
    for (std::uint32_t s = first; s < last; ++s) {
      const std::size_t begin = state.siblings.size();
      const Aabb near = state.bounds(s).grown(kBehind);
      if (body.shape_count > 1) {
        tree.query(near, [&](std::uint32_t other) {
          if (other != s && near.overlaps(state.bounds(other))) state.siblings.push_back(other);
        });
      }
      std::sort(state.siblings.begin() + static_cast<std::ptrdiff_t>(begin), state.siblings.end());
      state.first_sibling[s + 1] = static_cast<std::uint32_t>(state.siblings.size());
    }
  }
  if (state.siblings.empty()) std::vector<std::uint32_t>().swap(state.first_sibling);
}

void dropInternalEdges(const State& state, const Pose& b_in_a, Contact& contact) {
  const bool look_at_a = hasSiblings(state, contact.key.shape_a);
  const bool look_at_b = hasSiblings(state, contact.key.shape_b);
  if (!look_at_a && !look_at_b) return;
  const Vec2& n = contact.normal;
  const auto internal = [&](const ContactPoint& point) {
    const Vec2 on_a = point.position - 0.5 * point.gap * n;
    const Vec2 on_b = b_in_a.toLocal(Vec2(point.position + 0.5 * point.gap * n));
    return (look_at_a && onInternalEdge(state, contact.key.shape_a, on_a, n)) ||
           (look_at_b &&
            onInternalEdge(state, contact.key.shape_b, on_b, b_in_a.rotation.inverse() * Vec2(-n)));
  };
  const auto end =
      std::remove_if(contact.points.begin(), contact.points.begin() + contact.count, internal);
  contact.count = static_cast<std::int16_t>(end - contact.points.begin());
}

}  // namespace merge2d
