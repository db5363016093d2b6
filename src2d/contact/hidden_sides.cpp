#include "src2d/contact/hidden_sides.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>

#include "src2d/contact/cast.h"
#include "src2d/contact/internal_edges.h"

namespace merge2d {
namespace {

/// Lengths that tell a flush seam from a step [m]; smaller where a shape is small.
struct SeamScale {
  double ahead = 1.5e-3;  ///< how far before a side we look, and the widest gap of a seam
  double beside = 3e-3;   ///< how far along the side
  double skin = 5e-5;     ///< the highest step that counts as flush
  double sag = 5e-5;      ///< the same where one of the two may have sunk in
};

SeamScale seamScale(const State& state, std::uint32_t s, std::uint32_t t, std::uint32_t x) {
  double size = 1e300;
  for (const std::uint32_t shape : {s, t, x}) {
    size = std::min(size, state.bounds(shape).extent().minCoeff());
  }
  SeamScale scale;
  scale.ahead = std::min(scale.ahead, size / 20.0);
  scale.beside = std::min(scale.beside, size / 10.0);
  scale.sag = scale.skin = std::min(scale.skin, size / 1000.0);
  return scale;
}

/// A shape that may hide sides of another one, seen from the body whose sides they are.
struct Cover {
  const Collider& shape;
  Pose frame;  ///< of the body of the other one, in that of this one
  SeamScale scale;

  bool contains(const Vec2& p) const { return distance(p) <= scale.skin; }
  /// The same, also where the two have sunk in differently.
  bool covers(const Vec2& p) const { return distance(p) <= scale.sag; }
  bool risesAbove(const Vec2& p, const Vec2& n) const {
    const Vec2 at = frame * p, up = frame.rotation * n;
    for (int i = 0; i < shape.count(); ++i) {
      if (up.dot(shape.vertex(i) - at) > scale.skin) return true;
    }
    return false;
  }

 private:
  double distance(const Vec2& p) const { return signedDistance(shape, frame * p); }
};

/// True when a shape with these bounds may hide sides at `p`, which is in the bounds' frame.
bool mayReach(const Aabb& bounds, const Vec2& p) {
  constexpr SeamScale kWidest;
  constexpr double kReach = kWidest.ahead + kWidest.beside + 2.0 * kWidest.skin;
  return ((p - bounds.lower).array() >= -kReach).all() &&
         ((bounds.upper - p).array() >= -kReach).all();
}

/// True when a face of the shape at `p` that looks along `normal` has the cover before it, as far
/// beside `p` as the face reaches.
bool isHidden(const Collider& shape, const Vec2& p, const Vec2& normal, const Cover& cover) {
  constexpr double kLooks = 1e-9;
  const double skin = cover.scale.skin;
  for (int i = 0; i < shape.count(); ++i) {
    const Vec2 &outward = shape.normal(i), &begin = shape.vertex(i);
    if (outward.dot(normal) <= kLooks || std::abs(outward.dot(p - begin)) > skin) continue;
    const Vec2 along = perpendicular(outward);
    const double length = along.dot(shape.vertex(shape.next(i)) - begin);
    const double at = along.dot(p - begin);
    if (at < -skin || at > length + skin) continue;
    const auto covered = [&](double place) {
      const Vec2 on = begin + std::clamp(place, 0.0, length) * along;
      return cover.covers(on + cover.scale.ahead * outward) ||
             (cover.covers(on) && cover.risesAbove(on, outward));
    };
    if (covered(at - cover.scale.beside) && covered(at + cover.scale.beside)) return true;
  }
  return false;
}

/// True when `p` is a corner of the shape, `normal` leads between those of its sides there, and the
/// cover, to which the corner belongs too, rises above it: both together have no such corner. So it
/// is where two shapes meet along a slanted side.
bool isCornerUnder(const Collider& shape, const Vec2& p, const Vec2& normal, const Cover& cover) {
  constexpr double kAlong = 1e-9;  // a normal of a side is none of a corner
  const double skin = cover.scale.skin;
  bool corner = false;
  for (int i = 0; i < shape.count(); ++i) {
    corner |= (shape.vertex(i) - p).squaredNorm() <= skin * skin;
    if (shape.normal(i).dot(normal) > 1.0 - kAlong) return false;
  }
  return corner && cover.contains(p) && cover.risesAbove(p, normal);
}

bool bears(const Contact& contact) {
  return contact.points[0].lambda_n > 0.0 ||
         (contact.count == 2 && contact.points[1].lambda_n > 0.0);
}

bool hasSides(const State& state, std::uint32_t shape) { return !state.collider(shape).isCircle(); }

/// True when the two bodies touch each other in this step, as far as their motion at its start
/// tells.
bool closes(const State& state, const Contact& contact) {
  const Rigid &a = state.rigid(contact.key.a), &b = state.rigid(contact.key.b);
  const Pose frame = state.pose(contact.key.a);
  const Vec2 n = frame.rotation * contact.normal;
  for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
    const Vec2 p = frame * contact.points[k].position;
    const double w = n.dot(b.velocityAt(p) - a.velocityAt(p));
    if (contact.points[k].gap + state.h * w < 0.0) return true;
  }
  return false;
}

/// True for a contact that bears nothing yet, with a side of a body that the toucher could part
/// from what hides it only if it comes against that side now.
bool isLoose(const State& state, const Contact& contact, std::uint32_t shape) {
  return !bears(contact) && (!state.responds(state.shape_body[shape]) ||
                             hasSiblings(state, shape) || closes(state, contact));
}

/// Contacts that touch something with hidden sides, by the shape that touches; only those of shapes
/// that touch two such things, where one of the contacts bears nothing yet.
void listSeams(const State& state, std::vector<SeamContact>& seams) {
  enum : std::uint8_t { kLoose = 1, kOne = 2, kTwo = 4 };
  thread_local std::vector<std::uint8_t> found;  // per shape; between two calls all 0
  found.resize(std::max(found.size(), state.shape_body.size()), 0);
  seams.clear();
  const auto& order = state.contacts.order;
  const auto forEachSide = [&](const auto& isAsked, const auto& visit) {
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      const Contact& contact = state.contacts[order[i]];
      if (contact.count == 0 || !isAsked(contact)) continue;
      const auto side = [&](std::uint32_t toucher, std::uint32_t shape, bool of_a) {
        if (hasSides(state, shape)) visit(contact, shape, SeamContact{toucher, 2 * i + of_a});
      };
      side(contact.key.shape_b, contact.key.shape_a, true);
      side(contact.key.shape_a, contact.key.shape_b, false);
    }
  };
  bool any = false;
  forEachSide([](const Contact& contact) { return !bears(contact); },
              [&](const Contact& contact, std::uint32_t shape, const SeamContact& side) {
                if (!isLoose(state, contact, shape)) return;
                found[side.toucher] = kLoose;
                any = true;
              });
  if (!any) return;
  forEachSide([](const Contact&) { return true; },
              [&](const Contact&, std::uint32_t, const SeamContact& side) {
                std::uint8_t& of = found[side.toucher];
                if (of == 0) return;
                of |= (of & kOne) != 0 ? kTwo : kOne;
                seams.push_back(side);
              });
  const auto alone = [&](const SeamContact& seam) { return (found[seam.toucher] & kTwo) == 0; };
  const auto end = std::partition(seams.begin(), seams.end(), std::not_fn(alone));
  for (const SeamContact& seam : seams) found[seam.toucher] = 0;
  seams.erase(end, seams.end());
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

/// The points of a contact on the surface of a shape, and the normal out of it, in the frame of the
/// shape's body.
struct Side {
  std::array<Vec2, 2> points;
  int count = 0;
  Vec2 normal;

