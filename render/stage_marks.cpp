#include "render/stage_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "render/label_painter.h"

namespace merge2d {
namespace {

using Pair = std::pair<BodyId, BodyId>;

/// One sample and what it means.
struct LegendEntry {
  std::string meaning;
  float width;  ///< of the sample [design px]
  std::function<void(Painter&, Pixel left)> draw;
};

/// A text over the marks.
struct PendingLabel {
  std::string text;
  Pixel at;
  Color outline;
};

Pair ordered(BodyId a, BodyId b) { return a < b ? Pair{a, b} : Pair{b, a}; }

std::map<Pair, Vec2> meetings(const Snapshot& snapshot) {
  std::map<Pair, std::pair<Vec2, int>> sums;
  for (const ContactView& c : snapshot.contacts) {
    auto& [sum, count] = sums.try_emplace(ordered(c.a, c.b), Vec2::Zero(), 0).first->second;
    sum += c.x;
    ++count;
  }
  std::map<Pair, Vec2> means;
  for (const auto& [pair, entry] : sums) means[pair] = entry.first / entry.second;
  return means;
}

/// The marks of one stage.
class StageMarks {
 public:
  StageMarks(Painter& painter, const FrameScene& scene, const StepRecord& record, Stage stage,
             const Snapshot* reference)
      : painter_(painter),
        scene_(scene),
        record_(record),
        stage_(stage),
        after_(record[stage].after),
        before_(record.before_stage(stage)),
        reference_(reference) {}

  void draw() {
    drawMarksOfStage();
    painter_.beginLayer(scene_.layout.panel);
    drawPendingLabels();
    painter_.beginLayer();
    drawLegend();
  }

 private:
  void drawMarksOfStage() {
    switch (stage_) {
      case Stage::ContactDetection:
        drawFound();
        break;
      case Stage::ContactOrdering:
        drawOrder();
        break;
      case Stage::SleepAndWake:
        drawSleep();
        break;
      case Stage::WarmStart:
        drawImpulses(after_, good(), 1.0F);
        arrowEntry("impulses of the last step", good());
        break;
      case Stage::SingleIterationPGS:
        drawSweep();
        break;
      case Stage::Unmerge:
        drawUnmerge();
        break;
      case Stage::SolveLCP:
        drawSolution();
        break;
      case Stage::AdvanceVelocities:
        drawVelocities();
        break;
      case Stage::AccumulateRelativeMotion:
        drawCorners();
        break;
      case Stage::AdvancePositions:
        drawWay();
        break;
      case Stage::Merge:
        drawMerge();
        break;
    }
  }

  // ---- colours and sizes ----

  const Theme& theme() const { return scene_.theme(); }
  Color good() const { return theme().internal_force; }
  Color bad() const { return theme().broken_contact; }
  Color pale(Color color) const { return mix(color, theme().background, 0.55); }
  /// From far below a threshold to above it.
  Color heat(double ratio) const {
    if (ratio > 1.0) return bad();
    const double t = ratio <= 0.0 ? 0.0 : std::clamp(std::log10(ratio) + 1.0, 0.0, 1.0);
    return mix(good(), theme().lines[2], t);
  }
  float radius() const { return std::clamp(0.12F * scene_.bodySize(), 2.0F, scene_.px(5.5F)); }
  float lineWidth() const {
    return std::clamp(0.07F * scene_.bodySize(), scene_.px(1.2F), scene_.px(3.0F));
  }

  // ---- parts ----

  void arrowTo(Pixel from, Pixel to, Color color, float thicker = 1.0F) {
    if (std::hypot(to.x - from.x, to.y - from.y) < scene_.px(2.0F)) return;
    painter_.arrow(from, to,
                   {.color = color,
                    .rim = theme().rim,
                    .width = thicker * lineWidth(),
                    .rim_width = scene_.px(1.0F)});
  }

