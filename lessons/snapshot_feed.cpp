#include "lessons/snapshot_feed.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src2d/core/trig.h"

namespace merge2d {
namespace {

/// Adds a sample to the spans of a track.
void extend(std::vector<Span>& spans, std::int64_t sample) {
  if (spans.empty() || spans.back().first + spans.back().count != sample) {
    spans.push_back({sample, 0});
  }
  ++spans.back().count;
}

bool holdsSample(const std::vector<Span>& spans, std::int64_t sample) {
  return !spans.empty() && spans.back().first + spans.back().count == sample + 1;
}

/// Of a body that is there.
Pose poseOf(const Snapshot& seen, BodyId body) {
  return std::ranges::lower_bound(seen.bodies, body, {}, &BodyState::id)->pose();
}

/// The criteria that compare a measured number with a limit: what charts and questions are about.
constexpr std::array<std::string_view, 5> kCharted = {"motion", "relative-motion", "sliding",
                                                      "breathing", "rest"};

/// Whether a verdict keeps a pair apart, or takes it apart.
bool parts(std::string_view verdict) {
  for (const std::string_view bad : {"apart", "unmerge", "cut", "awake"}) {
    if (verdict == bad) return true;
  }
  return false;
}

}  // namespace

SnapshotFeed::SnapshotFeed(Recording& out) : out_(out) {
  out_.tracks.resize(out_.bodies.size());
  if (out_.every > 1) keyframes_.emplace(out);
}

void SnapshotFeed::add(const Snapshot& seen) {
  addBodies(seen);
  if (out_.detail == Detail::Full && seen.step % out_.every == 0) {
    addContacts(seen);
    for (const Decision& decision : seen.decisions) addDecision(seen.step, decision);
  }
  for (const Event& event : seen.events) out_.events.push_back({seen.step, event});
  out_.stats.push_back(seen.stats);
  out_.stats.back().seconds = {};
  for (const auto& [id, slot] : colors_.update(seen)) {
    if (!out_.colors.empty() && id <= out_.colors.back().id) continue;
    out_.colors.push_back({id, slot});
  }
}

void SnapshotFeed::addBodies(const Snapshot& seen) {
  for (const BodyState& b : seen.bodies) {
    if (keyframes_) {
      keyframes_->add(seen.step, b);
      continue;
    }
    BodyTrack& track = out_.tracks[index(b.id)];
    if (track.x.empty()) track.first = seen.step;
    track.append(b);
  }
}

void SnapshotFeed::finish() {
  if (keyframes_) keyframes_->finish();
}

void SnapshotFeed::addContacts(const Snapshot& seen) {
  const std::int64_t sample = seen.step / out_.every;
  for (const ContactView& c : seen.contacts) {
    ContactTrack& track = contactTrack(c);
    if (holdsSample(track.spans, sample)) continue;
    extend(track.spans, sample);
    const Pose frame = poseOf(seen, c.a);
    const Vec2 at = frame.inverse() * c.x;
    const Vec2 normal = frame.rotation.inverse() * c.normal;
    track.x.push_back(static_cast<float>(at.x()));
    track.y.push_back(static_cast<float>(at.y()));
    track.normal.push_back(static_cast<float>(arcTangent(normal.y(), normal.x())));
    track.gap.push_back(static_cast<float>(c.gap));
    track.lambda_n.push_back(static_cast<float>(c.lambda_n));
    track.lambda_t.push_back(static_cast<float>(c.lambda_t));
    track.w_n.push_back(static_cast<float>(c.w_n));
    track.w_t.push_back(static_cast<float>(c.w_t));
    track.state.push_back(static_cast<std::uint8_t>(c.state));
    track.internal.push_back(c.internal ? 1 : 0);
    track.fresh.push_back(c.fresh ? 1 : 0);
  }
}

ContactTrack& SnapshotFeed::contactTrack(const ContactView& c) {
  const auto key = std::tuple{index(c.a), index(c.b), c.feature};
  const auto [at, added] = contact_of_.try_emplace(key, out_.contacts.size());
  if (added) {
    out_.contacts.push_back({.a = c.a, .b = c.b, .feature = c.feature, .mu = c.mu});
  }
  return out_.contacts[at->second];
}

/// The edge of the cone moves with the force: friction is kept as its part of what it may be.
void SnapshotFeed::addDecision(std::int64_t step, Decision d) {
  if (std::find(kCharted.begin(), kCharted.end(), d.criterion) == kCharted.end()) return;
  if (d.criterion == "cone") {
    d.value = d.threshold > 0.0 ? std::abs(d.value) / d.threshold : 0.0;
    d.threshold = 1.0;
  }
  const auto key =
      std::tuple{index(d.a), index(d.b), std::string(d.stage), std::string(d.criterion)};
  const auto [at, added] = decision_of_.try_emplace(key, out_.decisions.size());
  if (added) {
    out_.decisions.push_back({.a = d.a,
                              .b = d.b,
                              .stage = std::string(d.stage),
                              .criterion = std::string(d.criterion),
                              .equation = std::string(d.equation),
                              .threshold = d.threshold,
                              .needed = d.needed});
  }
  DecisionTrack& track = out_.decisions[at->second];
  const auto number = static_cast<float>(d.value);
  const auto count = static_cast<std::uint8_t>(std::clamp(d.count, 0, 255));
  const std::uint8_t passed = parts(d.verdict) ? 0 : 1;
  if (const std::int64_t sample = step / out_.every; !holdsSample(track.spans, sample)) {
    extend(track.spans, sample);
    track.value.push_back(number);
    track.count.push_back(count);
    track.passed.push_back(passed);
  } else if (std::abs(number) > std::abs(track.value.back())) {
    track.value.back() = number;
    track.count.back() = count;
    track.passed.back() = passed;
  }
}

}  // namespace merge2d