  Side(const State& state, const Scratch& scratch, const SeamContact& seam)
      : Side(state, scratch, contactOf(state, seam), seam.ofA()) {}

 private:
  Side(const State& state, const Scratch& scratch, const Contact& contact, bool of_a)
      : count(contact.count), normal(contact.normal) {
    if (of_a) {
      fill([&](const ContactPoint& point) { return surfaceOfA(scratch, contact, point); }, contact);
      return;
    }
    const Pose b_in_a = state.pose(contact.key.a).toLocal(state.pose(contact.key.b));
    normal = b_in_a.rotation.inverse() * Vec2(-contact.normal);
    fill([&](const ContactPoint& point) { return surfaceOfB(scratch, contact, point, b_in_a); },
         contact);
  }

  template <class Surface>
  void fill(Surface&& surface, const Contact& contact) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      points[k] = surface(contact.points[k]);
    }
  }
};

/// True when the two shapes of a contact have not met yet and will bounce: a side behind the first
/// is then met elsewhere.
bool bouncesOff(const State& state, const Contact& contact) {
  return smallestGap(contact) > touchingGap(state, contact.key) &&
         restitutionOf(state, contact.key.a, contact.key.b) > 0.0;
}

/// True when the shape of `t` may hide sides of the shape of `s`: it is about as near; and where a
/// blow of the toucher could part the two, it rests on `t` already.
bool mayHide(const State& state, const SeamContact& t, const SeamContact& s, bool may_part,
             const SeamScale& scale) {
  const Contact& other = contactOf(state, t);
  if (smallestGap(other) > smallestGap(contactOf(state, s)) + scale.ahead) return false;
  return !bouncesOff(state, other) && (!may_part || bears(other));
}

/// The velocity at `p` of a body as seen from another one.
Vec2 velocitySeenFrom(const State& state, BodyId other, BodyId body, const Vec2& p) {
  return state.rigid(body).velocityAt(p) - state.rigid(other).velocityAt(p);
}

/// The bodies of a side and of a shape that may hide it.
struct SeamBodies {
  BodyId of_side, of_cover;

  SeamBodies(const State& state, const SeamContact& t, const SeamContact& s)
      : of_side(state.shape_body[shapeOf(contactOf(state, s), s)]),
        of_cover(state.shape_body[shapeOf(contactOf(state, t), t)]) {}

