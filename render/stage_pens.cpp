#include "render/stage_pens.h"

#include <algorithm>
#include <cmath>

#include "render/label_painter.h"

namespace merge2d {

Color StagePens::heat(double ratio) const {
  if (ratio > 1.0) return bad();
  const double t = ratio <= 0.0 ? 0.0 : std::clamp(std::log10(ratio) + 1.0, 0.0, 1.0);
  return mix(good(), theme().lines[2], t);
}

float StagePens::radius() const {
  return std::clamp(0.12F * scene_.bodySize(), 2.0F, scene_.px(5.5F));
}

float StagePens::lineWidth() const {
  return std::clamp(0.07F * scene_.bodySize(), scene_.px(1.2F), scene_.px(3.0F));
}

void StagePens::arrow(Pixel from, Pixel to, Color color, float thicker) {
  if (std::hypot(to.x - from.x, to.y - from.y) < scene_.px(2.0F)) return;
  painter_.arrow(from, to,
                 {.color = color,
                  .rim = theme().rim,
                  .width = thicker * lineWidth(),
                  .rim_width = scene_.px(1.0F)});
}

void StagePens::vector(const Vec2& from, const Vec2& v, Color color, float thicker, float aside) {
  const double longest = 0.4 * double{scene_.view.panel.height} / scene_.view.scale;
  const double length = v.norm();
  if (length == 0.0) return;
  const Vec2 shown = length > longest ? Vec2(v * (longest / length)) : v;
  const Pixel shift = View::direction(perpendicular(Vec2(v / length))) * aside;
  arrow(scene_.view(from) + shift, scene_.view(from + shown) + shift, color, thicker);
}

void StagePens::ring(Pixel at, float r, Color color, float width) {
  painter_.disc(at, r + scene_.px(1.0F), {.fill = theme().rim});
  painter_.disc(at, r, {.fill = theme().rim, .outline = color, .line = width});
}

void StagePens::dot(Pixel at, float r, Color color) {
  painter_.disc(at, r + scene_.px(1.0F), {.fill = theme().rim});
  painter_.disc(at, r, {.fill = color});
}

void StagePens::cross(Pixel at, float r, Color color) {
  for (const auto& [width, c] :
       {std::pair{scene_.px(4.4F), theme().rim}, std::pair{scene_.px(2.4F), color}}) {
    painter_.line(at - Pixel{r, r}, at + Pixel{r, r}, width, c);
    painter_.line(at - Pixel{r, -r}, at + Pixel{r, -r}, width, c);
  }
}

void StagePens::link(const BodyPair& pair, const Vec2& meeting, float width, Color color) {
  const Pixel a = end(pair.first, meeting), b = end(pair.second, meeting);
  painter_.line(a, b, width + 2.0F * scene_.px(1.0F), withAlpha(theme().rim, 0.85));
  painter_.line(a, b, width, color);
}

Pixel StagePens::end(BodyId id, const Vec2& meeting) const {
  const BodyState* body = scene_.body(id);
  return scene_.view(body == nullptr || isFixed(scene_, *body) ? meeting : body->x);
}

void StagePens::drawLabels() {
  LabelPainter plates(painter_.text(), scene_);
  const Print print{scene_.font(11.0F)};
  for (const Label& l : labels_) plates.put(l.text, print, l.at, l.outline);
  plates.draw(painter_);
}

}  // namespace merge2d
