/// The relative velocity at the corners of the oriented boxes, against the threshold.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "render/stage_sheet.h"

namespace merge2d {
namespace {

/// How far a pair has come.
struct Progress {
  int count = 0, needed = 0;
  std::string obstacle;  ///< what keeps it apart; empty when nothing does
};

/// The reason that keeps a pair apart, in a word or two.
std::string obstacleName(std::string_view criterion) {
  if (criterion == "pressed") return "no force";
  if (criterion == "edge") return "on edge";
  if (criterion == "sliding") return "slips";
  if (criterion == "breathing") return "breathes";
  if (criterion == "frames") return "two frames";
  return "moves";
}

double thresholdOf(const Snapshot& of, std::string_view criterion) {
  const auto found = std::ranges::find(of.decisions, criterion, &Decision::criterion);
  return found == of.decisions.end() ? 0.0 : found->threshold;
}

std::map<BodyPair, Progress> progressOf(const Snapshot& of) {
  std::map<BodyPair, Progress> out;
  for (const Decision& d : of.decisions) {
    if (d.a == d.b) continue;
    Progress& p = out[ordered(d.a, d.b)];
    p.count = d.count;
    p.needed = d.needed;
    if (d.verdict == "apart" && p.obstacle.empty()) p.obstacle = obstacleName(d.criterion);
  }
  return out;
}

constexpr float kOne = 26.0F;  ///< an arrow as fast as the threshold [design px]

void drawBox(StageSheet& s, const NotedCorners& corners, double threshold) {
  std::array<Pixel, 4> at;
  double fastest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    at[i] = s.scene.view(corners.at[i]);
    fastest = std::max(fastest, corners.velocity[i].norm());
  }
  const Color color = s.pens.heat(threshold > 0.0 ? fastest / threshold : 0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    s.painter.line(at[i], at[(i + 1) % 4], s.scene.px(1.2F), withAlpha(color, 0.5));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2& v = corners.velocity[i];
    const double ratio = v.norm() / std::max(threshold, 1e-12), length = std::min(ratio, 3.0);
    if (length <= 0.05) {
      s.painter.disc(at[i], s.scene.px(1.8F), {.fill = color});
      continue;
    }
    const Pixel way = View::direction(v.normalized());
    s.pens.arrow(at[i], at[i] + way * (s.scene.px(kOne) * static_cast<float>(length)),
                 s.pens.heat(ratio));
  }
}

}  // namespace

void drawCorners(StageSheet& s) {
  const double threshold = thresholdOf(s.after, "relative-motion");
  for (const NotedCorners& corners : s.record.notes.corners) drawBox(s, corners, threshold);
  const auto meeting = meetings(s.after);
  for (const auto& [pair, p] : progressOf(s.after)) {
    const auto found = meeting.find(pair);
    if (found == meeting.end()) continue;
    const bool apart = !p.obstacle.empty();
    s.pens.label(fmt::format("{}/{}{}{}", p.count, p.needed, apart ? " " : "", p.obstacle),
                 s.scene.view(found->second), apart ? s.pens.bad() : s.pens.good());
  }
  s.legend.arrow(fmt::format("as fast as the threshold, {} m/s", threshold), s.pens.heat(0.99),
                 kOne);
  s.legend.arrow("above it (cut at 3 times)", s.pens.bad());
  s.legend.words("1/3: steps passed of those it takes, and what failed");
}

}  // namespace merge2d
