#pragma once
/// Contacts between different rigid things, and what is remembered of them over steps.

#include <array>
#include <compare>
#include <cstdint>
#include <limits>
#include <vector>

#include "src2d/core/ids.h"
#include "src2d/core/vec.h"
#include "src2d/dynamics/parked.h"
#include "src2d/dynamics/rigid.h"
#include "src2d/geometry/collide.h"

namespace merge2d {

/// Two numbers as one: which pair comes first is hard to foretell, and asked often.
constexpr std::uint64_t packed(std::uint64_t high, std::uint64_t low) { return high << 32 | low; }

/// Identifies a pair of shapes; contacts are kept in this order.
struct ContactKey {
  BodyId a{}, b{};  ///< a < b
  std::uint32_t shape_a = 0, shape_b = 0;

  bool operator==(const ContactKey&) const = default;
  auto operator<=>(const ContactKey& o) const {
    const auto bodies = packed(index(a), index(b)) <=> packed(index(o.a), index(o.b));
    return bodies != 0 ? bodies : packed(shape_a, shape_b) <=> packed(o.shape_a, o.shape_b);
  }
};

/// A contact point, with its memory while it lasts.
struct ContactPoint {
  Vec2 position = Vec2::Zero();  ///< in a's frame; inside a collection in the collection's [m]
  double gap = 0.0;              ///< [m]
  float breath = 0.0F;           ///< change of the gap since the last step [m]
  std::uint32_t feature = 0;
  bool fresh = false;                     ///< was not there, or carried nothing, in the last step
  float struck = 0.0F;                    ///< impulse of the hits of the last step [N s]
  double lambda_n = 0.0, lambda_t = 0.0;  ///< impulse of the last step [N s]
  float w_n = 0.0F, w_t = 0.0F;           ///< velocity after it [m/s]
};

/// The contact of two convex shapes: persistent over steps, at most two points.
struct Contact {
  ContactKey key;
  Vec2 normal = Vec2::UnitX();  ///< from a to b, in a's frame; inside a collection in its frame
  std::int16_t count = 0;
  /// Consecutive steps in which the pair could have merged (setting merging.steps); below 0 it may
  /// not yet.
  std::int16_t quiet_steps = 0;
  /// Where it waits: the velocity that its bodies gained in the step in which they parted [m/s].
  float parting = 0.0F;
  std::array<float, 2> borne{};  ///< its impulse in the last step, along normal and tangent [N s]
  /// Of a single point, the second's lambda_t holds the impulse against rolling (contact_block.h).
  std::array<ContactPoint, 2> points;
  FaceMemory faces;  ///< no result depends on it

  void loseTouch() { count = quiet_steps = 0; }
};

/// Two shapes near each other that do not touch: all that is kept of most pairs of a heap.
struct IdlePair {
  ContactKey key;
  float apart = 0.0F;  ///< they are at least this far from each other [m]
};

/// A point of a contact in the table: twice its slot, plus which of the two it is.
using PointIndex = std::uint32_t;

/// Contacts between different rigid things: slots that stay in place, and their order by key; and
/// the pairs that may become one.
struct ContactTable {
  using Slot = std::uint32_t;
  std::vector<Contact> slots;
  std::vector<Slot> free_slots;
  std::vector<Slot> order;     ///< ascending by key
  std::vector<IdlePair> idle;  ///< likewise; no key is in both
  /// Those of parked bodies, which are in neither list.
  ParkedPairs<Slot> parked;
  ParkedPairs<IdlePair> parked_idle;

  Contact& operator[](Slot slot) { return slots[slot]; }
  const Contact& operator[](Slot slot) const { return slots[slot]; }

  const Contact& contactOf(PointIndex i) const { return slots[i / 2]; }
  ContactPoint& point(PointIndex i) { return slots[i / 2].points[i % 2]; }
  ContactPoint& secondOf(PointIndex i) { return slots[i / 2].points[1]; }
  const ContactPoint& point(PointIndex i) const { return slots[i / 2].points[i % 2]; }
};

/// A pair of bodies in contact: a run of ContactTable::order.
struct BodyPair {
  BodyId a{}, b{};
  std::uint32_t first = 0, count = 0;
};

/// Two rigid things near each other of which at least one has several shapes: where the smaller one
/// was seen from the larger one when their shapes were last paired.
struct NearPair {
  RigidId a{}, b{};
  std::array<Vec2, 4> corners{};  ///< of the bounds of the one in the frame of the other
  /// That these can have gone since, at most [m]; no result depends on it.
  float way = std::numeric_limits<float>::infinity();
  bool fresh = true;
  auto operator<=>(const NearPair& o) const {
    return packed(index(a), index(b)) <=> packed(index(o.a), index(o.b));
  }
  bool operator==(const NearPair& o) const { return a == o.a && b == o.b; }
};

}  // namespace merge2d
