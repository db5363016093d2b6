#include "src2d/contact/seams.h"

#include <algorithm>
#include <functional>

#include "src2d/contact/cast.h"
#include "src2d/contact/internal_edges.h"

namespace merge2d {

bool bears(const Contact& contact) {
  return contact.points[0].lambda_n > 0.0 ||
         (contact.count == 2 && contact.points[1].lambda_n > 0.0);
}

bool bouncesOff(const State& state, const Contact& contact) {
  return smallestGap(contact) > touchingGap(state, contact.key) &&
         restitutionOf(state, contact.key.a, contact.key.b) > 0.0;
}

bool liesAlong(const Vec2& normal, const Vec2& up) {
  constexpr double kAlong = 1e-9;
  return normal.dot(up) > 1.0 - kAlong;
}

namespace {

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

}  // namespace

bool isLoose(const State& state, const Contact& contact, std::uint32_t shape) {
  return !bears(contact) && (!state.responds(state.shape_body[shape]) ||
                             hasSiblings(state, shape) || closes(state, contact));
}

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

namespace {

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
      : of_side(bodyOf(state, s)), of_cover(bodyOf(state, t)) {}

  bool mayPart(const State& state) const {
    return of_side != of_cover && (state.responds(of_side) || state.responds(of_cover));
  }
  /// True when they move against each other at `p` by no more than `way` in this step.
  bool stayTogether(const State& state, const Vec2& p, double way) const {
    return state.h * velocitySeenFrom(state, of_cover, of_side, p).norm() <= way;
  }
};

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

}  // namespace

bool isHiddenBy(const State& state, const Scratch& scratch, const SeamContact& t,
                const SeamContact& s) {
  if (t.place() == s.place() || contactOf(state, t).count == 0) return false;
  const bool may_part = SeamBodies(state, t, s).mayPart(state);
  if (!mayHide(state, t, s, may_part, SeamScale{})) return false;
  return hides(state, scratch, t, s, Side(state, scratch, s));
}

}  // namespace merge2d