  /// The vector `v` [m] in the world, `aside` pixels to its left; too long ones are cut.
  void vector(const Vec2& from, const Vec2& v, Color color, float thicker = 1.0F,
              float aside = 0.0F) {
    const double longest = 0.4 * double{scene_.view.panel.height} / scene_.view.scale;
    const double length = v.norm();
    if (length == 0.0) return;
    const Vec2 shown = length > longest ? Vec2(v * (longest / length)) : v;
    const Pixel shift = View::direction(perpendicular(Vec2(v / length))) * aside;
    arrowTo(scene_.view(from) + shift, scene_.view(from + shown) + shift, color, thicker);
  }

  void ring(Pixel at, float r, Color color, float width) {
    painter_.disc(at, r + scene_.px(1.0F), {.fill = theme().rim});
    painter_.disc(at, r, {.fill = theme().rim, .outline = color, .line = width});
  }

  void dot(Pixel at, float r, Color color) {
    painter_.disc(at, r + scene_.px(1.0F), {.fill = theme().rim});
    painter_.disc(at, r, {.fill = color});
  }

  void cross(Pixel at, float r, Color color) {
    for (const auto& [width, c] :
         {std::pair{scene_.px(4.4F), theme().rim}, std::pair{scene_.px(2.4F), color}}) {
      painter_.line(at - Pixel{r, r}, at + Pixel{r, r}, width, c);
      painter_.line(at - Pixel{r, -r}, at + Pixel{r, -r}, width, c);
    }
  }

  void label(const std::string& text, Pixel at, Color outline) {
    pending_.push_back({text, at, outline});
  }

  void drawPendingLabels() {
    LabelPainter labels(painter_, scene_);
    for (const PendingLabel& l : pending_) labels.put(l.text, scene_.font(11.0F), l.at, l.outline);
  }

  /// From left to right, as many as fit before the scale.
  void drawLegend() {
    const float right = drawScale(painter_, scene_) - scene_.px(24.0F);
    const Font font = scene_.font(13.0F);
    const float y = scene_.layout.footer.y + 0.5F * scene_.layout.footer.height;
    const float baseline = std::round(y + 0.5F * painter_.text().capHeight(font));
    float x = scene_.px(20.0F);
    for (const LegendEntry& e : legend_) {
      const float sample = e.width > 0.0F ? scene_.px(e.width) + scene_.px(6.0F) : 0.0F;
      const float width = sample + painter_.text().width(e.meaning, font);
      if (x + width > right) break;
      if (e.draw) e.draw(painter_, {std::round(x), y});
      painter_.write(e.meaning, font, {x + sample, baseline}, theme().ink_soft);
      x += width + scene_.px(17.0F);
    }
  }

  /// Where the line to a body ends: at its centre, or, for a fixed one, where the two meet.
  Pixel end(BodyId id, const Vec2& meeting) const {
    const BodyState* body = scene_.body(id);
    return scene_.view(body == nullptr || isFixed(scene_, *body) ? meeting : body->x);
  }

  void link(const Pair& pair, const Vec2& meeting, float width, Color color) {
    const Pixel a = end(pair.first, meeting), b = end(pair.second, meeting);
    painter_.line(a, b, width + 2.0F * scene_.px(1.0F), withAlpha(theme().rim, 0.85));
    painter_.line(a, b, width, color);
  }

  // ---- legend ----

