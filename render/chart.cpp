#include "render/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "render/chart_axes.h"
#include "render/chart_marks.h"
#include "render/painter.h"
#include "src2d/core/assert.h"

namespace merge2d {
namespace {

/// The room beside a chart for the numbers at its axis and the names of its series [px].
struct Margins {
  float numbers = 0.0F, names = 0.0F;

  void include(const Margins& other) {
    numbers = std::max(numbers, other.numbers);
    names = std::max(names, other.names);
  }
};

/// Draws one chart.
class ChartPainter {
 public:
  /// `unit`: design pixels to pixels.
  ChartPainter(Painter& painter, const Chart& chart, const Theme& theme, const PixelBox& panel,
               float unit)
      : painter_(painter), chart_(chart), axes_(chart), theme_(theme), panel_(panel), unit_(unit) {
    font_ = {std::max(10, static_cast<int>(std::lround(13.0F * unit_))), Weight::Regular};
  }

  Margins margins() const {
    Margins widest;
    for (const Series& series : chart_.series) {
      widest.names = std::max(widest.names, painter_.text().width(series.name, font_));
    }
    for (const double y : axes_.yTicks()) {
      widest.numbers = std::max(widest.numbers, painter_.text().width(axes_.yText(y), font_));
    }
    return widest;
  }

  void draw(const Margins& margins) {
    findArea(margins);
    const Font title{std::max(11, static_cast<int>(std::lround(17.0F * unit_))), Weight::Bold};
    const float left = std::round(panel_.x + px(20.0F));
    painter_.write(chart_.title, title, {left, std::round(panel_.y + px(30.0F))}, theme_.ink);
    painter_.write(chart_.y_label, font_, {left, std::round(panel_.y + px(54.0F))},
                   theme_.ink_soft);
    painter_.write(chart_.x_label, font_, {area_.right(), std::round(area_.bottom() + px(42.0F))},
                   theme_.ink_soft, Align::Right);
    drawGrid();
    if (chart_.stacked) {
      painter_.beginLayer(area_);
      drawAreas();
      painter_.beginLayer();
      drawMarks();
      drawCuts();
      drawAreaNames();
    } else {
      drawMarks();
      painter_.beginLayer(grown(area_, px(2.0F)));
      for (std::size_t i = 0; i < chart_.series.size(); ++i) drawSeries(i);
      painter_.beginLayer();
      drawNames();
    }
    drawAxis();
  }

 private:
  float px(float design) const { return design * unit_; }

  static PixelBox grown(const PixelBox& b, float by) {
    return {b.x - by, b.y - by, b.width + 2.0F * by, b.height + 2.0F * by};
  }

  LineStyle lineOf(std::size_t i) const { return lineStyle(theme_, i, chart_.series.size()); }
  Color areaColor(std::size_t i) const {
    return theme_.collections[i % theme_.collections.size()].fill;
  }

  void findArea(const Margins& margins) {
    const float left = std::round(panel_.x + px(30.0F) + margins.numbers);
    const float right = std::round(panel_.right() - px(50.0F) - margins.names);
    area_ = {left, 0.0F, std::max(1.0F, right - left), 1.0F};
    placeMarks();
    const float top = std::round(panel_.y + px(70.0F + kMarkRow * static_cast<float>(mark_rows_)));
    const float bottom = std::round(panel_.bottom() - px(52.0F));
    area_.y = top, area_.height = std::max(1.0F, bottom - top);
  }

  void placeMarks() {
    constexpr std::size_t kLongest = 30;  // characters
    for (const ChartMark& mark : chart_.marks) {
      if (mark.x < axes_.x().low || mark.x > axes_.x().high) continue;
      PlacedMark& placed = marks_.emplace_back();
      placed.name = shortened(mark.name, kLongest);
      placed.column = std::round(at(mark.x, axes_.y().low).x);
      placed.width = painter_.text().width(placed.name, font_);
    }
    placeNames(marks_, panel_.x + px(10.0F), area_.right(), px(10.0F));
    for (const PlacedMark& mark : marks_) {
      if (mark.named) mark_rows_ = std::max(mark_rows_, mark.row + 1);
    }
  }

  Pixel at(double x, double y) const { return axes_.at(x, y, area_, px(kInset)); }

  float hairline() const { return std::max(1.0F, std::round(px(1.0F))); }