  bool mayPart(const State& state) const {
    return of_side != of_cover && (state.responds(of_side) || state.responds(of_cover));
  }
  /// True when they move against each other at `p` by no more than `way` in this step.
  bool stayTogether(const State& state, const Vec2& p, double way) const {
    return state.h * velocitySeenFrom(state, of_cover, of_side, p).norm() <= way;
  }
  Pose sideInCover(const State& state) const {
    if (of_side == of_cover) return {};
    return state.pose(of_cover).toLocal(state.pose(of_side));
  }
};

/// The surface of `t`, on which the toucher rests, in the world.
struct Ground {
  Vec2 at, up;

  Ground(const State& state, const SeamContact& t) {
    const Contact& contact = contactOf(state, t);
    const Pose frame = state.pose(contact.key.a);
    at = frame * contact.points[0].position;
    up = frame.rotation * (t.ofA() ? contact.normal : Vec2(-contact.normal));
  }
};

/// True when a shape rises at `p` by more than `scale.ahead` above the ground: it stands there.
bool rises(const Collider& shape, const Pose& pose, const Ground& ground, const Vec2& p,
           const SeamScale& scale) {
  const Vec2 over = p + (scale.ahead - ground.up.dot(p - ground.at)) * ground.up;
  const Vec2 along = scale.beside * perpendicular(ground.up);
  return signedDistance(shape, pose.toLocal(over + along)) < 0.0 ||
         signedDistance(shape, pose.toLocal(over - along)) < 0.0;
}

/// True when the toucher comes against a side at `p`, with this normal out of it, as it slides
/// along the ground and not as it sinks in.
bool isMetBySliding(const State& state, BodyId toucher, const SeamBodies& bodies,
                    const Ground& ground, const Vec2& p, const Vec2& normal) {
  const double nears = normal.dot(velocitySeenFrom(state, bodies.of_side, toucher, p));
  const double sinks = normal.dot(ground.up) *
                       ground.up.dot(velocitySeenFrom(state, bodies.of_cover, toucher, ground.at));
  return nears - sinks < -std::abs(sinks);
}

/// True when a side of a shape whose body may part from that of `t` lies flush before the toucher,
/// which slides towards it, and goes on with `t` in this step.
bool isFlush(const State& state, const SeamContact& t, const SeamContact& s, const Side& side,
             const SeamBodies& bodies, const SeamScale& scale) {
  const Ground ground(state, t);
  const Pose pose = state.pose(bodies.of_side);
  const Vec2 p = pose * side.points[0], normal = pose.rotation * side.normal;
  return bodies.stayTogether(state, p, scale.sag) &&
         isMetBySliding(state, state.shape_body[s.toucher], bodies, ground, p, normal) &&
         !rises(state.collider(shapeOf(contactOf(state, s), s)), pose, ground, p, scale);
}

/// True when all points of the contact of `s`, which are those of `side`, lie on sides that the
/// shape of `t` hides.
bool hides(const State& state, const SeamContact& t, const SeamContact& s, const Side& side) {
  const std::uint32_t cover_shape = shapeOf(contactOf(state, t), t);
  const std::uint32_t shape = shapeOf(contactOf(state, s), s);
  const SeamBodies bodies(state, t, s);
  const Pose to_cover = bodies.sideInCover(state);
  if (!mayReach(state.bounds(cover_shape), to_cover * side.points[0])) return false;
  const bool may_part = bodies.mayPart(state);
  SeamScale scale = seamScale(state, shape, cover_shape, s.toucher);
  if (!mayHide(state, t, s, may_part, scale)) return false;
  if (may_part) {
    scale.sag = std::clamp(-smallestGap(contactOf(state, t)), scale.skin, scale.ahead);
    if (!isFlush(state, t, s, side, bodies, scale)) return false;
  }
  const Cover cover{state.collider(cover_shape), to_cover, scale};
  for (std::size_t k = 0; k < static_cast<std::size_t>(side.count); ++k) {
    const Vec2& p = side.points[k];
    if (!isHidden(state.collider(shape), p, side.normal, cover) &&
        !isCornerUnder(state.collider(shape), p, side.normal, cover)) {
      return false;
    }
  }
  return true;
}

/// True when one of the shapes that the toucher of `s` touches hides the sides at `s`.
bool isHiddenByAny(const State& state, const Scratch& scratch, std::span<const SeamContact> all,
                   const SeamContact& s) {
  std::optional<Side> side;
  return std::ranges::any_of(all, [&](const SeamContact& t) {
    if (t.place() == s.place() || contactOf(state, t).count == 0) return false;
    const bool may_part = SeamBodies(state, t, s).mayPart(state);
    if (!mayHide(state, t, s, may_part, SeamScale{})) return false;
    if (!side) side.emplace(state, scratch, s);
    return hides(state, t, s, *side);
  });
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
      if (contact.count == 0 || !isLoose(state, contact, shapeOf(contact, *s))) continue;
      const std::span all(&*first, static_cast<std::size_t>(last - first));
      const bool hidden = isHiddenByAny(state, scratch, all, *s);
      if (hidden) contact.count = 0, contact.quiet_steps = 0;
    }
    first = last;
  }
}

}  // namespace merge2d
