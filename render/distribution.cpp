#include "render/distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/ticks.h"

namespace merge2d {
namespace {

constexpr float kGroupHeight = 54.0F, kHead = 44.0F, kFoot = 52.0F;  // design pixels

/// Draws one of them.
class DistributionPainter {
 public:
  DistributionPainter(Painter& painter, const Distribution& what, const Theme& theme,
                      const PixelBox& panel, float unit)
      : painter_(painter), what_(what), theme_(theme), panel_(panel), unit_(unit) {
    font_ = {std::max(9, static_cast<int>(std::lround(12.0F * unit))), Weight::Regular};
    findRange();
    findArea();
  }

  void draw() {
    const Font title{std::max(10, static_cast<int>(std::lround(14.0F * unit_))), Weight::Bold};
    painter_.write(what_.title, title,
                   {std::round(panel_.x + px(14.0F)), std::round(panel_.y + px(24.0F))},
                   theme_.ink);
    painter_.write(what_.x_label, font_, {area_.right(), std::round(area_.bottom() + px(40.0F))},
                   theme_.ink_soft, Align::Right);
    drawAxis();
    for (std::size_t i = 0; i < what_.groups.size(); ++i) drawGroup(i);
  }

 private:
  float px(float design) const { return design * unit_; }
  bool usable(double value) const {
    return std::isfinite(value) && (!what_.logarithmic || value > 0.0);
  }

  void findRange() {
    bool any = false;
    for (const Distribution::Group& group : what_.groups) {
      for (const double value : group.values) {
        if (!usable(value)) continue;
        low_ = any ? std::min(low_, value) : value;
        high_ = any ? std::max(high_, value) : value;
        any = true;
      }
    }
    if (!any) low_ = 1.0, high_ = 10.0;
    if (what_.logarithmic) {
      low_ = std::pow(10.0, std::floor(std::log10(low_)));
      high_ = std::pow(10.0, std::ceil(std::log10(high_)));
      if (low_ == high_) high_ = 10.0 * low_;
    } else {
      low_ = std::min(low_, 0.0);
      if (low_ == high_) high_ = low_ + 1.0;
    }
  }

  void findArea() {
    float names = 0.0F;
    for (const Distribution::Group& group : what_.groups) {
      names = std::max(names, painter_.text().width(group.name, font_));
    }
    names = std::min(names, 0.3F * panel_.width);
    const float left = std::round(panel_.x + px(24.0F) + names);
    const float top = std::round(panel_.y + px(kHead));
    area_ = {left, top, std::max(1.0F, panel_.right() - px(24.0F) - left),
             std::max(1.0F, panel_.bottom() - px(kFoot) - top)};
  }

  float columnOf(double value) const {
    const double part = what_.logarithmic ? std::log(value / low_) / std::log(high_ / low_)
                                          : (value - low_) / (high_ - low_);
    return area_.x + static_cast<float>(part) * area_.width;
  }

  std::vector<double> axisTicks() const {
    if (!what_.logarithmic) return ticks(low_, high_, 6);
    std::vector<double> decades;
    for (double x = low_; x <= 1.001 * high_; x *= 10.0) decades.push_back(x);
    return decades;
  }

  void drawAxis() {
    const float line = std::max(1.0F, std::round(px(1.0F)));
    float free = area_.x - px(30.0F);  // where the last number ends
    for (const double x : axisTicks()) {
      const float column = std::round(columnOf(x));
      painter_.box({column, area_.y, line, area_.height}, 0.0F,
                   {.fill = mix(theme_.background, theme_.ink, 0.12)});
      const std::string text = what_.text ? what_.text(x) : fmt::format("{:g}", x);
      const float half = 0.5F * painter_.text().width(text, font_);
      if (column - half < free) continue;
      free = column + half + px(6.0F);
      painter_.write(text, font_, {column, std::round(area_.bottom() + px(20.0F))}, theme_.ink_soft,
                     Align::Center);
    }
    painter_.box({area_.x, std::round(area_.bottom()), area_.width, line}, 0.0F,
                 {.fill = theme_.ink});
  }

  void drawGroup(std::size_t i) {
    const Distribution::Group& group = what_.groups[i];
    const float height = area_.height / static_cast<float>(what_.groups.size());
    const float middle = area_.y + (static_cast<float>(i) + 0.5F) * height;
    const float drop = std::round(0.5F * painter_.text().capHeight(font_));
    const std::string name =
        painter_.text().elided(group.name, font_, area_.x - panel_.x - px(18.0F));
    painter_.write(name, font_, {area_.x - px(10.0F), std::round(middle) + drop}, theme_.ink,
                   Align::Right);
    std::vector<double> values = group.values;
    std::erase_if(values, [&](double value) { return !usable(value); });
    if (values.empty()) return;
    drawDots(group, values, middle + 0.18F * height, 0.18F * height);
    drawBox(group, quartiles(values), middle - 0.22F * height, 0.12F * height);
  }

  /// Spread up and down, so that equal values can be told apart; by a sequence that fills evenly.
  void drawDots(const Distribution::Group& group, const std::vector<double>& values, float middle,
                float half) {
    constexpr double kGolden = 0.6180339887498949;
    const double opacity =
        std::clamp(20.0 / std::sqrt(static_cast<double>(values.size())), 0.12, 0.8);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double turn = kGolden * static_cast<double>(k + 1);
      const auto shift = static_cast<float>(2.0 * (turn - std::floor(turn)) - 1.0);
      painter_.disc({columnOf(values[k]), middle + shift * half}, px(2.5F),
                    {.fill = withAlpha(group.color, opacity)});
    }
  }

  void drawBox(const Distribution::Group& group, const std::vector<double>& q, float middle,
               float half) {
    const float line = std::max(1.0F, px(1.5F));
    painter_.line({columnOf(q[0]), middle}, {columnOf(q[4]), middle}, line, group.color);
    const float left = columnOf(q[1]), right = columnOf(q[3]);
    painter_.box(
        {left, middle - half, std::max(right - left, line), 2.0F * half}, px(2.0F),
        {.fill = mix(group.color, theme_.background, 0.6), .outline = group.color, .line = line});
    painter_.line({columnOf(q[2]), middle - half}, {columnOf(q[2]), middle + half}, px(2.5F),
                  theme_.ink);
  }

  Painter& painter_;
  const Distribution& what_;
  const Theme& theme_;
  PixelBox panel_;
  float unit_;
  Font font_;
  double low_ = 0.0, high_ = 1.0;
  PixelBox area_;
};

}  // namespace

float heightOf(const Distribution& distribution) {
  return kHead + kFoot + kGroupHeight * static_cast<float>(distribution.groups.size());
}

std::vector<double> quartiles(std::vector<double> values) {
  std::ranges::sort(values);
  std::vector<double> out;
  for (int i = 0; i <= 4; ++i) {
    const double place = 0.25 * i * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    out.push_back(values[below] +
                  (place - static_cast<double>(below)) * (values[above] - values[below]));
  }
  return out;
}

void drawDistribution(Painter& painter, const Distribution& distribution, const Theme& theme,
                      const PixelBox& panel, float unit) {
  DistributionPainter(painter, distribution, theme, panel, unit).draw();
}

}  // namespace merge2d
