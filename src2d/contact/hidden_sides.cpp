#include "src2d/contact/hidden_sides.h"

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <tuple>

#include "src2d/contact/cast.h"
#include "src2d/contact/internal_edges.h"

namespace merge2d {
namespace {

/// Lengths that tell a flush seam from a step [m]; smaller where a shape is small.
struct SeamScale {
  double ahead = 1.5e-3;  ///< how far before a side we look, and the widest gap of a seam
  double skin = 5e-5;     ///< the highest step that counts as flush
};

SeamScale seamScale(const State& state, std::uint32_t s, std::uint32_t t, std::uint32_t x) {
  double size = 1e300;
  for (const std::uint32_t shape : {s, t, x}) {
    size = std::min(size, state.bounds(shape).extent().minCoeff());
  }
  SeamScale scale;
  scale.ahead = std::min(scale.ahead, size / 20.0);
  scale.skin = std::min(scale.skin, size / 1000.0);
  return scale;
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
void listSeams(const State& state, Scratch& scratch) {
  enum : std::uint8_t { kLoose = 1, kOne = 2, kTwo = 4 };
  std::vector<SeamContact>& seams = scratch.seams;
  std::vector<std::uint8_t>& found = scratch.touchers;
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
};

/// The surface of `t` at which it is touched, in the world.
struct Ground {
  Vec2 at, up;

  Ground(const State& state, const Scratch& scratch, const SeamContact& t) {
    const Side side(state, scratch, t);
    const Pose pose = state.pose(state.shape_body[shapeOf(contactOf(state, t), t)]);
    at = pose * side.points[0];
    up = pose.rotation * side.normal;
  }
  double heightOf(const Vec2& p) const { return up.dot(p - at); }
};

/// True for a side, with this normal, that lies in a ground: it is none to run into.
bool liesAlong(const Vec2& normal, const Vec2& up) {
  constexpr double kAlong = 1e-9;
  return normal.dot(up) > 1.0 - kAlong;
}

/// True when the toucher comes against a side at `p`, with this normal out of it, as it slides
/// along the ground and not as it sinks in.
bool isMetBySliding(const State& state, BodyId toucher, BodyId of_side, const Ground& ground,
                    const Vec2& p, const Vec2& normal) {
  if (liesAlong(normal, ground.up)) return false;
  const double upward = normal.dot(ground.up);
  const double nears = normal.dot(velocitySeenFrom(state, of_side, toucher, p));
  const double sinks = upward * ground.up.dot(velocitySeenFrom(state, of_side, toucher, ground.at));
  return nears - sinks < -std::abs(sinks);
}

/// True when no part of a shape is higher than `step` above the ground.
bool liesBelow(const Collider& shape, const Pose& pose, const Ground& ground, double step) {
  for (int i = 0; i < shape.count(); ++i) {
    if (ground.heightOf(pose * shape.vertex(i)) > step) return false;
  }
  return true;
}

/// True when the shape of `s` does not rise above the ground on which the toucher slides from the
/// shape of `t` on, and is met at its surface.
bool hides(const State& state, const Scratch& scratch, const SeamContact& t, const SeamContact& s,
           const Side& side) {
  const std::uint32_t shape = shapeOf(contactOf(state, s), s);
  const SeamBodies bodies(state, t, s);
  const bool may_part = bodies.mayPart(state);
  const SeamScale scale = seamScale(state, shape, shapeOf(contactOf(state, t), t), s.toucher);
  if (!mayHide(state, t, s, may_part, scale)) return false;
  const Ground ground(state, scratch, t);
  const Pose pose = state.pose(bodies.of_side);
  const Vec2 p = pose * side.points[0];
  if (may_part) {
    const double way = std::clamp(-smallestGap(contactOf(state, t)), scale.skin, scale.ahead);
    const Collider& cover = state.collider(shapeOf(contactOf(state, t), t));
    if (signedDistance(cover, state.pose(bodies.of_cover).toLocal(p)) > scale.ahead) return false;
    if (!bodies.stayTogether(state, p, way)) return false;
  }
  const BodyId toucher = state.shape_body[s.toucher];
  const Vec2 normal = pose.rotation * side.normal;
  if (!isMetBySliding(state, toucher, bodies.of_side, ground, p, normal)) return false;
  return liesBelow(state.collider(shape), pose, ground, may_part ? scale.ahead : scale.skin);
}

/// True when the shape of `t` hides the sides at `s`.
bool isHiddenBy(const State& state, const Scratch& scratch, const SeamContact& t,
                const SeamContact& s) {
  if (t.place() == s.place() || contactOf(state, t).count == 0) return false;
  const bool may_part = SeamBodies(state, t, s).mayPart(state);
  if (!mayHide(state, t, s, may_part, SeamScale{})) return false;
  return hides(state, scratch, t, s, Side(state, scratch, s));
}

BodyId bodyOf(const State& state, const SeamContact& seam) {
  return state.shape_body[shapeOf(contactOf(state, seam), seam)];
}

/// Seams of bodies that cannot part have the same number: that of the body, or one for all bodies
/// that do not respond to forces.
std::uint32_t fixedTo(const State& state, const SeamContact& seam) {
  const BodyId body = bodyOf(state, seam);
  return state.responds(body) ? static_cast<std::uint32_t>(body) : kNone;
}

/// Lists the loose sides among the seams of one toucher.
void listLooseSides(const State& state, Scratch& scratch, std::span<const SeamContact> seams) {
  const Pose toucher = state.pose(state.shape_body[seams.front().toucher]);
  scratch.loose_sides.clear();
  for (std::uint32_t i = 0; i < seams.size(); ++i) {
    const Contact& contact = contactOf(state, seams[i]);
    const std::uint32_t shape = shapeOf(contact, seams[i]);
    if (contact.count == 0 || !isLoose(state, contact, shape)) continue;
    const Vec2 met = state.pose(state.shape_body[shape]) * Side(state, scratch, seams[i]).points[0];
    scratch.loose_sides.push_back({i, fixedTo(state, seams[i]), toucher.toLocal(met)});
  }
}

/// A box, in the frame `toucher`, around all points that are no farther than `ahead` outside each
/// face of the shape of `t`. A face at the distance r_i from an inner point moves out to
/// r_i + ahead ≤ r_i (1 + ahead / r), where r is the least r_i: the points lie in the shape
/// enlarged by this factor about the inner point. Twice the way leaves room for rounding. For a
/// shape too thin to have an inner point the box is infinite, or of no numbers.
Aabb surroundings(const State& state, const SeamContact& t, const Pose& toucher, double ahead) {
  const std::uint32_t shape = shapeOf(contactOf(state, t), t);
  const Collider& cover = state.collider(shape);
  const double r = std::max(0.0, -signedDistance(cover, cover.origin()));
  const double factor = 1.0 + 2.0 * ahead / r;
  const auto enlarged = [&](const Vec2& corner) -> Vec2 {
    return cover.origin() + factor * (corner - cover.origin());
  };
  const Aabb& box = state.bounds(shape);
  return placed(toucher.toLocal(state.pose(state.shape_body[shape])),
                {enlarged(box.lower), enlarged(box.upper)});
}

/// Marks the loose sides that are hidden by a cover of another body, where the two bodies may part.
///
/// There `hides` asks that the toucher rests on the cover and meets the side no farther than
/// `ahead` from it. The sides are sorted along the toucher: those in the surroundings of a cover
/// are a run of the list, and the cover is compared with all of them. Where N boxes stand on one
/// floor a run has a few sides. The order of the pairs does not matter: `hides` reads no other
/// contact, and a contact that bears is never emptied here.
void markBesideCovers(const State& state, Scratch& scratch, std::span<const SeamContact> seams) {
  const std::uint32_t shape = seams.front().toucher;
  const Pose toucher = state.pose(state.shape_body[shape]);
  const Vec2 extent = state.bounds(shape).extent();
  const int along = extent.x() >= extent.y() ? 0 : 1, across = 1 - along;
  const auto place = [&](const LooseSide& side) { return side.met[along]; };
  std::vector<LooseSide>& sides = scratch.loose_sides;
  std::ranges::sort(sides, {}, place);
  for (const SeamContact& t : seams) {
    const Contact& contact = contactOf(state, t);
    if (contact.count == 0 || !bears(contact) || bouncesOff(state, contact)) continue;
    const Aabb near = surroundings(state, t, toucher, SeamScale{}.ahead);
    // These comparisons keep every side where the box is of no numbers.
    auto side = std::ranges::lower_bound(sides, near.lower[along], {}, place);
    for (; side != sides.end() && !(place(*side) > near.upper[along]); ++side) {
      const double beside = side->met[across];
      if (side->hidden || beside < near.lower[across] || beside > near.upper[across]) continue;
      side->hidden = isHiddenBy(state, scratch, t, seams[side->seam]);
    }
  }
}

/// Contacts are in the order of their bodies: the seams of one body are a run.
std::span<const SeamContact> seamsOfBody(const State& state, std::span<const SeamContact> seams,
                                         BodyId body) {
  const auto of = [&](const SeamContact& t) { return bodyOf(state, t); };
  const auto first = std::ranges::lower_bound(seams, body, {}, of);
  const auto isOther = [&](const SeamContact& t) { return of(t) != body; };
  return {first, std::find_if(first, seams.end(), isOther)};
}

/// Lists the covers that are fixed to the sides at `s`, those with the same direction up one behind
/// the other.
void listFixedCovers(const State& state, Scratch& scratch, std::span<const SeamContact> seams,
                     const SeamContact& s) {
  std::vector<FixedCover>& covers = scratch.fixed_covers;
  covers.clear();
  const std::uint32_t fixed = fixedTo(state, s);
  const auto run = fixed == kNone ? seams : seamsOfBody(state, seams, bodyOf(state, s));
  if (run.size() < 2) return;
  for (const SeamContact& t : run) {
    if (contactOf(state, t).count == 0 || fixedTo(state, t) != fixed) continue;
    const auto seam = static_cast<std::uint32_t>(&t - seams.data());
    covers.push_back({Ground(state, scratch, t).up, seam});
  }
  std::ranges::sort(covers, {},
                    [](const FixedCover& t) { return std::tuple(t.up.x(), t.up.y(), t.seam); });
  for (std::size_t i = covers.size(); i-- > 0;) {
    const bool last = i + 1 == covers.size() || covers[i].up != covers[i + 1].up;
    covers[i].end = last ? static_cast<std::uint32_t>(i + 1) : covers[i + 1].end;
  }
}

/// True when one of the listed covers hides the sides at `s`: it may be anywhere along the toucher,
/// but a side that lies along its ground is not hidden (isMetBySliding). Where a plank lies on N
/// tiles, all have one direction.
bool isHiddenByFixed(const State& state, const Scratch& scratch, std::span<const SeamContact> seams,
                     const SeamContact& s) {
  const std::vector<FixedCover>& covers = scratch.fixed_covers;
  if (covers.size() < 2) return false;
  const Vec2 normal = Ground(state, scratch, s).up;
  for (std::size_t i = 0; i < covers.size(); i = covers[i].end) {
    if (liesAlong(normal, covers[i].up)) continue;
    const std::span alike(&covers[i], covers[i].end - i);
    const bool hidden = std::ranges::any_of(
        alike, [&](const FixedCover& t) { return isHiddenBy(state, scratch, seams[t.seam], s); });
    if (hidden) return true;
  }
  return false;
}

/// Empties the contacts with hidden sides of one toucher. A contact that was emptied hides no side
/// that is fixed to it: among these sides the order counts, and it is that of the contacts.
void dropHiddenSidesOf(State& state, Scratch& scratch, std::span<const SeamContact> seams) {
  listLooseSides(state, scratch, seams);
  markBesideCovers(state, scratch, seams);
  std::vector<LooseSide>& sides = scratch.loose_sides;
  std::ranges::sort(sides, {}, [](const LooseSide& side) { return packed(side.fixed, side.seam); });
  for (auto side = sides.begin(); side != sides.end(); ++side) {
    if (side == sides.begin() || side->fixed != std::prev(side)->fixed) {
      listFixedCovers(state, scratch, seams, seams[side->seam]);
    }
    const SeamContact& s = seams[side->seam];
    if (!side->hidden && !isHiddenByFixed(state, scratch, seams, s)) continue;
    Contact& contact = contactOf(state, s);
    contact.count = 0, contact.quiet_steps = 0;
  }
}

}  // namespace

void dropHiddenSides(State& state, Scratch& scratch) {
  const std::vector<SeamContact>& seams = scratch.seams;
  listSeams(state, scratch);
  for (auto first = seams.begin(); first != seams.end();) {
    const auto last = std::find_if(
        first, seams.end(), [&](const SeamContact& s) { return s.toucher != first->toucher; });
    dropHiddenSidesOf(state, scratch, {&*first, static_cast<std::size_t>(last - first)});
    first = last;
  }
}

}  // namespace merge2d
