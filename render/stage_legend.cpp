#include "render/stage_legend.h"

#include <cmath>

namespace merge2d {

void StageLegend::arrow(const std::string& meaning, Color color, float width) {
  sample(meaning, width, [this, color, width](Painter& p, Pixel left) {
    p.arrow(left, left + Pixel{scene_.px(width), 0.0F}, {.color = color, .width = scene_.px(2.4F)});
  });
}

void StageLegend::line(const std::string& meaning, Color color) {
  sample(meaning, 20.0F, [this, color](Painter& p, Pixel left) {
    p.line(left, left + Pixel{scene_.px(20.0F), 0.0F}, scene_.px(3.0F), color);
  });
}

void StageLegend::ring(const std::string& meaning, Color color) {
  sample(meaning, 11.0F, [this, color](Painter& p, Pixel left) {
    p.disc(left + Pixel{scene_.px(5.0F), 0.0F}, scene_.px(5.0F),
           {.fill = scene_.theme().rim, .outline = color, .line = scene_.px(2.0F)});
  });
}

void StageLegend::dot(const std::string& meaning, Color color) {
  sample(meaning, 8.0F, [this, color](Painter& p, Pixel left) {
    p.disc(left + Pixel{scene_.px(4.0F), 0.0F}, scene_.px(4.0F), {.fill = color});
  });
}

void StageLegend::cross(const std::string& meaning, Color color) {
  sample(meaning, 11.0F, [this, color](Painter& p, Pixel left) {
    const Pixel at = left + Pixel{scene_.px(5.0F), 0.0F};
    const float r = scene_.px(4.0F);
    p.line(at - Pixel{r, r}, at + Pixel{r, r}, scene_.px(2.4F), color);
    p.line(at - Pixel{r, -r}, at + Pixel{r, -r}, scene_.px(2.4F), color);
  });
}

void StageLegend::mergedMark(const std::string& meaning) {
  sample(meaning, 11.0F, [this](Painter& p, Pixel left) {
    drawMergedMark(p, scene_, left + Pixel{scene_.px(5.0F), 0.0F}, scene_.px(4.5F));
  });
}

void StageLegend::draw(Painter& painter) const {
  const float right = drawScale(painter, scene_) - scene_.px(24.0F);
  const Font font = scene_.font(13.0F);
  const float y = scene_.layout.footer.y + 0.5F * scene_.layout.footer.height;
  const float baseline = std::round(y + 0.5F * painter.text().capHeight(font));
  float x = scene_.px(20.0F);
  for (const Entry& e : entries_) {
    const float sample = e.width > 0.0F ? scene_.px(e.width) + scene_.px(6.0F) : 0.0F;
    const float width = sample + painter.text().width(e.meaning, font);
    if (x + width > right) break;
    if (e.draw) e.draw(painter, {std::round(x), y});
    painter.write(e.meaning, font, {x + sample, baseline}, scene_.theme().ink_soft);
    x += width + scene_.px(17.0F);
  }
}

}  // namespace merge2d
