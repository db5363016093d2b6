#pragma once
/// The stages of a step, and the numbers of one, as plain data.

#include <array>
#include <cstddef>

#include "src2d/core/vec.h"

namespace merge2d {

/// The eleven stages of Algorithm 1, in order.
enum class Stage {
  ContactDetection,
  ContactOrdering,
  SleepAndWake,
  WarmStart,
  SingleIterationPGS,
  Unmerge,
  SolveLCP,
  AdvanceVelocities,
  AccumulateRelativeMotion,
  AdvancePositions,
  Merge,
};
inline constexpr std::size_t kStages = 11;

inline const char* name(Stage stage) {
  static constexpr const char* kNames[kStages] = {
      "ContactDetection",         "ContactOrdering",  "SleepAndWake", "WarmStart",
      "SingleIterationPGS",       "Unmerge",          "SolveLCP",     "AdvanceVelocities",
      "AccumulateRelativeMotion", "AdvancePositions", "Merge"};
  return kNames[static_cast<std::size_t>(stage)];
}

struct Stats {
  int bodies = 0;         ///< alive, dynamic
  int active_bodies = 0;  ///< |B|: free bodies and collections that are simulated, awake
  int collections = 0;
  int asleep = 0;             ///< bodies asleep
  int contacts = 0;           ///< contact points in the full solve, those of opened collections too
  int internal_contacts = 0;  ///< contact points inside awake collections
  double residual = 0.0;      ///< of the full solve after its last sweep: |Δλ| / |λ|
  double max_penetration = 0.0;           ///< [m]
  double kinetic_energy = 0.0;            ///< [J]
  double potential_energy = 0.0;          ///< of gravity about y = 0 and of springs [J]
  Vec2 momentum = Vec2::Zero();           ///< [N s]
  double angular_momentum = 0.0;          ///< about the world's origin [N m s]
  std::array<double, kStages> seconds{};  ///< wall time per stage
};

}  // namespace merge2d
