#pragma once
/// All that a snapshot holds but the seconds, bit by bit: equal fingerprints are equal snapshots.

#include <bit>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "src2d/trace/snapshot.h"

namespace merge2d {

class Fingerprint {
 public:
  explicit Fingerprint(const Snapshot& s) {
    add(s.step, s.time);
    list(s.bodies, [&](const BodyState& b) {
      add(b.id, b.x, b.angle, b.v, b.omega, b.collection, b.asleep, b.pinned, b.magnet_on);
    });
    list(s.contacts, [&](const ContactView& c) {
      add(c.a, c.b, c.feature, c.x, c.normal, c.gap, c.lambda_n, c.lambda_t, c.w_n, c.w_t, c.mu,
          c.state, c.internal, c.fresh);
    });
    list(s.collections, [&](const CollectionView& c) {
      add(c.id, c.anchored, c.anchor, c.mass, c.inertia, c.x, c.v, c.omega, c.asleep);
      list(c.bodies, [&](BodyId b) { add(b); });
    });
    list(s.welds, [&](const WeldView& w) { add(w.a, w.b, w.contacts); });
    list(s.springs, [&](const SpringView& p) { add(p.from, p.to, p.force); });
    list(s.joints, [&](const JointView& j) {
      add(j.from, j.to, j.axis, j.force, j.torque, j.broken, j.internal);
    });
    list(s.events, [&](const Event& e) { add(e.type, e.a, e.b, e.collection, e.reason); });
    const Stats& t = s.stats;
    add(t.bodies, t.active_bodies, t.collections, t.asleep, t.contacts, t.internal_contacts,
        t.residual, t.max_penetration, t.kinetic_energy, t.potential_energy, t.momentum,
        t.angular_momentum);
  }

  bool operator==(const Fingerprint&) const = default;

 private:
  template <class T>
  void one(const T& value) {
    if constexpr (std::is_same_v<T, Vec2>) {
      one(value.x());
      one(value.y());
    } else if constexpr (std::is_floating_point_v<T>) {
      words_.push_back(std::bit_cast<std::uint64_t>(value));
    } else {
      words_.push_back(static_cast<std::uint64_t>(value));
    }
  }
  template <class... T>
  void add(const T&... values) {
    (one(values), ...);
  }
  template <class T, class Each>
  void list(const std::vector<T>& all, Each&& each) {
    add(all.size());
    for (const T& item : all) each(item);
  }

  std::vector<std::uint64_t> words_;
};

}  // namespace merge2d