  void drawGrid() {
    const float line = hairline();
    const float drop = std::round(0.5F * painter_.text().capHeight(font_));
    const Paint grid{.fill = mix(theme_.background, theme_.ink, 0.12)};
    for (const double y : axes_.yTicks()) {
      const float row = std::round(at(axes_.x().low, y).y);
      painter_.box({area_.x, row, area_.width, line}, 0.0F, grid);
      painter_.write(axes_.yText(y), font_, {area_.x - px(8.0F), row + drop}, theme_.ink_soft,
                     Align::Right);
    }
  }

  void drawAxis() {
    const float line = hairline();
    const Paint axis{.fill = theme_.ink};
    painter_.box({area_.x, std::round(area_.bottom()), area_.width, line}, 0.0F, axis);
    float free = panel_.x;  // where the last number ends
    for (const auto& [x, text] : axes_.xTicks()) {
      const float column = std::round(at(x, axes_.y().low).x);
      painter_.box({column, std::round(area_.bottom()), line, px(5.0F)}, 0.0F, axis);
      const float half = 0.5F * painter_.text().width(text, font_);
      if (column - half < free) continue;
      free = column + half + px(6.0F);
      painter_.write(text, font_, {column, std::round(area_.bottom() + px(22.0F))}, theme_.ink_soft,
                     Align::Center);
    }
  }

  void drawMarks() {
    const float line = hairline();
    for (const PlacedMark& mark : marks_) {
      const float row = mark.named ? kMarkRow * static_cast<float>(mark.row) : 0.0F;
      for (float y = area_.bottom() - px(3.0F); y > area_.y - px(row); y -= px(6.0F)) {
        painter_.box({mark.column, std::round(y), line, std::round(px(3.0F))}, 0.0F,
                     {.fill = theme_.ink_soft});
      }
      if (!mark.named) continue;
      painter_.write(mark.name, font_,
                     {std::round(mark.start), std::round(area_.y - px(5.0F + row))},
                     theme_.ink_soft);
    }
  }

  void drawAreas() {
    if (chart_.series.empty()) return;
    const std::vector<double>& x = chart_.series.front().x;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const float left = std::round(at(axes_.edge(k), axes_.y().low).x);
      const float right = std::round(at(axes_.edge(k + 1), axes_.y().low).x);
      for (std::size_t i = 0; i < chart_.series.size(); ++i) {
        const float bottom = std::round(at(x[k], axes_.stackedUpTo(i, k)).y);
        const float top = std::round(at(x[k], axes_.stackedUpTo(i + 1, k)).y);
        painter_.box({left, top, right - left, bottom - top}, 0.0F, {.fill = areaColor(i)});
      }
    }
  }

  /// A tip above each stack of areas that goes on beyond the axis.
  void drawCuts() {
    if (chart_.series.empty()) return;
    const std::vector<double>& x = chart_.series.front().x;
    const float half = px(3.0F), height = px(4.0F), base = std::round(area_.y);
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (axes_.stackedUpTo(chart_.series.size(), k) <= axes_.y().high) continue;
      const float middle =
          0.5F * (at(axes_.edge(k), axes_.y().low).x + at(axes_.edge(k + 1), axes_.y().low).x);
      const std::array<Pixel, 3> tip = {Pixel{middle - half, base}, Pixel{middle + half, base},
                                        Pixel{middle, base - height}};
      painter_.polygon(tip, 0.0F, {.fill = theme_.ink});
    }
  }

  /// From the top, in the order of the areas.
  void drawAreaNames() {
    const float height = static_cast<float>(font_.size) * 1.5F;
    const float side = std::round(0.75F * static_cast<float>(font_.size));
    float y = area_.y + side;
    for (std::size_t i = chart_.series.size(); i-- > 0; y += height) {
      const Pixel corner{std::round(area_.right() + px(10.0F)), std::round(y)};
      painter_.box({corner.x, corner.y - side, side, side}, 0.0F, {.fill = areaColor(i)});
      painter_.write(chart_.series[i].name, font_,
                     corner + Pixel{std::round(side + px(5.0F)), 0.0F}, theme_.ink);
    }
  }

