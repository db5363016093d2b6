#include "src2d/cycles/growth.h"

#include <algorithm>
#include <numeric>

#include "src2d/cycles/tolerance.h"

namespace merge2d {
namespace {

/// The pins of each node.
class PinsOfNodes {
 public:
  PinsOfNodes(std::uint32_t nodes, std::span<const Pin> pins)
      : first_(nodes + 1, 0), pins_(2 * pins.size()) {
    for (const Pin& pin : pins) {
      ++first_[pin.a];
      ++first_[pin.b];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());  // ends: filled backwards
    for (std::uint32_t i = 0; i < pins.size(); ++i) {
      pins_[--first_[pins[i].a]] = i;
      pins_[--first_[pins[i].b]] = i;
    }
  }

  std::span<const std::uint32_t> operator[](std::uint32_t node) const {
    return {pins_.data() + first_[node], pins_.data() + first_[node + 1]};
  }

 private:
  std::vector<std::uint32_t> first_, pins_;
};

/// A group that grows.
class Growth {
 public:
  Growth(std::uint32_t nodes, std::span<const Pin> pins, const PinRule& rule)
      : pins_(pins), rule_(rule), of_(nodes, pins), inside_(nodes, 0), link_(nodes, kNone) {}

  std::vector<std::uint8_t> from(std::uint32_t seed) {
    take(seed);
    while (!fresh_.empty()) {
      const std::uint32_t node = fresh_.back();
      fresh_.pop_back();
      for (const std::uint32_t pin : of_[node]) {
        const std::uint32_t other = across(pin, node);
        if (inside_[other] == 0) attach(other, pin);
      }
    }
    return std::move(inside_);
  }

  std::uint32_t busiest() const {
    std::uint32_t most = 0;
    for (std::uint32_t i = 1; i < inside_.size(); ++i) {
      if (of_[i].size() > of_[most].size()) most = i;
    }
    return most;
  }

 private:
  std::uint32_t across(std::uint32_t pin, std::uint32_t node) const {
    return pins_[pin].a == node ? pins_[pin].b : pins_[pin].a;
  }

  void take(std::uint32_t node) {
    inside_[node] = 1;
    fresh_.push_back(node);
  }

  /// A node outside has one pin more on the group.
  void attach(std::uint32_t node, std::uint32_t pin) {
    std::uint32_t& link = link_[node];
    if (link == kNone) {
      link = pin;
      closeCycle(node);
    } else if (rule_.distinct(pins_[link], pins_[pin])) {
      take(node);
    }
  }

  /// Two nodes outside that are linked to the group, and to each other.
  void closeCycle(std::uint32_t node) {
    for (const std::uint32_t pin : of_[node]) {
      const std::uint32_t other = across(pin, node);
      if (inside_[other] != 0 || link_[other] == kNone) continue;
      if (!rule_.closes(pins_[link_[node]], pins_[link_[other]], pins_[pin])) continue;
      take(node);
      take(other);
      return;
    }
  }

  std::span<const Pin> pins_;
  PinRule rule_;
  PinsOfNodes of_;
  std::vector<std::uint8_t> inside_;
  std::vector<std::uint32_t> link_;  ///< per node outside: its first pin on the group
  std::vector<std::uint32_t> fresh_;
};

}  // namespace

bool PinRule::closes(const Pin& p, const Pin& q, const Pin& r) const {
  if (resolution < 0.0) return true;
  const Vec2 x = q.at - p.at, y = r.at - p.at;
  const double longest = std::max({x.norm(), y.norm(), (x - y).norm()});
  return longest > resolution && std::abs(cross(x, y)) > kRankTolerance * longest * longest;
}

std::vector<std::uint8_t> grownGroup(std::uint32_t nodes, std::span<const Pin> pins,
                                     const PinRule& rule) {
  if (pins.empty()) return std::vector<std::uint8_t>(nodes, 0);
  Growth growth(nodes, pins, rule);
  return growth.from(growth.busiest());
}

}  // namespace merge2d
