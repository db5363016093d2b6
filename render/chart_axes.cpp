#include "render/chart_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/ticks.h"
#include "src2d/core/assert.h"

namespace merge2d {

void ChartRange::include(double value) {
  low = std::min(low, value);
  high = std::max(high, value);
}

ChartRange ChartRange::orElse(double from, double to) const {
  if (low > high) return {from, to};
  if (low == high) return {low, low + (low == 0.0 ? 1.0 : std::abs(low))};
  return *this;
}

ChartAxes::ChartAxes(const Chart& chart) : chart_(chart) { findRanges(); }

double ChartAxes::shown(double y) const {
  return chart_.log_y ? std::max(y, chart_.y_floor.value_or(y)) : y;
}

bool ChartAxes::usable(double y) const {
  return std::isfinite(y) && (!chart_.log_y || shown(y) > 0.0);
}

void ChartAxes::findRanges() {
  for (const Series& series : chart_.series) {
    MERGE2D_ASSERT(series.x.size() == series.y.size(), "{}: {} and {} values", series.name,
                   series.x.size(), series.y.size());
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!usable(series.y[i])) continue;
      x_.include(series.x[i]);
      y_.include(chart_.stacked ? stackedUpTo(chart_.series.size(), i) : shown(series.y[i]));
    }
  }
  if (chart_.stacked && x_.low < x_.high) {
    const std::size_t areas = chart_.series.front().x.size();
    x_ = {edge(0), edge(areas)};
  }
  if (chart_.x_low) x_.low = *chart_.x_low;
  if (chart_.x_high) x_.high = *chart_.x_high;
  x_ = x_.orElse(0.0, 1.0);
  if (chart_.log_y) {
    y_ = y_.orElse(1.0, 10.0);
    y_ = {std::pow(10.0, std::floor(std::log10(y_.low))),
          std::pow(10.0, std::ceil(std::log10(y_.high)))};
  } else {
    y_.include(0.0);  // lengths from zero can be compared by eye
    y_ = y_.orElse(0.0, 1.0);
    y_.high += 0.04 * (y_.high - y_.low);
    if (chart_.y_high) y_.high = *chart_.y_high;
  }
}

double ChartAxes::stackedUpTo(std::size_t n, std::size_t k) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += chart_.series[i].y[k];
  return sum;
}

double ChartAxes::edge(std::size_t k) const {
  const std::vector<double>& x = chart_.series.front().x;
  if (x.size() == 1) return k == 0 ? x_.low : x_.high;
  if (k == 0) return x[0] - 0.5 * (x[1] - x[0]);
  if (k == x.size()) return x[k - 1] + 0.5 * (x[k - 1] - x[k - 2]);
  return 0.5 * (x[k - 1] + x[k]);
}

std::string ChartAxes::yText(double y) const {
  constexpr double kRounding = 1e-9;
  const std::string text = chart_.y_text ? chart_.y_text(y) : fmt::format("{:g}", y);
  const bool foot = chart_.log_y && chart_.y_floor && y <= *chart_.y_floor * (1.0 + kRounding);
  return foot ? "≤ " + text : text;
}

std::vector<double> ChartAxes::yTicks() const {
  if (!chart_.log_y) {
    std::vector<double> round = ticks(y_.low, y_.high, 5);
    if (chart_.whole) std::erase_if(round, [](double y) { return y != std::floor(y); });
    return round;
  }
  std::vector<double> decades;
  for (double y = y_.low; y <= 1.001 * y_.high; y *= 10.0) decades.push_back(y);
  return decades;
}

std::vector<std::pair<double, std::string>> ChartAxes::xTicks() const {
  if (!chart_.x_ticks.empty()) return chart_.x_ticks;
  std::vector<std::pair<double, std::string>> round;
  for (const double x : ticks(x_.low, x_.high, 6)) round.emplace_back(x, fmt::format("{:g}", x));
  return round;
}

Pixel ChartAxes::at(double x, double y, const PixelBox& area, float inset) const {
  const double u = (x - x_.low) / (x_.high - x_.low);
  const double v = chart_.log_y ? std::log(y / y_.low) / std::log(y_.high / y_.low)
                                : (y - y_.low) / (y_.high - y_.low);
  return {area.x + inset + static_cast<float>(u) * (area.width - 2.0F * inset),
          area.bottom() - static_cast<float>(v) * area.height};
}

}  // namespace merge2d
