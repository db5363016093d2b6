#include "src2d/contact/hidden_sides.h"

#include <algorithm>

#include "src2d/contact/cast.h"
#include "src2d/contact/internal_edges.h"

namespace merge2d {
namespace {

/// Lengths that tell a flush seam from a step [m]; smaller where a shape is small.
struct SeamScale {
  double ahead = 1.5e-3;  ///< how far before a side we look, and the widest gap of a seam
  double beside = 3e-3;   ///< how far along the side
  double skin = 5e-5;     ///< the highest step that counts as flush
};

SeamScale seamScale(const State& state, std::uint32_t s, std::uint32_t t, std::uint32_t x) {
  double size = 1e300;
  for (const std::uint32_t shape : {s, t, x}) {
    size = std::min(size, state.bounds(shape).extent().minCoeff());
  }
  SeamScale scale;
  scale.ahead = std::min(scale.ahead, size / 20.0);
  scale.beside = std::min(scale.beside, size / 10.0);
  scale.skin = std::min(scale.skin, size / 1000.0);
  return scale;
}

/// A shape that may hide sides of another one, seen from the body whose sides they are.
struct Cover {
  const Collider& shape;
  Pose frame;  ///< of the body of the other one, in that of this one
  SeamScale scale;

  bool contains(const Vec2& p) const { return signedDistance(shape, frame * p) <= scale.skin; }
};

/// True when a face of the shape at `p` that looks along `normal` has the cover before it, as far
/// beside `p` as the face reaches.
bool isHidden(const Collider& shape, const Vec2& p, const Vec2& normal, const Cover& cover) {
  constexpr double kLooks = 1e-9;
  for (int i = 0; i < shape.count(); ++i) {
    const Vec2 &outward = shape.normal(i), &begin = shape.vertex(i);
    const Vec2 along = perpendicular(outward);
    const double length = along.dot(shape.vertex(shape.next(i)) - begin);
    const double at = along.dot(p - begin), skin = cover.scale.skin;
    const bool on_face =
        std::abs(outward.dot(p - begin)) <= skin && at >= -skin && at <= length + skin;
    if (!on_face || outward.dot(normal) <= kLooks) continue;
    const auto covered = [&](double place) {
      const Vec2 on = begin + std::clamp(place, 0.0, length) * along;
      return cover.contains(on + cover.scale.ahead * outward);
    };
    if (covered(at - cover.scale.beside) && covered(at + cover.scale.beside)) return true;
  }
  return false;
}

bool bears(const Contact& contact) {
  return contact.points[0].lambda_n > 0.0 ||
         (contact.count == 2 && contact.points[1].lambda_n > 0.0);
}

bool mayBeHidden(const State& state, BodyId body, std::uint32_t shape) {
  return !state.collider(shape).isCircle() && (!state.responds(body) || hasSiblings(state, shape));
}

/// Contacts that touch something with hidden sides, by the shape that touches.
void listSeams(const State& state, std::vector<SeamContact>& seams) {
  seams.clear();
  const auto& order = state.contacts.order;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    const Contact& contact = state.contacts[order[i]];
    if (contact.count == 0) continue;
    const ContactKey& key = contact.key;
    if (mayBeHidden(state, key.a, key.shape_a)) seams.push_back({key.shape_b, 2 * i + 1});
    if (mayBeHidden(state, key.b, key.shape_b)) seams.push_back({key.shape_a, 2 * i});
  }
  std::ranges::sort(seams, {}, [](const SeamContact& s) { return packed(s.toucher, s.side); });
}

Contact& contactOf(State& state, const SeamContact& seam) {
  return state.contacts[state.contacts.order[seam.place()]];
}
const Contact& contactOf(const State& state, const SeamContact& seam) {
  return state.contacts[state.contacts.order[seam.place()]];
}

/// Whose side it is.
std::uint32_t shapeOf(const Contact& contact, const SeamContact& seam) {
  return seam.ofA() ? contact.key.shape_a : contact.key.shape_b;
}

/// True when all points of the contact of `s` lie on sides that the shape of `t` hides.
bool hides(const State& state, const Scratch& scratch, const SeamContact& t, const SeamContact& s) {
  const Contact &other = contactOf(state, t), &contact = contactOf(state, s);
  const std::uint32_t cover_shape = shapeOf(other, t), shape = shapeOf(contact, s);
  const BodyId body = state.shape_body[shape], cover_body = state.shape_body[cover_shape];
  if (body != cover_body && (state.responds(body) || state.responds(cover_body))) return false;
  const SeamScale scale = seamScale(state, shape, cover_shape, s.toucher);
  if (smallestGap(other) > smallestGap(contact) + scale.ahead) return false;
  const Pose to_cover =
      body == cover_body ? Pose{} : state.pose(cover_body).toLocal(state.pose(body));
  const Cover cover{state.collider(cover_shape), to_cover, scale};
  const Pose b_in_a = state.pose(contact.key.a).toLocal(state.pose(contact.key.b));
  const Vec2 normal =
      s.ofA() ? contact.normal : Vec2(b_in_a.rotation.inverse() * Vec2(-contact.normal));
  for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
    const SurfacePoints on = surfacePoints(scratch, contact, contact.points[k], b_in_a);
    if (!isHidden(state.collider(shape), s.ofA() ? on.on_a : on.on_b, normal, cover)) return false;
  }
  return true;
}

}  // namespace

void dropHiddenSides(State& state, Scratch& scratch) {
  std::vector<SeamContact>& seams = scratch.seams;
  listSeams(state, seams);
  for (auto first = seams.begin(); first != seams.end();) {
    const auto last = std::find_if(
        first, seams.end(), [&](const SeamContact& s) { return s.toucher != first->toucher; });
    for (auto s = first; s != last; ++s) {
      Contact& contact = contactOf(state, *s);
      if (contact.count == 0 || bears(contact)) continue;
      const bool hidden = std::any_of(first, last, [&](const SeamContact& t) {
        return t.place() != s->place() && contactOf(state, t).count > 0 &&
               hides(state, scratch, t, *s);
      });
      if (hidden) contact.count = 0, contact.quiet_steps = 0;
    }
    first = last;
  }
}

}  // namespace merge2d
