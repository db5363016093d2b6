#pragma once
/// The moments that the charts of a comparison point out.

#include <string>
#include <vector>

#include "app/comparison.h"
#include "render/chart.h"

namespace merge2d {

/// The hits of the reference that stand out.
std::vector<Hit> markedHits(const Comparison& comparison);

/// "ball hits brick[0,20]", or "bookcase and wagon meet" where both moved.
std::string labelOf(const Comparison& comparison, const Hit& hit);

/// The scene's own events, and those hits; in the order of time, one at a time.
std::vector<ChartMark> marksOf(const Comparison& comparison);

}  // namespace merge2d
