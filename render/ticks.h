#pragma once
/// Where an axis has its numbers.

#include <vector>

namespace merge2d {

/// Round numbers with equal steps (1, 2 or 5 times a power of ten) that lie in [low, high], about
/// `wanted` of them.
std::vector<double> ticks(double low, double high, int wanted);

}  // namespace merge2d
