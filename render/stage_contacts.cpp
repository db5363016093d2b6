/// Contacts found and pruned, and the order in which they are swept.

#include <fmt/format.h>

#include <algorithm>

#include "render/stage_sheet.h"

namespace merge2d {
namespace {

/// The sweep's order as a picture: which visit comes first at each pair, and its shade.
class OrderPicture {
 public:
  OrderPicture(StageSheet& sheet)
      : s_(sheet), order_(sheet.record.notes.order), meeting_(meetings(sheet.after)) {
    for (const NotedVisit& v : order_) deepest_ = std::max(deepest_, v.depth);
  }

  int deepest() const { return deepest_; }
  Color shade(int depth) const {
    if (depth == 0) return s_.pens.soft();
    const double t = static_cast<double>(depth - 1) / std::max(1, deepest_ - 1);
    return mix(s_.pens.bad(), s_.pens.pale(s_.pens.good()), t);
  }

  void drawLinks() {
    for (std::size_t i = order_.size(); i-- > 0;) {
      const BodyPair pair = ordered(order_[i].a, order_[i].b);
      first_[pair] = i;
      const auto found = meeting_.find(pair);
      if (found == meeting_.end()) continue;
      s_.pens.link(pair, found->second, s_.pens.lineWidth(), shade(order_[i].depth));
    }
  }

  void drawSeeds() {
    for (const BodyId seed : s_.record.notes.seeds) {
      const BodyState* body = s_.scene.body(seed);
      if (body != nullptr && !isFixed(s_.scene, *body)) {
        s_.pens.ring(s_.scene.view(body->x), 1.6F * s_.pens.radius(), s_.pens.bad(),
                     s_.scene.px(2.4F));
      }
    }
  }

  void drawNumbers() {
    std::vector<std::pair<std::size_t, Vec2>> numbers;
    for (const auto& [pair, i] : first_) {
      if (const auto found = meeting_.find(pair); found != meeting_.end()) {
        numbers.emplace_back(i, found->second);
      }
    }
    std::ranges::sort(numbers, {}, &std::pair<std::size_t, Vec2>::first);
    for (const auto& [i, x] : numbers) {
      s_.pens.label(fmt::format("{}", i + 1), s_.scene.view(x), shade(order_[i].depth));
    }
  }

  /// Nothing is new: the contacts as they are.
  void drawStored() {
    for (const auto& [pair, x] : meeting_) {
      s_.pens.dot(s_.scene.view(x), 0.7F * s_.pens.radius(), s_.pens.soft());
    }
    s_.legend.dot("stored order: nothing new", s_.pens.soft());
  }

 private:
  StageSheet& s_;
  const std::vector<NotedVisit>& order_;
  std::map<BodyPair, Vec2> meeting_;
  std::map<BodyPair, std::size_t> first_;  ///< visit of a pair
  int deepest_ = 1;
};

}  // namespace

std::map<BodyPair, Vec2> meetings(const Snapshot& snapshot) {
  std::map<BodyPair, std::pair<Vec2, int>> sums;
  for (const ContactView& c : snapshot.contacts) {
    auto& [sum, count] = sums.try_emplace(ordered(c.a, c.b), Vec2::Zero(), 0).first->second;
    sum += c.x;
    ++count;
  }
  std::map<BodyPair, Vec2> means;
  for (const auto& [pair, entry] : sums) means[pair] = entry.first / entry.second;
  return means;
}

void drawContactsFound(StageSheet& s) {
  StagePens& pens = s.pens;
  const Color fresh = pens.theme().lines[2];
  for (const ContactView& c : s.after.contacts) {
    const Pixel at = s.scene.view(c.x);
    if (c.internal) {
      drawMergedMark(s.painter, s.scene, at, 0.8F * pens.radius());
      continue;
    }
    const Color color = c.fresh ? fresh : pens.good();
    const Pixel up = View::direction(c.normal) * (3.2F * pens.radius());
    s.painter.line(at, at + up, s.scene.px(1.6F), color);
    pens.ring(at, c.fresh ? 1.25F * pens.radius() : pens.radius(), color,
              std::max(1.0F, 0.4F * pens.radius()));
  }
  for (const NotedPoint& p : s.record.notes.pruned) {
    pens.cross(s.scene.view(p.x), 0.8F * pens.radius(), pens.soft());
  }
  s.legend.ring("new or without force so far", fresh);
  s.legend.ring("kept from the last step", pens.good());
  s.legend.mergedMark("inside a collection: not looked for");
  s.legend.cross("found, but pruned", pens.soft());
}

void drawSweepOrder(StageSheet& s) {
  OrderPicture picture(s);
  picture.drawLinks();
  picture.drawSeeds();
  picture.drawNumbers();
  if (s.record.notes.order.empty()) {
    picture.drawStored();
    return;
  }
  s.legend.ring("new here: the walk starts", s.pens.bad());
  s.legend.line("first", picture.shade(1));
  if (picture.deepest() > 1) s.legend.line("last", picture.shade(picture.deepest()));
  s.legend.line("not reached", picture.shade(0));
}

}  // namespace merge2d
