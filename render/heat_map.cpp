#include "render/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace merge2d {
namespace {

std::string cellText(const HeatMap& map, double value) {
  return map.text ? map.text(value) : fmt::format("{:.3g}", value);
}

/// Draws one map.
class HeatMapPainter {
 public:
  HeatMapPainter(Painter& painter, const HeatMap& map, const Theme& theme, const PixelBox& panel,
                 float unit)
      : painter_(painter), map_(map), theme_(theme), panel_(panel), unit_(unit) {
    font_ = {std::max(9, static_cast<int>(std::lround(12.0F * unit))), Weight::Regular};
    findArea();
  }

  void draw() {
    const Font title{std::max(10, static_cast<int>(std::lround(14.0F * unit_))), Weight::Bold};
    const float left = std::round(panel_.x + px(14.0F));
    painter_.write(painter_.text().elided(map_.title, title, panel_.width - px(20.0F)), title,
                   {left, std::round(panel_.y + px(24.0F))}, theme_.ink);
    painter_.write(painter_.text().elided(map_.y_label, font_, panel_.width - px(20.0F)), font_,
                   {left, std::round(panel_.y + px(46.0F))}, theme_.ink_soft);
    painter_.write(map_.x_label, font_, {area_.right(), std::round(area_.bottom() + px(40.0F))},
                   theme_.ink_soft, Align::Right);
    for (std::size_t row = 0; row < map_.y_values.size(); ++row) drawRow(row);
    drawColumnValues();
  }

 private:
  float px(float design) const { return design * unit_; }

  void findArea() {
    float numbers = 0.0F;
    for (const std::string& value : map_.y_values) {
      numbers = std::max(numbers, painter_.text().width(value, font_));
    }
    const float left = std::round(panel_.x + px(22.0F) + numbers);
    const float top = std::round(panel_.y + px(58.0F));
    area_ = {left, top, std::max(1.0F, panel_.right() - px(16.0F) - left),
             std::max(1.0F, panel_.bottom() - px(50.0F) - top)};
    cell_width_ = area_.width / static_cast<float>(std::max<std::size_t>(1, map_.x_values.size()));
    cell_height_ =
        area_.height / static_cast<float>(std::max<std::size_t>(1, map_.y_values.size()));
  }

  /// Whole pixels, so that cells neither overlap nor leave gaps.
  PixelBox cellAt(std::size_t row, std::size_t column) const {
    const auto edge = [](float start, float size, std::size_t i) {
      return std::round(start + size * static_cast<float>(i));
    };
    const std::size_t from_top = map_.y_values.size() - 1 - row;
    const float x = edge(area_.x, cell_width_, column), y = edge(area_.y, cell_height_, from_top);
    return {x, y, edge(area_.x, cell_width_, column + 1) - x - 1.0F,
            edge(area_.y, cell_height_, from_top + 1) - y - 1.0F};
  }

  double partOf(double value) const {
    if (map_.high <= map_.low) return 0.5;
    const double part = map_.logarithmic
                            ? std::log(value / map_.low) / std::log(map_.high / map_.low)
                            : (value - map_.low) / (map_.high - map_.low);
    return std::clamp(part, 0.0, 1.0);
  }

  void drawRow(std::size_t row) {
    const float drop = std::round(0.5F * painter_.text().capHeight(font_));
    for (std::size_t column = 0; column < map_.x_values.size(); ++column) {
      const PixelBox cell = cellAt(row, column);
      const std::optional<double> value = map_.cells[row * map_.x_values.size() + column];
      const Pixel middle{cell.x + 0.5F * cell.width, cell.y + 0.5F * cell.height};
      if (column == 0 && isShown(row, rowsApart())) {
        painter_.write(map_.y_values[row], font_, {area_.x - px(7.0F), std::round(middle.y) + drop},
                       theme_.ink_soft, Align::Right);
      }
      if (!value) {
        painter_.box(cell, 0.0F, {.fill = mix(theme_.background, theme_.ink, 0.05)});
        continue;
      }
      const Color color = heatColor(theme_, partOf(*value));
      painter_.box(cell, 0.0F, {.fill = color});
      const std::string text = cellText(map_, *value);
      const bool fits = painter_.text().width(text, font_) < cell.width - px(6.0F) &&
                        cell.height > 1.4F * static_cast<float>(font_.size);
      if (!fits) continue;
      const Color ink = contrast(color, rgb(0xffffff)) >= contrast(color, rgb(0x101418))
                            ? rgb(0xffffff)
                            : rgb(0x101418);
      painter_.write(text, font_, {middle.x, std::round(middle.y) + drop}, ink, Align::Center);
    }
  }

  /// Of crowded values each so manieth is written.
  std::size_t rowsApart() const {
    return apart(1.5F * static_cast<float>(font_.size), cell_height_);
  }
  static std::size_t apart(float needed, float there) {
    return static_cast<std::size_t>(std::max(1.0F, std::ceil(needed / std::max(there, 1.0F))));
  }
  static bool isShown(std::size_t i, std::size_t step) { return i % step == 0; }

  void drawColumnValues() {
    float widest = 0.0F;
    for (const std::string& value : map_.x_values) {
      widest = std::max(widest, painter_.text().width(value, font_));
    }
    const std::size_t step = apart(widest + px(8.0F), cell_width_);
    for (std::size_t column = 0; column < map_.x_values.size(); ++column) {
      if (!isShown(column, step)) continue;
      const PixelBox cell = cellAt(0, column);
      painter_.write(map_.x_values[column], font_,
                     {cell.x + 0.5F * cell.width, std::round(area_.bottom() + px(20.0F))},
                     theme_.ink_soft, Align::Center);
    }
  }

  Painter& painter_;
  const HeatMap& map_;
  const Theme& theme_;
  PixelBox panel_;
  float unit_;
  Font font_;
  PixelBox area_;
  float cell_width_ = 1.0F, cell_height_ = 1.0F;
};

}  // namespace

Color heatColor(const Theme& theme, double part) {
  // Blue of even steps in lightness; the theme decides which end stands for little.
  static constexpr std::array<Color, 5> kScale = {rgb(0xf2f6fb), rgb(0xbcd4ea), rgb(0x74a9d3),
                                                  rgb(0x2f78b3), rgb(0x0b3d73)};
  const bool dark = luminance(theme.background) < 0.2;
  const double place = (dark ? 1.0 - part : part) * (kScale.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), kScale.size() - 2);
  return mix(kScale[i], kScale[i + 1], place - static_cast<double>(i));
}

void drawHeatMap(Painter& painter, const HeatMap& map, const Theme& theme, const PixelBox& panel,
                 float unit) {
  HeatMapPainter(painter, map, theme, panel, unit).draw();
}

}  // namespace merge2d
