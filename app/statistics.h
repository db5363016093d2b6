#pragma once
/// Means and medians of measured values.

#include <vector>

namespace merge2d {

/// Zero of nothing.
double mean(const std::vector<double>& values);
/// Zero of nothing; between the two in the middle where their number is even.
double median(std::vector<double> values);

}  // namespace merge2d
