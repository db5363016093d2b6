#pragma once
/// Notes of the stages about their work. They write them down when somebody asks (Scratch::notes),
/// and do not look at them again.

#include <array>
#include <vector>

#include "src2d/core/decisions.h"
#include "src2d/core/ids.h"
#include "src2d/core/vec.h"

namespace merge2d {

/// A point of contact between two bodies.
struct NotedPoint {
  BodyId a{}, b{};
  Vec2 x = Vec2::Zero();  ///< in the world [m]
};

/// A contact's place in the sweep: the list of visits is in the order of the sweep.
struct NotedVisit {
  BodyId a{}, b{};
  int depth = 0;  ///< contacts from the nearest seed, 1 at the seed; 0: no seed reaches it
};

/// The relative velocity of two bodies at the corners of one of their oriented boxes.
struct NotedCorners {
  BodyId a{}, b{};
  std::array<Vec2, 4> at{};        ///< in the world [m]
  std::array<Vec2, 4> velocity{};  ///< v_rel, Eq. (16) [m/s]
};

/// Everything that was written down in one step.
struct Notes {
  std::vector<Group> groups;          ///< of which the decisions tell
  int judged = 0;                     ///< pairs about which the cycle criterion was asked
  std::vector<Decision> decisions;    ///< of the whole step, in the order they were made
  std::vector<NotedPoint> pruned;     ///< ContactDetection: found, but not needed
  std::vector<BodyId> seeds;          ///< ContactOrdering: where something is new
  std::vector<NotedVisit> order;      ///< SingleIterationPGS
  std::vector<NotedCorners> corners;  ///< AccumulateRelativeMotion: of the pairs tested

  void clear() {
    groups.clear();
    judged = 0;
    decisions.clear();
    pruned.clear();
    seeds.clear();
    order.clear();
    corners.clear();
  }
};

}  // namespace merge2d