  void entry(std::string meaning, float width, std::function<void(Painter&, Pixel)> draw) {
    legend_.push_back({std::move(meaning), width, std::move(draw)});
  }
  void arrowEntry(const std::string& meaning, Color color) {
    entry(meaning, 22.0F, [this, color](Painter& p, Pixel left) {
      p.arrow(left, left + Pixel{scene_.px(22.0F), 0.0F},
              {.color = color, .width = scene_.px(2.4F)});
    });
  }
  void lineEntry(const std::string& meaning, Color color) {
    entry(meaning, 20.0F, [this, color](Painter& p, Pixel left) {
      p.line(left, left + Pixel{scene_.px(20.0F), 0.0F}, scene_.px(3.0F), color);
    });
  }
  void ringEntry(const std::string& meaning, Color color) {
    entry(meaning, 11.0F, [this, color](Painter& p, Pixel left) {
      p.disc(left + Pixel{scene_.px(5.0F), 0.0F}, scene_.px(5.0F),
             {.fill = theme().rim, .outline = color, .line = scene_.px(2.0F)});
    });
  }
  void squareEntry(const std::string& meaning) {
    entry(meaning, 11.0F, [this](Painter& p, Pixel left) {
      drawMergedMark(p, scene_, left + Pixel{scene_.px(5.0F), 0.0F}, scene_.px(4.5F));
    });
  }
  void crossEntry(const std::string& meaning, Color color) {
    entry(meaning, 11.0F, [this, color](Painter& p, Pixel left) {
      const Pixel at = left + Pixel{scene_.px(5.0F), 0.0F};
      const float r = scene_.px(4.0F);
      p.line(at - Pixel{r, r}, at + Pixel{r, r}, scene_.px(2.4F), color);
      p.line(at - Pixel{r, -r}, at + Pixel{r, -r}, scene_.px(2.4F), color);
    });
  }

  // ---- the stages ----

  void drawFound() {
    for (const ContactView& c : after_.contacts) {
      const Pixel at = scene_.view(c.x);
      if (c.internal) {
        drawMergedMark(painter_, scene_, at, 0.8F * radius());
        continue;
      }
      const Color color = c.fresh ? theme().lines[2] : good();
      const Pixel up = View::direction(c.normal) * (3.2F * radius());
      painter_.line(at, at + up, scene_.px(1.6F), color);
      ring(at, c.fresh ? 1.25F * radius() : radius(), color, std::max(1.0F, 0.4F * radius()));
    }
    for (const NotedPoint& p : record_.notes.pruned) {
      cross(scene_.view(p.x), 0.8F * radius(), theme().ink_soft);
    }
    ringEntry("new or without force so far", theme().lines[2]);
    ringEntry("kept from the last step", good());
    squareEntry("inside a collection: not looked for");
    crossEntry("found, but pruned", theme().ink_soft);
  }

  void drawOrder() {
    const auto meeting = meetings(after_);
    const auto& order = record_.notes.order;
    int deepest = 1;
    for (const NotedVisit& v : order) deepest = std::max(deepest, v.depth);
    const auto shade = [&](int depth) {
      if (depth == 0) return theme().ink_soft;
      const double t = static_cast<double>(depth - 1) / std::max(1, deepest - 1);
      return mix(bad(), pale(good()), t);
    };
    std::map<Pair, std::size_t> place;
    for (std::size_t i = order.size(); i-- > 0;) {
      const Pair pair = ordered(order[i].a, order[i].b);
      place[pair] = i;
      const auto found = meeting.find(pair);
      if (found == meeting.end()) continue;
      link(pair, found->second, lineWidth(), shade(order[i].depth));
    }
    for (const BodyId seed : record_.notes.seeds) {
      const BodyState* body = scene_.body(seed);
      if (body != nullptr && !isFixed(scene_, *body)) {
        ring(scene_.view(body->x), 1.6F * radius(), bad(), scene_.px(2.4F));
      }
    }
    std::vector<std::pair<std::size_t, Vec2>> numbers;
    for (const auto& [pair, i] : place) {
      if (const auto found = meeting.find(pair); found != meeting.end()) {
        numbers.emplace_back(i, found->second);
      }
    }
    std::ranges::sort(numbers, {}, &std::pair<std::size_t, Vec2>::first);
    for (const auto& [i, x] : numbers) {
      label(fmt::format("{}", i + 1), scene_.view(x), shade(order[i].depth));
    }
    if (order.empty()) {
      for (const auto& [pair, x] : meeting) dot(scene_.view(x), 0.7F * radius(), theme().ink_soft);
      entry("stored order: nothing new", 8.0F, [this](Painter& p, Pixel left) {
        p.disc(left + Pixel{scene_.px(4.0F), 0.0F}, scene_.px(4.0F), {.fill = theme().ink_soft});
      });
      return;
    }
    ringEntry("new here: the walk starts", bad());
    lineEntry("first", shade(1));
    if (deepest > 1) lineEntry("last", shade(deepest));
    lineEntry("not reached", shade(0));
  }

