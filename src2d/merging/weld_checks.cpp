#include "src2d/merging/weld_checks.h"

#include <algorithm>

#include "src2d/merging/grip.h"
#include "src2d/merging/limits.h"
#include "src2d/merging/metric.h"

namespace merge2d {

void WeldTest::testAll() {
  std::swap(leant_, c_.leaning);
  c_.leaning.clear();
  // Sweeps have watched the contacts that they left at their limits.
  const std::size_t blocks = whole_ ? c_.blocks.size() : c_.active_blocks;
  for (std::uint32_t i = 0; i < blocks; ++i) {
    if (c_.watches[i].watched() || scratch_.notes) testContacts(i);
  }
  if (c_.pivots_stale) listPivots(state_, c_);
  still_ = least(Weld{}).most();
  for (const Pivot& pivot : c_.pivots) testPivot(pivot);
  testLeaning();
  if (isStruck()) testShaken();
  // A collection that may be about to split does not fall asleep.
  if (disturbed_) c_.refuted = false;
  if (growing_ && !c_.refuted && !confirming_) c_.settled = false;
}

void WeldTest::confirmAll() {
  confirming_ = whole_ = true;
  growing_ = false;
  for (const std::uint32_t weld : c_.cut_welds) c_.welds[weld].cut = false;
  c_.cut_welds.clear();
  testAll();
}

void WeldTest::testContacts(std::uint32_t b) {
  ContactBlock& k = c_.blocks[b];
  InternalContact& inner = c_.contacts[c_.block_contact[b]];
  const std::uint32_t weld = inner.weld;
  const Vec2 n = turn_ * Vec2(k.nx, k.ny);
  BlockWatch watch = c_.watches[b];
  bool watched = false;
  for (int i = 0; i < k.count; ++i) {
    PointWatch& point = inner.watch[static_cast<std::size_t>(i)];
    const bool pressed = !broken(k, i), edge = pressed && onEdge(k, i);
    const bool was_lost = point.lost, was_active = point.active;
    if (pressed && inner.since != kExpected) {
      point.active = true;
      k.bias[i] = 0.0;
      point.lost = false;
      point.opening = {};
    }
    const bool idle = !pressed && point.active && carriesNothing(weld);
    if (!edge && !idle) point.slip = {};
    if (scratch_.notes) {
      at_ = state_[c_.rigid].frame() * inner.point(i).position;
    }
    if (!pressed && point.active) leans(weld);
    if (edge || !pressed) {
      const auto& u = scratch_.sweep_u;
      const ContactVelocity w = contactVelocity(k, i, n.x(), n.y(), u[k.a], u[k.b]);
      if (!pressed && point.active) point.lost = testBroken(weld, point.opening, w.n);
      if (edge || idle) testSliding(weld, point.slip, w.t);
    }
    if (pressed && scratch_.notes) noteCone(weld, k, i, edge);
    if (point.active) watch.activate(i);
    watched |= edge || (!pressed && point.active);
    if (point.lost && !was_lost) {
      noteLoosened(weld);
      doubt(c_.welds[weld]);
    }
    if (was_lost != point.lost || was_active != point.active) updateGrip(state_, c_, weld);
  }
  watch.watch(watched);
  c_.watches[b] = watch;
}

bool WeldTest::carriesNothing(std::uint32_t w) const {
  const Weld& weld = c_.welds[w];
  if (weld.joints > 0) return false;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const ContactBlock& k = c_.blocks[c_.contacts[i].block];
    for (int p = 0; p < k.count; ++p) {
      if (!broken(k, p)) return false;
    }
  }
  return true;
}

void WeldTest::noteLoosened(std::uint32_t weld) {
  c_.stood.clear();
  const bool known = std::ranges::binary_search(c_.spare, weld) ||
                     std::ranges::find(c_.loosened, weld) != c_.loosened.end();
  if (!known) c_.loosened.push_back(weld);
}

WeldTest::Evidence WeldTest::weigh(Drift& drift, double w, double threshold) {
  return weigh(drift, w, threshold, residual_);
}

WeldTest::Evidence WeldTest::weigh(Drift& drift, double w, double threshold, double noise) {
  if (confirming_) {
    if (std::abs(w) < noise) w = 0.0;
    drift.sum = static_cast<float>(w * std::max(drift.steps, 1));
  } else {
    drift.sum += static_cast<float>(w);
    drift.steps += 1;
  }
  const double sum = std::abs(drift.sum);
  const Evidence found{sum, drift.steps, sum > threshold};
  growing_ |= !found.exceeds && std::abs(w) > noise;
  if (confirming_ && !found.exceeds) drift = {};
  return found;
}

bool WeldTest::testBroken(std::uint32_t weld, Drift& opening, double w_n) {
  const double threshold = openingThreshold() * caution(c_.welds[weld]);
  const Evidence found = weigh(opening, std::max(0.0, w_n), threshold);
  note(c_.welds[weld], [&] {
    return Decision{.criterion = "opening",
                    .equation = kOwnUnmerging,
                    .value = found.sum,
                    .threshold = threshold,
                    .count = found.steps,
                    .verdict = found.exceeds ? "lost" : "wait",
                    .at = at_,
                    .caution = caution(c_.welds[weld])};
  });
  return found.exceeds;
}