  /// Of the values that share a column of pixels the first, the extremes and the last are drawn:
  /// it looks the same as drawing all.
  std::vector<Pixel> thinned(const Series& series) const {
    std::vector<Pixel> out, column;
    const auto flush = [&] {
      if (column.empty()) return;
      const auto [low, high] = std::ranges::minmax_element(column, {}, &Pixel::y);
      out.insert(out.end(), {column.front(), *low, *high, column.back()});
      column.clear();
    };
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!axes_.usable(series.y[i])) continue;
      const Pixel p = at(series.x[i], axes_.shown(series.y[i]));
      if (!column.empty() && std::floor(p.x) != std::floor(column.front().x)) flush();
      column.push_back(p);
    }
    flush();
    return out;
  }

  void drawSeries(std::size_t i) {
    const std::vector<Pixel> points = thinned(chart_.series[i]);
    const LineStyle style = lineOf(i);
    for (std::size_t k = 1; k < points.size(); ++k) {
      if (points[k].x == points[k - 1].x && points[k].y == points[k - 1].y) continue;
      painter_.line(points[k - 1], points[k], px(style.width), style.color);
    }
    if (chart_.points) {
      for (const Pixel point : points) {
        painter_.disc(point, px(1.5F + 0.5F * style.width), {.fill = style.color});
      }
    }
    if (!points.empty()) ends_.emplace_back(points.back().y, i);
  }

  /// At the ends of the lines, moved apart where they would overlap.
  void drawNames() {
    std::ranges::sort(ends_);
    const float height = static_cast<float>(font_.size) * 1.25F;
    float free = area_.y - height;
    for (auto& [y, i] : ends_) free = y = std::max(y, free + height);
    float limit = area_.bottom() + height;
    for (auto it = ends_.rbegin(); it != ends_.rend(); ++it) {
      limit = it->first = std::min(it->first, limit - height);
    }
    const float drop = 0.5F * painter_.text().capHeight(font_);
    for (const auto& [y, i] : ends_) {
      const Pixel sample{area_.right() + px(8.0F), std::round(y)};
      const LineStyle style = lineOf(i);
      painter_.line(sample, sample + Pixel{px(9.0F), 0.0F}, px(style.width), style.color);
      painter_.write(chart_.series[i].name, font_, sample + Pixel{px(17.0F), std::round(drop)},
                     theme_.ink);
    }
  }

  static constexpr float kMarkRow = 16.0F;  ///< height of a row of names
  static constexpr float kInset = 6.0F;     ///< of the first and last value from the frame

  Painter& painter_;
  const Chart& chart_;
  ChartAxes axes_;
  const Theme& theme_;
  PixelBox panel_;
  float unit_ = 1.0F;
  Font font_;
  PixelBox area_;
  std::vector<PlacedMark> marks_;
  std::size_t mark_rows_ = 0;
  std::vector<std::pair<float, std::size_t>> ends_;
};

}  // namespace

LineStyle lineStyle(const Theme& theme, std::size_t i, std::size_t count) {
  constexpr std::array<float, 4> kWidth = {1.5F, 4.0F, 5.8F, 7.4F};
  constexpr std::array<double, 4> kPale = {0.0, 0.3, 0.4, 0.5};
  const std::size_t above = std::min(count - 1 - i, kWidth.size() - 1);
  const Color color = theme.lines[i % theme.lines.size()];
  return {mix(color, theme.background, kPale[above]), kWidth[above]};
}

Picture drawChart(Canvas& canvas, const Chart& chart, const Theme& theme) {
  return drawCharts(canvas, {&chart, 1}, 1, theme);
}

Picture drawCharts(Canvas& canvas, std::span<const Chart> charts, int columns, const Theme& theme) {
  return canvas.draw(
      composeCharts(canvas.text(), charts, columns, canvas.width(), canvas.height(), theme));
}

Drawing composeCharts(Text& text, std::span<const Chart> charts, int columns, int picture_width,
                      int picture_height, const Theme& theme) {
  MERGE2D_ASSERT(columns > 0, "{} columns", columns);
  Drawing drawing;
  drawing.background = theme.background;
  Painter painter(drawing, text);
  painter.beginLayer();
  const int rows = (static_cast<int>(charts.size()) + columns - 1) / columns;
  const float width = static_cast<float>(picture_width) / static_cast<float>(columns);
  const float height = static_cast<float>(picture_height) / static_cast<float>(std::max(1, rows));
  const float unit = std::clamp(std::min(width / 960.0F, height / 240.0F), 0.6F, 6.0F);
  std::vector<ChartPainter> painters;
  std::vector<Margins> margins(static_cast<std::size_t>(columns));  // one per column: axes in line
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    const PixelBox panel{static_cast<float>(column) * width, static_cast<float>(row) * height,
                         width, height};
    painters.emplace_back(painter, charts[i], theme, panel, unit);
    margins[static_cast<std::size_t>(column)].include(painters.back().margins());
  }
  for (std::size_t i = 0; i < charts.size(); ++i) painters[i].draw(margins[i % margins.size()]);
  return drawing;
}

}  // namespace merge2d
