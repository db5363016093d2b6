#pragma once
/// The axes of a chart: from values to places in its area, and the numbers beside them.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "render/chart.h"
#include "render/painter.h"

namespace merge2d {

struct ChartRange {
  double low = 1e300, high = -1e300;

  void include(double value);
  /// Never empty, never of no extent.
  ChartRange orElse(double from, double to) const;
};

class ChartAxes {
 public:
  explicit ChartAxes(const Chart& chart);

  const ChartRange& x() const { return x_; }
  const ChartRange& y() const { return y_; }

  /// The value that is drawn: nothing is below the axis' foot.
  double shown(double y) const;
  bool usable(double y) const;
  /// The sum of the first `n` series at their k-th place.
  double stackedUpTo(std::size_t n, std::size_t k) const;
  /// Where the k-th area begins: each value reaches half-way to its neighbours, and the outermost
  /// as far to the other side.
  double edge(std::size_t k) const;

  /// "1 mm", "≤ 0.1 µm" at a foot where smaller values are drawn too.
  std::string yText(double y) const;
  std::vector<double> yTicks() const;
  std::vector<std::pair<double, std::string>> xTicks() const;

  /// A point's place in `area`, with `inset` pixels left and right of the first and last value.
  Pixel at(double x, double y, const PixelBox& area, float inset) const;

 private:
  void findRanges();

  const Chart& chart_;
  ChartRange x_, y_;
};

}  // namespace merge2d
