#include "render/graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "render/camera.h"
#include "render/graph_layout.h"
#include "render/painter.h"
#include "src2d/core/utf8.h"

namespace merge2d {
namespace {

/// The content of one of the two panels.
struct Panel {
  const char* title;
  const Groups& groups;
  const std::vector<std::uint8_t>& holds;         ///< per pair
  std::vector<std::vector<std::uint32_t>> rings;  ///< pairs that hold together only
};

/// Pairs of one contact which hold, a list for each set of bodies that they link.
std::vector<std::vector<std::uint32_t>> ringsOf(const ContactGraph& graph,
                                                const std::vector<std::uint8_t>& holds) {
  const auto ring = [&](std::size_t i) { return holds[i] != 0 && graph.pairs[i].contacts == 1; };
  Groups linked(graph.bodies.size());
  std::iota(linked.begin(), linked.end(), 0u);
  const auto find = [&](std::uint32_t body) {
    while (linked[body] != body) body = linked[body] = linked[linked[body]];
    return body;
  };
  for (std::uint32_t i = 0; i < graph.pairs.size(); ++i) {
    if (ring(i)) linked[find(graph.pairs[i].a)] = find(graph.pairs[i].b);
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> rings;
  for (std::uint32_t i = 0; i < graph.pairs.size(); ++i) {
    if (ring(i)) rings[find(graph.pairs[i].a)].push_back(i);
  }
  std::vector<std::vector<std::uint32_t>> out;
  for (auto& [first, pairs] : rings) out.push_back(std::move(pairs));
  return out;
}

/// The corners of the convex hull, counter-clockwise; fewer than three when all lie on a line.
std::vector<Pixel> hullOf(std::vector<Pixel> points) {
  const auto turn = [](Pixel o, Pixel a, Pixel b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  };
  std::ranges::sort(points, {}, [](Pixel p) { return std::pair(p.x, p.y); });
  std::vector<Pixel> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Pixel p : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.5F) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

class GraphPainter {
 public:
  GraphPainter(Painter& painter, const ContactGraph& graph, const GraphLayout& layout,
               const Theme& theme, const PixelBox& area)
      : painter_(painter),
        graph_(graph),
        layout_(layout),
        theme_(theme),
        area_(area),
        unit_(std::clamp(std::min(area.width, area.height) / 360.0F, 0.4F, 4.0F)),
        view_(cameraOf(layout), plot()) {
    const float crowd =
        std::sqrt(static_cast<float>(std::max<std::size_t>(1, graph.bodies.size())));
    radius_ = std::max(1.5F, std::min(15.0F * unit_, 0.16F * plot().height / crowd));
  }

  void draw(const Panel& panel) {
    findColours(panel.groups);
    for (const auto& ring : panel.rings) drawRing(ring);
    if (layout_.placed) {
      for (std::uint32_t i = 0; i < graph_.bodies.size(); ++i) drawLink(i);
      for (std::uint32_t i = 0; i < graph_.pairs.size(); ++i) drawPoints(i, panel.holds[i] != 0);
    } else {
      for (std::uint32_t i = 0; i < graph_.pairs.size(); ++i) drawEdge(i, panel.holds[i] != 0);
      for (std::uint32_t i = 0; i < graph_.bodies.size(); ++i) drawNode(i);
    }
    for (std::uint32_t i = 0; i < graph_.bodies.size(); ++i) drawName(i);
    drawTitle(panel);
  }

 private:
  Camera cameraOf(const GraphLayout& layout) const {
    Camera camera;
    if (layout.extent.empty()) return camera;
    const Vec2 size = layout.extent.upper - layout.extent.lower;
    const double aspect = static_cast<double>(plot().width) / static_cast<double>(plot().height);
    camera.center = 0.5 * (layout.extent.lower + layout.extent.upper);
    camera.height = std::max({size.y(), size.x() / aspect, 1e-9});
    return camera;
  }

  /// Where the graph is, with room for bodies at the border.
  PixelBox plot() const {
    const float margin = 36.0F * unit_, head = 46.0F * unit_;
    return {area_.x + margin, area_.y + head + 0.5F * margin,
            std::max(1.0F, area_.width - 2.0F * margin),
            std::max(1.0F, area_.height - head - 1.5F * margin)};
  }

  Font font(float size, Weight weight = Weight::Regular) const {
    return {std::max(9, static_cast<int>(std::lround(size * unit_))), weight};
  }

  /// Each group of two or more has a colour.
  void findColours(const Groups& groups) {
    finishes_.assign(groups.size(), theme_.free);
    std::size_t slot = 0;
    for (const auto& members : membersOf(groups)) {
      for (const std::uint32_t i : members) {
        finishes_[i] = theme_.collections[slot % Theme::kFaint];
      }
      ++slot;
    }
  }

  Paint paintOf(std::uint32_t body, double alpha) const {
    const Finish& finish = finishes_[body];
    Paint paint{.fill = withAlpha(finish.fill, alpha),
                .outline = finish.outline,
                .line = std::max(1.0F, 1.5F * unit_)};
    if (graph_.pinned[body] != 0) {
      const float stripes = 1.0F / (6.0F * unit_);
      paint.hatch = {.color = finish.outline, .stripes = {stripes, stripes}, .width = 1.2F * unit_};
    }
    return paint;
  }

  Pixel at(std::uint32_t body) const { return view_(layout_.bodies[body]); }

  /// A pair's contacts, as one place.
  Pixel middleOf(const GraphPair& pair) const {
    if (!layout_.placed || pair.points.empty()) return (at(pair.a) + at(pair.b)) * 0.5F;
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : pair.points) middle += p / static_cast<double>(pair.points.size());
    return view_(middle);
  }

  void drawRing(const std::vector<std::uint32_t>& ring) {
    const Color shade = withAlpha(theme_.collections[Theme::kFaint].fill, 0.55);
    std::vector<Pixel> corners;
    for (const std::uint32_t i : ring) {
      const GraphPair& pair = graph_.pairs[i];
      corners.push_back(middleOf(pair));
      if (!layout_.placed) painter_.line(at(pair.a), at(pair.b), 13.0F * unit_, shade);
    }
    const std::vector<Pixel> hull = hullOf(corners);
    if (layout_.placed && hull.size() >= 3) {
      painter_.polygon(hull, 12.0F * unit_, {.fill = shade});
    }
  }

  void drawEdge(std::uint32_t i, bool holds) {
    const GraphPair& pair = graph_.pairs[i];
    const Color color = holds ? finishes_[pair.a].outline : theme_.broken_contact;
    const Pixel a = at(pair.a), b = at(pair.b), d = b - a;
    const float length = std::max(1.0F, std::hypot(d.x, d.y)), width = std::max(1.0F, 2.0F * unit_);
    const Pixel aside = Pixel{-d.y, d.x} * ((pair.contacts > 1 ? 3.0F * unit_ : 0.0F) / length);
    if (pair.contacts == 0) {
      painter_.line(a, b, 0.5F * width, theme_.ink_soft);
      return;
    }
    painter_.line(a + aside, b + aside, width, color);
    if (pair.contacts > 1) painter_.line(a - aside, b - aside, width, color);
  }

  void drawNode(std::uint32_t i) { painter_.disc(at(i), radius_, paintOf(i, 1.0)); }

  /// A body that joins its contact points.
  void drawLink(std::uint32_t i) {
    std::vector<Pixel> corners;
    for (const Vec2& p : layout_.points[i]) corners.push_back(view_(p));
    if (corners.size() < 2) corners.push_back(at(i));
    const float thick = 0.55F * radius_;
    const std::vector<Pixel> hull = hullOf(corners);
    if (hull.size() >= 3) {
      painter_.polygon(hull, thick, paintOf(i, 0.8));
      return;
    }
    const auto [low, high] =
        std::ranges::minmax_element(corners, {}, [](Pixel p) { return std::pair(p.x, p.y); });
    const Pixel d = *high - *low;
    const float length = std::hypot(d.x, d.y);
    const Pixel axis = length > 0.0F ? d * (1.0F / length) : Pixel{1.0F, 0.0F};
    painter_.box((*low + *high) * 0.5F, axis, {0.5F * length, 0.0F}, thick, paintOf(i, 0.8));
  }

  void drawPoints(std::uint32_t i, bool holds) {
    const Color color = holds ? theme_.ink : theme_.broken_contact;
    for (const Vec2& p : graph_.pairs[i].points) {
      painter_.disc(view_(p), std::max(2.0F, 0.34F * radius_),
                    {.fill = theme_.rim, .outline = color, .line = std::max(1.0F, 2.0F * unit_)});
    }
  }

  /// A name that fits the panel: its beginning, when it is longer.
  std::string shortened(const std::string& name, Font f) const {
    const float room = 0.98F * (area_.width - 2.0F * kNameMargin);
    if (painter_.text().width(name, f) <= room) return name;
    std::string shown;
    for (std::size_t i = 0, bytes = 0; i < name.size(); i += bytes) {
      bytes = std::max<std::size_t>(1, characterBytes(name, i));
      const std::string longer = shown + name.substr(i, bytes);
      if (painter_.text().width(longer + "…", f) > room) break;
      shown = longer;
    }
    return shown + "…";
  }

  void drawName(std::uint32_t i) {
    const Font f = font(layout_.placed ? 13.0F : 12.0F, Weight::Bold);
    const std::string name = shortened(graph_.bodies[i], f);
    const float width = painter_.text().width(name, f), height = painter_.text().capHeight(f);
    if (radius_ < 0.7F * static_cast<float>(f.size)) return;  // too many to be read
    const Pixel middle = at(i);
    const bool inside = !layout_.placed && width < 1.7F * radius_;
    Pixel from = inside ? middle : middle + Pixel{0.0F, layout_.placed ? 0.0F : radius_ + height};
    const float reach = 0.5F * width + kNameMargin;
    from.x = std::max(area_.x + reach, std::min(from.x, area_.x + area_.width - reach));
    const PixelBox plate{from.x - 0.5F * width - 3.0F, from.y - 0.5F * height - 3.0F, width + 6.0F,
                         height + 6.0F};
    if (!inside) painter_.box(plate, 3.0F, {.fill = withAlpha(theme_.background, 0.85)});
    const Color ink = inside && luminance(finishes_[i].fill) < 0.25 ? theme_.rim : theme_.ink;
    painter_.write(name, f, {std::round(from.x), std::round(from.y + 0.5F * height)},
                   inside ? ink : theme_.ink, Align::Center);
  }

  void drawTitle(const Panel& panel) {
    const float left = std::round(area_.x + 16.0F * unit_);
    painter_.write(panel.title, font(17.0F, Weight::Bold),
                   {left, std::round(area_.y + 26.0F * unit_)}, theme_.ink);
    const auto holding = std::ranges::count(panel.holds, 1);
    const std::size_t groups = membersOf(panel.groups).size();
    painter_.write(fmt::format("{} of {} pairs may merge; {} group{}", holding, panel.holds.size(),
                               groups, groups == 1 ? "" : "s"),
                   font(12.0F), {left, std::round(area_.y + 44.0F * unit_)}, theme_.ink_soft);
  }

  static constexpr float kNameMargin = 6.0F;  // between names and the panel's edge [px]

  Painter& painter_;
  const ContactGraph& graph_;
  const GraphLayout& layout_;
  const Theme& theme_;
  PixelBox area_;
  float unit_;
  View view_;
  float radius_ = 0.0F;
  std::vector<Finish> finishes_;
};

}  // namespace

Picture drawGraph(Canvas& canvas, const ContactGraph& graph, const CycleVerdicts& verdicts,
                  const Theme& theme) {
  return canvas.draw(
      composeGraph(canvas.text(), graph, verdicts, canvas.width(), canvas.height(), theme));
}

Drawing composeGraph(Text& text, const ContactGraph& graph, const CycleVerdicts& verdicts,
                     int picture_width, int picture_height, const Theme& theme) {
  const GraphLayout layout = layOutGraph(graph);
  Drawing drawing;
  drawing.background = theme.background;
  Painter painter(drawing, text);
  std::vector<std::vector<std::uint32_t>> cycles;
  for (const CycleOfThree& cycle : verdicts.cycles) cycles.emplace_back(cycle.begin(), cycle.end());
  const Panel panels[] = {
      {"triangle", verdicts.triangle, verdicts.pair_triangle, std::move(cycles)},
      {"rigid", verdicts.rigid, verdicts.pair_rigid, ringsOf(graph, verdicts.pair_rigid)}};
  const float half = 0.5F * static_cast<float>(picture_width);
  const auto height = static_cast<float>(picture_height);
  float left = 0.0F;
  for (const Panel& panel : panels) {
    painter.beginLayer();
    GraphPainter(painter, graph, layout, theme, {left, 0.0F, half, height}).draw(panel);
    left += half;
  }
  painter.box({std::round(half), 0.0F, 1.0F, height}, 0.0F,
              {.fill = mix(theme.background, theme.ink, 0.15)});
  return drawing;
}

}  // namespace merge2d
