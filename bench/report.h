#pragma once
/// Comparisons as Markdown tables and as JSON.

#include <string>
#include <vector>

#include "bench/measure.h"

namespace merge2d::bench {

/// Three tables: time, what the bodies did, memory.
std::string markdown(const std::vector<Comparison>& comparisons);

std::string json(const std::vector<Comparison>& comparisons);

}  // namespace merge2d::bench
