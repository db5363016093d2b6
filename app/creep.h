#pragma once
/// How far bodies creep on what they rest on: an error of its own, which the distance from the
/// reference does not tell, since the reference creeps too.

#include <vector>

#include "src2d/trace/snapshot.h"

namespace merge2d {

/// Of the pairs that touch both when the measurement begins and when it ends.
struct Creep {
  int pairs = 0;
  double mean = 0.0;          ///< at the end [m]
  double largest = 0.0;       ///< at the end [m]
  double largest_ever = 0.0;  ///< at any time [m]
};

/// Measures where the lighter body of each pair is in the frame of the heavier one.
class CreepMeter {
 public:
  /// Takes note of the pairs that touch, and of where they are.
  void begin(const Snapshot& now, const std::vector<BodyInfo>& bodies);
  void update(const Snapshot& now);
  Creep result(const Snapshot& now) const;

 private:
  struct Pair {
    BodyId a{}, b{};                                 ///< as in contacts
    BodyId frame{}, body{};                          ///< the heavier one, and the other
    Vec2 start = Vec2::Zero(), last = Vec2::Zero();  ///< of `body` in `frame` [m]
    double farthest = 0.0;                           ///< from the start [m]
  };
  std::vector<Pair> pairs_;  ///< ascending
};

}  // namespace merge2d
