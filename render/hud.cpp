/// The frame around the world: title and numbers above it, legend and scale bar below.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "render/frame_parts.h"

namespace merge2d {
namespace {

constexpr float kTextMargin = 20.0F;  // between text and the picture's edge [design px]

/// The most a count may become, which says how much room it needs.
long long largestCount(const FrameScene& scene) {
  return 4LL * std::max<long long>(scene.snapshot.stats.bodies,
                                   static_cast<long long>(scene.bodies.size()));
}

/// Numbers in columns that keep their places from frame to frame, as many as fit.
void drawCounts(Painter& painter, const FrameScene& scene, float baseline, float right) {
  const Font font = scene.font(13.0F);
  const std::string room(std::to_string(largestCount(scene)).size(), '0');
  const float digits = painter.text().width(room, font), gap = scene.px(5.0F);
  float end = 0.0F;
  for (const Count& count : countsOf(scene.snapshot, scene.style.mode)) {
    // The first one stands at the margin, under the title; the others end where they always end.
    const bool first = end == 0.0F;
    const std::string number = std::to_string(count.number);
    const float left =
        first ? scene.px(kTextMargin) : end + digits - painter.text().width(number, font);
    const float meaning = left + painter.text().width(number, font) + gap;
    end = meaning + painter.text().width(count.many, font) + scene.px(12.0F);
    if (end > right) return;
    painter.write(number, font, {left, baseline}, scene.theme().ink);
    painter.write(count.number == 1 ? count.one : count.many, font, {meaning, baseline},
                  scene.theme().ink_soft);
  }
}

/// One sample and what it means.
struct LegendEntry {
  std::string meaning;
  float width;  ///< of the sample [design px]
  std::function<void(Painter&, Pixel left)> draw;
};

/// Collects what the picture may show. It depends on the run and not on the frame, so that entries
/// keep their places.
class LegendEntries {
 public:
  explicit LegendEntries(const FrameScene& scene) : scene_(scene) {
    addBodies();
    addMarks();
  }

  std::vector<LegendEntry> entries;

 private:
  Paint swatch(const Finish& finish) const {
    return {.fill = finish.fill, .outline = finish.outline, .line = scene_.px(1.3F)};
  }
  PixelBox square(Pixel left) const {
    const float side = scene_.px(13.0F);
    return {std::round(left.x), std::round(left.y - 0.5F * side), std::round(side),
            std::round(side)};
  }
  void addSwatch(std::string meaning, const Paint& paint) {
    entries.push_back({std::move(meaning), 13.0F, [this, paint](Painter& p, Pixel left) {
                         p.box(square(left), scene_.px(2.0F), paint);
                       }});
  }

  void addBodies() {
    const Theme& theme = scene_.theme();
    if (merges(scene_.style.mode)) {
      entries.push_back(
          {"collections", 29.0F, [this](Painter& p, Pixel left) {
             for (const int i : {2, 1, 0}) {
               const auto slot = static_cast<std::size_t>(i);
               const Pixel at = left + Pixel{scene_.px(8.0F) * static_cast<float>(i), 0.0F};
               p.box(square(at), scene_.px(2.0F), swatch(scene_.theme().collections[slot]));
             }
           }});
    }
    addSwatch("free", swatch(theme.free));
    if (sleeps(scene_.style.mode)) addSwatch("asleep", swatch(theme.asleep));
    addFixed("pinned", Motion::Pinned);
    addFixed("scripted", Motion::Scripted);
  }

  void addFixed(const char* meaning, Motion motion) {
    const bool any = std::ranges::any_of(
        scene_.bodies, [&](const BodyInfo& body) { return body.motion == motion; });
    if (!any) return;
    Paint paint = swatch(scene_.theme().fixed);
    paint.hatch = hatchOf(scene_, {}, {}, motion == Motion::Scripted);
    paint.hatch.stripes = paint.hatch.stripes * 2.0F;
    addSwatch(meaning, paint);
  }

  void addMarks() {
    const Theme& theme = scene_.theme();
    if (scene_.shows(Overlay::Graph)) addLine("in contact", 1.3F, theme.graph);
    if (merges(scene_.style.mode) && scene_.shows(Overlay::Welds)) {
      addLine("weld", 3.5F, theme.graph);
    }
    if (merges(scene_.style.mode) && scene_.shows(Overlay::Boxes)) {
      addSwatch("oriented box", {.outline = theme.box, .line = scene_.px(2.0F)});
    }
    if (scene_.shows(Overlay::Contacts)) {
      addMark("merged", drawMergedMark);
      addMark("active", drawActiveMark);
      addMark("broken", drawBrokenMark);
    }
    if (scene_.shows(Overlay::Forces)) {
      addArrow("normal", theme.normal_force);
      addArrow("friction", theme.friction_force);
      if (merges(scene_.style.mode)) addArrow("internal", theme.internal_force);
    }
    if (scene_.shows(Overlay::Velocities)) addVelocity();
  }

  /// With a round speed, and the arrow of a body that moves so fast.
  void addVelocity() {
    constexpr float kLongest = 30.0F;
    const double length = scene_.style.velocity_scale * scene_.view.scale / scene_.px(1.0F);
    const double speed = roundLength(kLongest / length);
    addArrow(fmt::format("velocity, {:g} m/s", speed), scene_.theme().velocity,
             static_cast<float>(speed * length));
  }