  void drawSleep() {
    std::map<BodyId, const Decision*> tested;
    for (const Decision& d : after_.decisions) tested[d.a] = &d;
    for (const auto& [id, d] : tested) {
      const BodyState* body = scene_.body(id);
      if (body == nullptr) continue;
      const Pixel at = scene_.view(body->x);
      if (d->verdict == "sleep") label("sleeps", at, theme().ink_soft);
      if (d->verdict == "wake") label("wakes", at, bad());
    }
    for (const auto& [id, d] : tested) {
      const BodyState* body = scene_.body(id);
      if (body == nullptr || d->verdict != "wait") continue;
      if (d->criterion == "disturbed")
        ring(scene_.view(body->x), 1.5F * radius(), bad(), scene_.px(2.4F));
      if (d->count > 0)
        label(fmt::format("{}/{}", std::min(d->count, d->needed), d->needed), scene_.view(body->x),
              good());
    }
    ringEntry("disturbed", bad());
    entry("2/3: steps at rest of those it takes", 0.0F, nullptr);
  }

  /// All but the strongest impulses are shorter than a body [m per N s].
  double impulseScale() const {
    std::vector<double> sizes;
    for (const Snapshot* s : {&before_, &after_}) {
      for (const ContactView& c : s->contacts) {
        const double size = std::hypot(c.lambda_n, c.lambda_t);
        if (size > 0.0) sizes.push_back(size);
      }
    }
    if (sizes.empty()) return 0.0;
    const auto strong =
        sizes.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(sizes.size() - 1));
    std::ranges::nth_element(sizes, strong);
    return 0.8 * scene_.looks.typical_width / *strong;
  }

  void drawImpulses(const Snapshot& of, Color color, float thicker) {
    for (const ContactView& c : of.contacts) {
      const Vec2 impulse = c.lambda_n * c.normal + c.lambda_t * perpendicular(c.normal);
      vector(c.x, impulseScale() * impulse, color, thicker);
    }
  }

  void drawSweep() {
    drawImpulses(before_, mix(theme().ink_soft, theme().background, 0.35), 2.2F);
    drawImpulses(after_, good(), 1.0F);
    arrowEntry("impulse before the sweep", mix(theme().ink_soft, theme().background, 0.35));
    arrowEntry("after it", good());
  }

  void drawUnmerge() {
    const auto meeting = meetings(before_);
    std::map<Pair, double> held;  // nearest to its limit
    std::set<Pair> cut;
    for (const Decision& d : after_.decisions) {
      const Pair pair = ordered(d.a, d.b);
      if (d.verdict == "unmerge" || d.verdict == "cut") cut.insert(pair);
      const double ratio =
          d.criterion == "broken" || d.threshold <= 0.0 ? 0.0 : d.value / d.threshold;
      held[pair] = std::max(held[pair], ratio);
    }
    for (const Event& e : after_.events) {
      if (e.type == EventType::Unmerge) cut.insert(ordered(e.a, e.b));
    }
    for (const WeldView& weld : before_.welds) {
      const Pair pair = ordered(weld.a, weld.b);
      const auto found = meeting.find(pair);
      if (found == meeting.end() || cut.contains(pair)) continue;
      const auto ratio = held.find(pair);
      link(pair, found->second, lineWidth(),
           ratio == held.end() ? theme().ink_soft : heat(std::min(ratio->second, 0.999)));
    }
    for (const Pair& pair : cut) {
      const auto found = meeting.find(pair);
      if (found == meeting.end()) continue;
      cross(scene_.view(found->second), 1.5F * radius(), bad());
    }
    for (const CollectionView& c : after_.collections) {
      label(fmt::format("C{}", value(c.id)), scene_.view(c.x), standingOut(scene_, c.id));
    }
    lineEntry("weld far from its limit", heat(0.0));
    lineEntry("near it", heat(0.999));
    crossEntry("cut", bad());
    entry("colours: what is one now", 0.0F, nullptr);
  }

