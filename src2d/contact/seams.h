#pragma once
/// A side of a shape that another thing meets, and a shape beside it that may hide it: the test of
/// one pair. The search among all that a thing touches stands in hidden_sides.cpp.

#include <array>
#include <cstdint>

#include "src2d/contact/cast.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// Lengths that tell a flush seam from a step [m]; smaller where a shape is small.
struct SeamScale {
  double ahead = 1.5e-3;  ///< how far before a side we look, and the widest gap of a seam
  double skin = 5e-5;     ///< the highest step that counts as flush
};

inline Contact& contactOf(State& state, const SeamContact& seam) {
  return state.contacts[state.contacts.order[seam.place()]];
}
inline const Contact& contactOf(const State& state, const SeamContact& seam) {
  return state.contacts[state.contacts.order[seam.place()]];
}

/// Whose side it is.
inline std::uint32_t shapeOf(const Contact& contact, const SeamContact& seam) {
  return seam.ofA() ? contact.key.shape_a : contact.key.shape_b;
}

inline BodyId bodyOf(const State& state, const SeamContact& seam) {
  return state.shape_body[shapeOf(contactOf(state, seam), seam)];
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

/// Lists contacts with things that have sides, by the shape that touches: Scratch::seams. Only
/// those of shapes that touch two such things, where one of the contacts bears nothing yet.
void listSeams(const State& state, Scratch& scratch);

/// Whether a contact bears something.
bool bears(const Contact& contact);

/// True for a contact that bears nothing yet, with a side of a body that the toucher could part
/// from what hides it only if it comes against that side now.
bool isLoose(const State& state, const Contact& contact, std::uint32_t shape);

/// True when the two shapes of a contact have not met yet and will bounce: a side behind the first
/// is then met elsewhere.
bool bouncesOff(const State& state, const Contact& contact);

/// True for a side, with this normal, that lies in a ground with the direction `up`: it is none to
/// run into.
bool liesAlong(const Vec2& normal, const Vec2& up);

/// True when the shape of `t` hides the sides at `s`.
bool isHiddenBy(const State& state, const Scratch& scratch, const SeamContact& t,
                const SeamContact& s);

}  // namespace merge2d
