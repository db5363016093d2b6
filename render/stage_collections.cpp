/// Bodies that fall asleep, welds that are cut, and pairs that merge.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "render/stage_sheet.h"

namespace merge2d {
namespace {

/// The pairs that this stage takes apart.
std::set<BodyPair> pairsCut(const Snapshot& after) {
  std::set<BodyPair> cut;
  for (const Decision& d : after.decisions) {
    if (d.verdict == "unmerge" || d.verdict == "cut") cut.insert(ordered(d.a, d.b));
  }
  for (const Event& e : after.events) {
    if (e.type == EventType::Unmerge) cut.insert(ordered(e.a, e.b));
  }
  return cut;
}

/// How near each tested weld is to its limit, as a part of it.
std::map<BodyPair, double> strainOf(const Snapshot& after) {
  std::map<BodyPair, double> strain;
  for (const Decision& d : after.decisions) {
    const bool measured = d.criterion != "broken" && d.threshold > 0.0;
    double& worst = strain[ordered(d.a, d.b)];
    worst = std::max(worst, measured ? d.value / d.threshold : 0.0);
  }
  return strain;
}

/// Oriented box and centre of mass; `now`: in this step.
void drawCollection(StageSheet& s, const CollectionView& c, bool now) {
  const Theme& theme = s.pens.theme();
  const Color color = now ? theme.box : s.pens.pale(theme.box);
  const Pixel half{s.scene.view(c.box.half.x()), s.scene.view(c.box.half.y())};
  const Pixel axis = View::direction({c.box.frame.rotation.c, c.box.frame.rotation.s});
  s.painter.box(s.scene.view(c.box.frame.position), axis, half, s.scene.px(3.0F),
                {.outline = color, .line = s.scene.px(now ? 2.4F : 1.4F)});
  const Pixel center = s.scene.view(c.x);
  const float r = s.scene.px(now ? 8.0F : 5.0F);
  s.pens.ring(center, r, color, s.scene.px(1.6F));
  s.painter.line(center - Pixel{r, 0.0F}, center + Pixel{r, 0.0F}, s.scene.px(1.4F), color);
  s.painter.line(center - Pixel{0.0F, r}, center + Pixel{0.0F, r}, s.scene.px(1.4F), color);
}

/// New marks have their numbers beside them.
void drawCollections(StageSheet& s) {
  std::set<CollectionId> fresh;
  for (const Event& e : s.after.events) {
    if (e.type == EventType::Merge) fresh.insert(e.collection);
  }
  for (const CollectionView& c : s.after.collections) drawCollection(s, c, fresh.contains(c.id));
  for (const CollectionView& c : s.after.collections) {
    if (!fresh.contains(c.id)) continue;
    s.pens.label(fmt::format("C{}: {} bodies, {:.3g} kg, {:.3g} kg m²", value(c.id),
                             c.bodies.size(), c.mass, c.inertia),
                 s.scene.view(c.x) + Pixel{0.0F, s.scene.px(22.0F)}, s.pens.theme().box);
  }
}

}  // namespace

void drawSleep(StageSheet& s) {
  StagePens& pens = s.pens;
  std::map<BodyId, const Decision*> tested;
  for (const Decision& d : s.after.decisions) tested[d.a] = &d;
  for (const auto& [id, d] : tested) {
    const BodyState* body = s.scene.body(id);
    if (body == nullptr) continue;
    const Pixel at = s.scene.view(body->x);
    if (d->verdict == "sleep") pens.label("sleeps", at, pens.soft());
    if (d->verdict == "wake") pens.label("wakes", at, pens.bad());
  }
  for (const auto& [id, d] : tested) {
    const BodyState* body = s.scene.body(id);
    if (body == nullptr || d->verdict != "wait") continue;
    const Pixel at = s.scene.view(body->x);
    if (d->criterion == "disturbed") {
      pens.ring(at, 1.5F * pens.radius(), pens.bad(), s.scene.px(2.4F));
    }
    if (d->count > 0) {
      pens.label(fmt::format("{}/{}", std::min(d->count, d->needed), d->needed), at, pens.good());
    }
  }
  s.legend.ring("disturbed", pens.bad());
  s.legend.words("2/3: steps at rest of those it takes");
}

void drawUnmerge(StageSheet& s) {
  StagePens& pens = s.pens;
  const auto meeting = meetings(s.before);
  const std::set<BodyPair> cut = pairsCut(s.after);
  const std::map<BodyPair, double> strain = strainOf(s.after);
  bool untested = false;
  for (const WeldView& weld : s.before.welds) {
    const BodyPair pair = ordered(weld.a, weld.b);
    const auto found = meeting.find(pair);
    if (found == meeting.end() || cut.contains(pair)) continue;
    const auto at = strain.find(pair);
    untested = untested || at == strain.end();
    pens.link(pair, found->second, pens.lineWidth(),
              at == strain.end() ? pens.soft() : pens.heat(std::min(at->second, 0.999)));
  }
  for (const BodyPair& pair : cut) {
    const auto found = meeting.find(pair);
    if (found == meeting.end()) continue;
    pens.cross(s.scene.view(found->second), 1.5F * pens.radius(), pens.bad());
  }
  for (const CollectionView& c : s.after.collections) {
    pens.label(fmt::format("C{}", value(c.id)), s.scene.view(c.x), standingOut(s.scene, c.id));
  }
  s.legend.line("weld far from its limit", pens.heat(0.0));
  s.legend.line("near it", pens.heat(0.999));
  s.legend.cross("cut", pens.bad());
  if (untested) s.legend.line("asleep: not tested", pens.soft());
  s.legend.words("one colour: one collection");
}

/// The reason that a pair does not merge, in a word or two.
std::string waitingName(const Decision& d) {
  if (d.criterion == "frames") return "two frames";
  if (d.criterion == "cycle" || d.criterion == "freedoms") return "pivot";
  return fmt::format("{}/{}", d.count, d.needed);
}

void drawMerge(StageSheet& s) {
  StagePens& pens = s.pens;
  const auto meeting = meetings(s.after);
  std::map<BodyPair, std::vector<Decision>> tests;
  for (const Decision& d : s.after.decisions) {
    const BodyPair pair = ordered(d.a, d.b);
    if (d.stage == "Merge" && meeting.contains(pair)) tests[pair].push_back(d);
  }
  for (const auto& [pair, of_pair] : tests) {
    if (!endInMerge(of_pair)) continue;
    pens.link(pair, meeting.at(pair), 1.6F * pens.lineWidth(), pens.good());
  }
  drawCollections(s);
  for (const auto& [pair, of_pair] : tests) {
    if (endInMerge(of_pair)) continue;
    pens.label(waitingName(of_pair.back()), s.scene.view(meeting.at(pair)), pens.soft());
  }
  s.legend.line("merged now", pens.good());
  s.legend.sample("oriented box and centre of a collection", 13.0F, [&s](Painter& p, Pixel left) {
    const float side = s.scene.px(12.0F);
    p.box({left.x, left.y - 0.5F * side, side, side}, 0.0F,
          {.outline = s.pens.theme().box, .line = s.scene.px(1.6F)});
  });
  s.legend.words("2/3: still waiting");
}

}  // namespace merge2d