  void drawSolution() {
    const float reach = std::clamp(0.45F * scene_.bodySize(), scene_.px(14.0F), scene_.px(60.0F));
    for (const ContactView& c : after_.contacts) {
      if (c.internal || c.lambda_n <= 0.0) continue;
      const double used = c.mu > 0.0 ? std::abs(c.lambda_t) / (c.mu * c.lambda_n) : 0.0;
      if (used >= 0.99) drawCone(c, reach);
    }
    for (const ContactView& c : after_.contacts) {
      if (c.internal) continue;
      const double used =
          c.lambda_n > 0.0 && c.mu > 0.0 ? std::abs(c.lambda_t) / (c.mu * c.lambda_n) : 0.0;
      const Vec2 impulse = c.lambda_n * c.normal + c.lambda_t * perpendicular(c.normal);
      const Color color = used >= 0.99 ? bad() : heat(std::min(used, 0.98));
      vector(c.x, impulseScale() * impulse, color);
      if (c.lambda_n <= 0.0) {
        cross(scene_.view(c.x), 0.6F * radius(), theme().ink_soft);
      } else {
        dot(scene_.view(c.x), 0.6F * radius(), color);
      }
    }
    for (const ContactView& c : after_.contacts) {
      if (c.internal) drawMergedMark(painter_, scene_, scene_.view(c.x), 0.6F * radius());
    }
    arrowEntry("impulse, well inside its cone", heat(0.0));
    arrowEntry("near the edge", heat(0.98));
    arrowEntry("on the edge, with the cone", bad());
    crossEntry("no force", theme().ink_soft);
    squareEntry("merged: not solved");
  }

  /// The cone of the contact's friction, on the side of b.
  void drawCone(const ContactView& c, float reach) {
    const Pixel at = scene_.view(c.x);
    const Vec2 t = perpendicular(c.normal);
    const Vec2 left = (c.normal + c.mu * t).normalized(),
               right = (c.normal - c.mu * t).normalized();
    const std::array<Pixel, 3> corners{at, at + View::direction(left) * reach,
                                       at + View::direction(right) * reach};
    painter_.polygon(corners, 0.0F, {.fill = withAlpha(bad(), 0.16)});
    for (const Vec2& side : {left, right}) {
      painter_.line(at, at + View::direction(side) * reach, scene_.px(1.2F), withAlpha(bad(), 0.7));
    }
  }

  void drawVelocities() {
    const double scale = velocityScale();
    const float apart = 3.0F * lineWidth();  // so that none hides another
    for (const BodyState& b : after_.bodies) {
      if (isFixed(scene_, b)) continue;
      const auto at = [&](const Snapshot& s) -> const BodyState* {
        const auto found = std::ranges::lower_bound(s.bodies, b.id, {}, &BodyState::id);
        return found != s.bodies.end() && found->id == b.id ? &*found : nullptr;
      };
      if (reference_ != nullptr) {
        if (const BodyState* r = at(*reference_))
          vector(b.x, scale * r->v, theme().lines[2], 1.0F, -apart);
      }
      if (const BodyState* old = at(before_))
        vector(b.x, scale * old->v, pale(theme().velocity), 1.0F, apart);
      vector(b.x, scale * b.v, theme().velocity);
    }
    if (reference_ != nullptr) arrowEntry("reference, nothing merged", theme().lines[2]);
    arrowEntry("velocity before", pale(theme().velocity));
    arrowEntry("velocity now", theme().velocity);
    entry(scaleText(scale, "m/s"), 0.0F, nullptr);
  }