void WeldTest::testLost(std::uint32_t weld) {
  const bool lost = c_.welds[weld].grip == Grip::Lost;
  if (lost) cutWeld(c_.welds[weld], EventReason::Broken);
  note(c_.welds[weld], [&] {
    return Decision{.criterion = "broken",
                    .equation = "Section 6.3",
                    .value = static_cast<double>(activeContacts(c_, c_.welds[weld])),
                    .threshold = 1.0,
                    .verdict = lost ? "unmerge" : "keep"};
  });
}

double WeldTest::openingThreshold() const {
  constexpr double kBeyondResidual = 5.0;
  const double sliding = state_.settings.unmerging.sliding;
  return disturbed_ ? std::min(sliding, kBeyondResidual * noise()) : sliding;
}

void WeldTest::testSliding(std::uint32_t weld, Drift& slip, double w_t) {
  const double threshold = state_.settings.unmerging.sliding * caution(c_.welds[weld]);
  const Evidence found = weigh(slip, w_t, threshold);
  note(c_.welds[weld], [&] {
    return Decision{.criterion = "sliding",
                    .equation = kOwnUnmerging,
                    .value = found.sum,
                    .threshold = threshold,
                    .count = found.steps,
                    .verdict = found.exceeds ? "unmerge" : "wait",
                    .at = at_,
                    .caution = caution(c_.welds[weld])};
  });
  if (found.exceeds) cutWeld(c_.welds[weld], EventReason::Sliding);
}

void WeldTest::noteCone(std::uint32_t weld, const ContactBlock& k, int i, bool edge) {
  note(c_.welds[weld], [&] {
    return Decision{.criterion = "cone",
                    .equation = "(20)",
                    .value = std::abs(k.lambda_t(i)),
                    .threshold = k.mu * k.lambda_n(i),
                    .verdict = edge ? "edge" : "keep",
                    .at = at_};
  });
}

void WeldTest::testMotion(Weld& weld) {
  if (weld.cut) return;
  const UnmergingSettings& settings = state_.settings.unmerging;
  const Drift before = weld.turning;
  const Least limits = least(weld);
  const Turning now = relativeMotion(weld, limits);
  const bool cut = turns(weld, now, limits);
  note(weld, [&] {
    return Decision{.criterion = "relative-motion",
                    .equation = kOwnUnmerging,
                    .value = std::abs(weld.turning.sum),
                    .threshold = settings.velocity * caution(weld),
                    .count = weld.turning.steps,
                    .verdict = cut                      ? "unmerge"
                               : weld.turning.steps > 0 ? "wait"
                                                        : "keep",
                    .before = before.steps,
                    .caution = caution(weld)};
  });
  if (cut) cutWeld(weld, EventReason::RelativeMotion);
}

void WeldTest::testPivot(const Pivot& pivot) {
  const bool lost = c_.welds[pivot.weld].grip == Grip::Lost;
  if (lost || scratch_.notes) testLost(pivot.weld);
  if (staysPut(pivot)) {
    c_.welds[pivot.weld].turning = {};
  } else {
    testMotion(c_.welds[pivot.weld]);
  }
}

bool WeldTest::staysPut(const Pivot& pivot) const {
  const Weld& weld = c_.welds[pivot.weld];
  if (scratch_.notes || weld.cut) return false;
  const double speed = fastestBound(weld, pivot);
  if (!weld.bridge && speed <= still_) return true;  // caution only raises it
  const double limit = least(weld).most();
  return speed <= limit || closerBound(weld, pivot) <= limit;
}

void WeldTest::leans(std::uint32_t weld) {
  if (!c_.welds[weld].bridge) return;
  if (std::ranges::find(c_.leaning, weld) == c_.leaning.end()) c_.leaning.push_back(weld);
}

void WeldTest::testLeaning() {
  for (const std::uint32_t weld : leant_) {
    const bool still = std::ranges::find(c_.leaning, weld) != c_.leaning.end();
    if (!still && !isPivot(c_.welds[weld].grip)) c_.welds[weld].turning = {};
  }
  for (const std::uint32_t weld : c_.leaning) {
    if (!isPivot(c_.welds[weld].grip)) testMotion(c_.welds[weld]);
  }
}

bool WeldTest::turns(Weld& weld, const Turning& now, const Least& least) {
  const UnmergingSettings& settings = state_.settings.unmerging;
  if (now.nearest <= least.noise || std::abs(now.fastest) <= least.slow) {
    weld.turning = {};
    return false;
  }
  const double enough = tipsFor(weld) ? 0.0 : settings.velocity * caution(weld);
  const bool at_once = isStruck() || (mustTip(weld) && c_.struck > 0);  // as the blow is over
  const int steps = at_once ? 1 : settings.steps;
  const bool exceeds = weigh(weld.turning, now.fastest, enough, least.noise).exceeds;
  const bool cut = exceeds && weld.turning.steps >= steps;
  growing_ |= exceeds && !cut;
  return cut;
}