  void addMark(const char* meaning, void (*mark)(Painter&, const FrameScene&, Pixel, float)) {
    entries.push_back({meaning, 10.0F, [this, mark](Painter& p, Pixel left) {
                         mark(p, scene_, left + Pixel{scene_.px(5.0F), 0.0F}, scene_.px(4.2F));
                       }});
  }
  void addLine(const char* meaning, float width, Color color) {
    entries.push_back(
        {meaning, 18.0F, [this, width, color](Painter& p, Pixel left) {
           p.line(left, left + Pixel{scene_.px(18.0F), 0.0F}, scene_.px(width), color);
         }});
  }
  void addArrow(std::string meaning, Color color, float length = 22.0F) {
    entries.push_back({std::move(meaning), length, [this, color, length](Painter& p, Pixel left) {
                         p.arrow(left, left + Pixel{scene_.px(length), 0.0F},
                                 {.color = color, .width = scene_.px(2.2F)});
                       }});
  }

  const FrameScene& scene_;
};

/// From left to right, as many as fit before `right` in one row, or in two where one is too short.
void drawLegend(Painter& painter, const FrameScene& scene, float right) {
  const LegendEntries legend(scene);
  const Font font = scene.font(13.0F);
  const float margin = scene.px(kTextMargin), gap = scene.px(17.0F);
  const auto sampleOf = [&](const LegendEntry& e) { return scene.px(e.width) + scene.px(6.0F); };
  const auto widthOf = [&](const LegendEntry& e) {
    return sampleOf(e) + painter.text().width(e.meaning, font);
  };
  float all = margin - gap;
  for (const LegendEntry& entry : legend.entries) all += widthOf(entry) + gap;
  std::vector<float> rows{0.5F};  // of the footer's height
  if (all > right) rows = {0.3F, 0.72F};
  auto entry = legend.entries.begin();
  for (const float row : rows) {
    const float y = std::round(scene.layout.footer.y + row * scene.layout.footer.height);
    const float baseline = std::round(y + 0.5F * painter.text().capHeight(font));
    for (float x = margin; entry != legend.entries.end(); ++entry) {
      const float width = widthOf(*entry);
      if (x + width > right) break;
      entry->draw(painter, {std::round(x), y});
      painter.write(entry->meaning, font, {x + sampleOf(*entry), baseline}, scene.theme().ink_soft);
      x += width + gap;
    }
  }
}

}  // namespace

float drawScale(Painter& painter, const FrameScene& scene) {
  const Layout& layout = scene.layout;
  const double length = roundLength(0.12 * double{layout.panel.width} / scene.view.scale);
  const std::string label = lengthLabel(length);
  const Font font = scene.font(13.0F);
  const float right = layout.footer.right() - scene.px(kTextMargin);
  const float left = right - scene.view(length);
  const float y = std::round(layout.footer.y + 0.5F * layout.footer.height);
  const float line = std::max(1.0F, std::round(scene.px(1.6F))), tick = scene.px(4.0F);
  const Paint ink{.fill = scene.theme().ink};
  painter.box({left, std::round(y - 0.5F * line), right - left, line}, 0.0F, ink);
  for (const float x : {left, right - line}) {
    painter.box({x, y - tick, line, 2.0F * tick}, 0.0F, ink);
  }
  const float text = left - scene.px(8.0F) - painter.text().width(label, font);
  painter.write(label, font, {text, y + 0.5F * painter.text().capHeight(font)}, scene.theme().ink);
  return text;
}

std::vector<Count> countsOf(const Snapshot& snapshot, Mode mode) {
  const Stats& s = snapshot.stats;
  std::vector<Count> counts = {{s.bodies, "body", "bodies"},
                               {s.active_bodies, "active |B|", "active |B|"}};
  if (merges(mode)) counts.push_back({s.collections, "collection", "collections"});
  if (sleeps(mode)) counts.push_back({s.asleep, "asleep", "asleep"});
  counts.push_back({s.contacts, "contact", "contacts"});
  if (merges(mode)) {
    const auto merged = std::ranges::count(snapshot.contacts, true, &ContactView::internal);
    counts.push_back({static_cast<int>(merged), "merged contact", "merged contacts"});
  }
  return counts;
}

void drawCaption(Painter& painter, const FrameScene& scene) {
  if (!scene.shows(Overlay::Hud)) return;
  const Theme& theme = scene.theme();
  const bool two_lines = scene.layout.caption.height > scene.px(50.0F);
  const Font title = scene.font(19.0F, Weight::Bold), time = scene.font(19.0F);
  const float left = scene.px(kTextMargin), gap = scene.px(24.0F);
  const float right = scene.layout.caption.right() - scene.px(kTextMargin);

  const float first = std::round(scene.px(two_lines ? 30.0F : 25.0F));
  const std::string clock = fmt::format("t = {:.2f} s", scene.snapshot.time);
  const float time_left = right - painter.text().width(clock, time);
  painter.write(clock, time, {time_left, first}, theme.ink);
  painter.write(painter.text().elided(scene.style.title, title, time_left - gap - left), title,
                {left, first}, theme.ink);
  if (!two_lines) return;

  const Font small = scene.font(13.0F);
  const float second = std::round(scene.px(51.0F));
  const std::string step =
      fmt::format("step {}  ·  {}", scene.snapshot.step, name(scene.style.mode));
  const float step_left = right - painter.text().width(step, small);
  painter.write(step, small, {step_left, second}, theme.ink_soft);
  drawCounts(painter, scene, second, step_left - gap);
}

void drawFooter(Painter& painter, const FrameScene& scene) {
  float right = scene.layout.footer.right() - scene.px(kTextMargin);
  if (scene.shows(Overlay::Scale)) right = drawScale(painter, scene) - scene.px(24.0F);
  if (scene.shows(Overlay::Legend)) drawLegend(painter, scene, right);
}

}  // namespace merge2d