  /// The fastest body gets an arrow of a sixth of the picture's height at least, so that slow
  /// scenes show something too.
  double velocityScale() const {
    double fastest = 0.0;
    for (const BodyState& b : after_.bodies) fastest = std::max(fastest, b.v.norm());
    const double wanted = double{scene_.view.panel.height} / 6.0 / scene_.view.scale;
    if (fastest <= 0.0) return scene_.style.velocity_scale;
    return std::max(scene_.style.velocity_scale,
                    std::min(wanted / fastest, 1e3 * scene_.style.velocity_scale));
  }

  /// "1 m/s is drawn 0.2 m long".
  static std::string scaleText(double scale, const char* unit) {
    return fmt::format("1 {} is drawn {} long", unit, lengthLabel(roundLength(scale)));
  }

  void drawCorners() {
    const double threshold = thresholdOf("relative-motion");
    const float one = scene_.px(26.0F);  // as long as the threshold
    std::map<Pair, std::tuple<int, int, std::string>> counts;
    for (const Decision& d : after_.decisions) {
      if (d.a != d.b) {
        auto& [count, needed, obstacle] = counts[ordered(d.a, d.b)];
        count = d.count;
        needed = d.needed;
        if (d.verdict == "apart" && obstacle.empty()) obstacle = obstacleName(d.criterion);
      }
    }
    for (const NotedCorners& corners : record_.notes.corners) {
      std::array<Pixel, 4> at;
      double fastest = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        at[i] = scene_.view(corners.at[i]);
        fastest = std::max(fastest, corners.velocity[i].norm());
      }
      const Color color = heat(threshold > 0.0 ? fastest / threshold : 0.0);
      for (std::size_t i = 0; i < 4; ++i) {
        painter_.line(at[i], at[(i + 1) % 4], scene_.px(1.2F), withAlpha(color, 0.5));
      }
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec2& v = corners.velocity[i];
        const double length = std::min(v.norm() / std::max(threshold, 1e-12), 3.0);
        if (length <= 0.05) {
          painter_.disc(at[i], scene_.px(1.8F), {.fill = color});
          continue;
        }
        const Vec2 way = v.normalized();
        arrowTo(at[i], at[i] + View::direction(way) * (one * static_cast<float>(length)),
                heat(v.norm() / std::max(threshold, 1e-12)));
      }
    }
    const auto meeting = meetings(after_);
    for (const auto& [pair, entry] : counts) {
      const auto& [count, needed, obstacle] = entry;
      const auto found = meeting.find(pair);
      if (found == meeting.end()) continue;
      label(fmt::format("{}/{}{}{}", count, needed, obstacle.empty() ? "" : " ", obstacle),
            scene_.view(found->second), obstacle.empty() ? good() : bad());
    }
    entry(fmt::format("as fast as the threshold, {} m/s", threshold), 26.0F,
          [this](Painter& p, Pixel left) {
            p.arrow(left, left + Pixel{scene_.px(26.0F), 0.0F},
                    {.color = heat(0.99), .width = scene_.px(2.4F)});
          });
    arrowEntry("above it (cut at 3 times)", bad());
    entry("1/3: steps passed of those it takes, and what failed", 0.0F, nullptr);
  }

  /// What keeps a pair apart, in a word or two.
  static std::string obstacleName(std::string_view criterion) {
    if (criterion == "pressed") return "no force";
    if (criterion == "edge") return "on edge";
    if (criterion == "sliding") return "slips";
    if (criterion == "breathing") return "breathes";
    return "moves";
  }

  double thresholdOf(std::string_view criterion) const {
    const auto found = std::ranges::find(after_.decisions, criterion, &Decision::criterion);
    return found == after_.decisions.end() ? 0.0 : found->threshold;
  }

  void drawWay() {
    double farthest = 0.0;
    const auto old = [&](BodyId id) -> const BodyState* {
      const auto found = std::ranges::lower_bound(before_.bodies, id, {}, &BodyState::id);
      return found != before_.bodies.end() && found->id == id ? &*found : nullptr;
    };
    for (const BodyState& b : after_.bodies) {
      if (const BodyState* o = old(b.id)) farthest = std::max(farthest, (b.x - o->x).norm());
    }
    const double longest = double{scene_.px(70.0F)} / scene_.view.scale;
    const double factor = farthest > 0.0 ? roundLength(std::max(1.0, longest / farthest)) : 1.0;
    for (const BodyState& b : after_.bodies) {
      const BodyState* o = old(b.id);
      if (o == nullptr || isFixed(scene_, b)) continue;
      dot(scene_.view(o->x), 0.5F * radius(), theme().ink_soft);
      vector(o->x, factor * (b.x - o->x), theme().velocity);
    }
    entry("before", 8.0F, [this](Painter& p, Pixel left) {
      p.disc(left + Pixel{scene_.px(4.0F), 0.0F}, scene_.px(4.0F), {.fill = theme().ink_soft});
    });
    arrowEntry(fmt::format("the way of this step, drawn {:.6g} times as long", factor),
               theme().velocity);
  }

  void drawMerge() {
    const auto meeting = meetings(after_);
    std::set<CollectionId> fresh;
    for (const Event& e : after_.events) {
      if (e.type == EventType::Merge) fresh.insert(e.collection);
    }
    for (const Decision& d : after_.decisions) {
      const Pair pair = ordered(d.a, d.b);
      const auto found = meeting.find(pair);
      if (found == meeting.end()) continue;
      if (d.verdict == "merge") link(pair, found->second, 1.6F * lineWidth(), good());
    }
    for (const CollectionView& c : after_.collections) {
      const bool now = fresh.contains(c.id);
      const Color color = now ? theme().box : pale(theme().box);
      const Pixel half{scene_.view(c.box.half.x()), scene_.view(c.box.half.y())};
      const Pixel axis = View::direction({c.box.frame.rotation.c, c.box.frame.rotation.s});
      painter_.box(scene_.view(c.box.frame.position), axis, half, scene_.px(3.0F),
                   {.outline = color, .line = scene_.px(now ? 2.4F : 1.4F)});
      const Pixel center = scene_.view(c.x);
      const float r = scene_.px(now ? 8.0F : 5.0F);
      ring(center, r, color, scene_.px(1.6F));
      painter_.line(center - Pixel{r, 0.0F}, center + Pixel{r, 0.0F}, scene_.px(1.4F), color);
      painter_.line(center - Pixel{0.0F, r}, center + Pixel{0.0F, r}, scene_.px(1.4F), color);
    }
    for (const CollectionView& c : after_.collections) {
      if (!fresh.contains(c.id)) continue;
      label(fmt::format("C{}: {} bodies, {:.3g} kg, {:.3g} kg m²", value(c.id), c.bodies.size(),
                        c.mass, c.inertia),
            scene_.view(c.x) + Pixel{0.0F, scene_.px(22.0F)}, theme().box);
    }
    for (const Decision& d : after_.decisions) {
      const auto found = meeting.find(ordered(d.a, d.b));
      if (found == meeting.end() || d.verdict != "wait") continue;
      label(d.criterion == "cycle" ? "pivot" : fmt::format("{}/{}", d.count, d.needed),
            scene_.view(found->second), theme().ink_soft);
    }
    lineEntry("merged now", good());
    entry("oriented box and centre of a collection", 13.0F, [this](Painter& p, Pixel left) {
      const float s = scene_.px(12.0F);
      p.box({left.x, left.y - 0.5F * s, s, s}, 0.0F,
            {.outline = theme().box, .line = scene_.px(1.6F)});
    });
    entry("2/3: still waiting", 0.0F, nullptr);
  }

  Painter& painter_;
  const FrameScene& scene_;
  const StepRecord& record_;
  Stage stage_;
  const Snapshot& after_;
  const Snapshot& before_;
  const Snapshot* reference_;
  std::vector<PendingLabel> pending_;
  std::vector<LegendEntry> legend_;
};

}  // namespace

void drawStage(Painter& painter, const FrameScene& scene, const StepRecord& record, Stage stage,
               const Snapshot* reference) {
  StageMarks(painter, scene, record, stage, reference).draw();
}

}  // namespace merge2d