bool WeldTest::tipsFor(const Weld& weld) const {
  constexpr int kSure = 10;  // steps
  return mustTip(weld) && (c_.stirred > 0 || weld.turning.steps + 1 >= kSure);
}

bool WeldTest::mustTip(const Weld& weld) const {
  const auto frame = static_cast<std::uint32_t>(c_.members.size());
  const bool on_frame = weld.node_a == frame || weld.node_b == frame;
  return (on_frame || c_.stirred > 0) && weld.bridge && weld.vain == 0;
}

double WeldTest::noiseAt(const Weld& weld) const {
  constexpr double kFaint = 1e-5, kBeyondResidual = 1e2;
  if (!mustTip(weld)) return noise();
  const double faint =
      std::max(kFaint * state_.h * state_.gravity.norm(), kBeyondResidual * c_.residual);
  return std::min(faint, noise());
}

double WeldTest::slowFor(const Weld& weld) const {
  return weld.bridge ? 0.0 : 0.1 * state_.settings.unmerging.velocity * caution(weld);
}

bool WeldTest::slowerThan(double limit, const Weld& weld, const VelocityField& a,
                          const VelocityField& b) const {
  double radius = 0.0;  // of the two boxes, about the centre of one of them
  for (const BodyId id : {weld.a, weld.b}) {
    if (state_[id].rigid != c_.rigid) continue;
    const OrientedBox& box = state_.extent(rigidOf(id)).box;
    radius = std::max(radius, box.frame.position.norm() + box.half.norm());
  }
  const double between = (b.x - a.x).norm();
  const double linear = (b.v - a.at(b.x)).norm();
  return linear + std::abs(b.omega - a.omega) * (radius + between) <= limit;
}

double WeldTest::fastestBound(const Weld& weld, const Pivot& pivot) const {
  const SolverVelocity &a = velocity(weld.a), &b = velocity(weld.b);
  const double linear = std::abs(b.vx - a.vx) + std::abs(b.vy - a.vy);
  return linear + (std::abs(a.omega) + std::abs(b.omega - a.omega)) * pivot.reach;
}

double WeldTest::closerBound(const Weld& weld, const Pivot& pivot) const {
  const SolverVelocity &a = velocity(weld.a), &b = velocity(weld.b);
  const Vec2 linear = Vec2(b.vx - a.vx, b.vy - a.vy) - cross(b.omega, between(weld));
  return linear.norm() + std::abs(b.omega - a.omega) * pivot.reach;
}

Vec2 WeldTest::between(const Weld& weld) const {
  const bool both = state_[weld.a].rigid == c_.rigid && state_[weld.b].rigid == c_.rigid;
  if (both) return turn_ * (state_[weld.b].local - state_[weld.a].local);
  return state_.pose(weld.b).position - state_.pose(weld.a).position;
}

WeldTest::Turning WeldTest::relativeMotion(const Weld& weld, const Least& least) const {
  // Seen from the first body, so that it does not matter where in the world they are.
  const auto field = [&](BodyId b, const Vec2& at) {
    const SolverVelocity& u = velocity(b);
    return VelocityField{at, {u.vx, u.vy}, u.omega};
  };
  const VelocityField a = field(weld.a, Vec2::Zero()), b = field(weld.b, between(weld));
  Turning motion;
  if (!scratch_.notes && slowerThan(least.most(), weld, a, b)) return motion;
  const Vec2 origin = state_.pose(weld.a).position;
  for (const BodyId id : {weld.a, weld.b}) {
    if (state_[id].rigid != c_.rigid) continue;  // only the box of the body that can move
    OrientedBox box = state_.extent(rigidOf(id)).box;
    const Pose pose = state_.pose(id);
    box.frame = Pose{pose.position - origin, pose.rotation} * box.frame;
    const double fastest = fastestCorner(box, a, b);
    motion.nearest = motion.fastest == 0.0 ? fastest : std::min(motion.nearest, fastest);
    motion.fastest = std::max(motion.fastest, fastest);
  }
  motion.fastest = std::copysign(motion.fastest, b.omega - a.omega);
  return motion;
}

void WeldTest::writeDown(const Weld& weld, Decision test) const {
  test.a = weld.a;
  test.b = weld.b;
  test.stage = "Unmerge";
  scratch_.notes->decisions.push_back(test);
}

double WeldTest::noise() const { return std::max<double>(residual_, c_.residual); }

void WeldTest::doubt(const Weld& weld) {
  for (const BodyId b : {weld.a, weld.b}) scratch_.doubted.push_back(static_cast<std::uint32_t>(b));
}

void WeldTest::cutWeld(Weld& weld, EventReason reason) {
  if (weld.cut) return;
  doubt(weld);
  weld.cut = true;
  weld.reason = reason;
  c_.cut_welds.push_back(static_cast<std::uint32_t>(&weld - c_.welds.data()));
}

}  // namespace merge2d
