#pragma once
/// Bodies that hit each other, and which of the hits stand out.

#include <vector>

#include "src2d/trace/snapshot.h"

namespace merge2d {

/// Two bodies that meet: an event of type Impact.
struct Hit {
  double time = 0.0;           ///< [s]
  BodyId striker{}, struck{};  ///< the first was the faster of the two, in the world
  bool both_moved = false;     ///< the other had more than a tenth of its speed: which hit which?
  double energy = 0.0;         ///< of the approach, along the normal of the contact [J]
};

/// Appends the hits of a step; `before` and `now` are what was seen before and after it.
void appendHits(const Snapshot& before, const Snapshot& now, const std::vector<BodyInfo>& bodies,
                std::vector<Hit>& hits);

/// The hits that a reader should know of, in the order of time. Of hits that are closer in time
/// than `apart` [s] only the strongest counts. Taken are as many as have kOverNext times the energy
/// of the one that comes after them, and kOverMedian times that of the median hit where there are
/// more than kMostHits; at most kMostHits.
std::vector<Hit> outstandingHits(std::vector<Hit> hits, double apart);

inline constexpr double kOverNext = 2.0;
inline constexpr double kOverMedian = 20.0;
inline constexpr std::size_t kMostHits = 3;

}  // namespace merge2d
