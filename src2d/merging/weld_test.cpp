#include "src2d/merging/weld_test.h"

#include <algorithm>

#include "src2d/merging/metric.h"
#include "src2d/merging/sweep.h"
#include "src2d/merging/unmerge.h"

namespace merge2d {
namespace {

/// A tangential impulse this near to its limit is on the edge of the cone, Eq. (20).
constexpr double kOnEdge = 1.0 - 1e-9;

bool broken(const ContactBlock& k, int i) { return k.lambda_n(i) <= 0.0 && !k.bilateral; }
bool onEdge(const ContactBlock& k, int i) {
  return !k.bilateral && std::abs(k.lambda_t(i)) >= kOnEdge * k.mu * k.lambda_n(i);
}

bool atLimit(const ContactBlock& k) {
  for (int i = 0; i < k.count; ++i) {
    if (broken(k, i) || onEdge(k, i)) return true;
  }
  return false;
}

}  // namespace

void WeldTest::testAll() {
  const std::size_t blocks = whole_ ? c_.blocks.size() : c_.active_blocks;
  for (std::uint32_t i = 0; i < blocks; ++i) {
    if (c_.watched[i] || scratch_.notes || atLimit(c_.blocks[i])) testContacts(i);
  }
  if (c_.pivots_stale) listPivots(c_);
  for (const std::uint32_t pivot : c_.pivots) {
    testLost(c_.welds[pivot]);
    testMotion(c_.welds[pivot]);
  }
  // What may be about to part does not fall asleep.
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
  const std::uint32_t weld = c_.block_weld[b];
  c_.watched[b] = 0;
  for (int i = 0; i < k.count; ++i) {
    InternalPoint& point = inner.point(i);
    const bool pressed = !broken(k, i), edge = pressed && onEdge(k, i);
    const bool was_lost = point.lost, was_active = point.active;
    if (pressed) {
      point.active = true;
      k.bias[i] = 0.0;
      point.lost = false;
      point.opening = {};
    }
    if (!edge) point.slip = {};
    if (scratch_.notes) {
      at_ = state_[c_.rigid].frame() * point.position;
    }
    if (edge || !pressed) {
      const ContactVelocity w = velocityAt(k, i);
      if (!pressed && point.active) point.lost = testBroken(weld, point.opening, w.n);
      if (edge) testSliding(weld, point.slip, w.t);
    }
    if (pressed) noteCone(weld, k, i, edge);
    c_.watched[b] |= edge || !pressed;
    opened_ |= point.lost && !was_lost;
    c_.pivots_stale |= was_lost != point.lost || was_active != point.active;
  }
}

ContactVelocity WeldTest::velocityAt(const ContactBlock& k, int i) const {
  const double nx = turn_.c * k.nx - turn_.s * k.ny, ny = turn_.s * k.nx + turn_.c * k.ny;
  return contactVelocity(k, i, nx, ny, scratch_.sweep_u[k.a], scratch_.sweep_u[k.b]);
}

WeldTest::Evidence WeldTest::weigh(Drift& drift, double w, double threshold) {
  if (confirming_) {
    if (std::abs(w) < residualVelocity(state_)) w = 0.0;
    drift.sum = static_cast<float>(w * std::max(drift.steps, 1));
  } else {
    drift.sum += static_cast<float>(w);
    drift.steps += 1;
  }
  const double sum = std::abs(drift.sum);
  const Evidence found{sum, drift.steps, sum > threshold};
  growing_ |= !found.exceeds && std::abs(w) > residualVelocity(state_);
  if (confirming_ && !found.exceeds) drift = {};
  return found;
}

bool WeldTest::testBroken(std::uint32_t weld, Drift& opening, double w_n) {
  const bool literal = rule() == Rule::Paper;
  const double threshold = literal ? 0.0 : openingThreshold();
  const Evidence found = weigh(opening, std::max(0.0, w_n), threshold);
  const bool lost = found.exceeds || literal;
  note(c_.welds[weld], {.criterion = "opening",
                        .equation = "Section 6.3",
                        .value = found.sum,
                        .threshold = threshold,
                        .count = found.steps,
                        .verdict = !lost     ? "wait"
                                   : literal ? "unmerge"
                                             : "lost",
                        .at = at_});
  if (lost && literal) cutWeld(c_.welds[weld], EventReason::Broken);
  return lost;
}

void WeldTest::testLost(Weld& weld) {
  const int held = activeContacts(c_, weld);
  if (!hadContact(weld)) return;
  if (held == 0) cutWeld(weld, EventReason::Broken);
  note(weld, {.criterion = "broken",
              .equation = "Section 6.3",
              .value = static_cast<double>(held),
              .threshold = 1.0,
              .verdict = held == 0 ? "unmerge" : "keep"});
}

double WeldTest::openingThreshold() const {
  constexpr double kBeyondResidual = 5.0;
  const double sliding = state_.settings.unmerging.sliding;
  return disturbed_ ? std::min(sliding, kBeyondResidual * residualVelocity(state_)) : sliding;
}

bool WeldTest::hadContact(const Weld& weld) const {
  if (weld.joints > 0) return true;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const InternalContact& inner = c_.contacts[i];
    if (inner.points[0].active || inner.points[1].active) return true;
  }
  return false;
}

void WeldTest::testSliding(std::uint32_t weld, Drift& slip, double w_t) {
  const double threshold = state_.settings.unmerging.sliding;
  if (rule() == Rule::Paper) slip = {};
  const Evidence found = weigh(slip, w_t, threshold);
  note(c_.welds[weld], {.criterion = "sliding",
                        .equation = "(19)",
                        .value = found.sum,
                        .threshold = threshold,
                        .count = found.steps,
                        .verdict = found.exceeds ? "unmerge" : "wait",
                        .at = at_});
  if (found.exceeds) cutWeld(c_.welds[weld], EventReason::Sliding);
}

void WeldTest::noteCone(std::uint32_t weld, const ContactBlock& k, int i, bool edge) {
  note(c_.welds[weld], {.criterion = "cone",
                        .equation = "(20)",
                        .value = std::abs(k.lambda_t(i)),
                        .threshold = k.mu * k.lambda_n(i),
                        .verdict = edge ? "edge" : "keep",
                        .at = at_});
}

void WeldTest::testMotion(Weld& weld) {
  if (weld.cut || !hadContact(weld)) return;
  const UnmergingSettings& settings = state_.settings.unmerging;
  const double value = relativeMotion(weld);
  const int before = weld.loud_steps;
  weld.loud_steps = value > settings.velocity ? weld.loud_steps + (confirming_ ? 0 : 1) : 0;
  const bool cut = weld.loud_steps >= settings.steps;
  note(weld, {.criterion = "relative-motion",
              .equation = "(17)",
              .value = value,
              .threshold = settings.velocity,
              .count = weld.loud_steps,
              .needed = settings.steps,
              .verdict = cut                   ? "unmerge"
                         : weld.loud_steps > 0 ? "wait"
                                               : "keep",
              .before = before});
  if (cut) cutWeld(weld, EventReason::RelativeMotion);
}

double WeldTest::relativeMotion(const Weld& weld) const {
  const auto field = [&](BodyId b) {
    const SolverVelocity& u = scratch_.sweep_u[index(b)];
    return VelocityField{state_.pose(b).position, {u.vx, u.vy}, u.omega};
  };
  const VelocityField a = field(weld.a), b = field(weld.b);
  double fastest = 0.0;
  for (const BodyId id : {weld.a, weld.b}) {
    if (state_[id].rigid != c_.rigid) continue;  // only the box of the body that can move
    OrientedBox box = state_.extent(rigidOf(id)).box;
    box.frame = state_.pose(id) * box.frame;
    fastest = std::max(fastest, fastestCorner(box, a, b));
  }
  return fastest;
}

void WeldTest::note(const Weld& weld, Decision test) const {
  if (!scratch_.notes) return;
  test.a = weld.a;
  test.b = weld.b;
  test.stage = "Unmerge";
  scratch_.notes->decisions.push_back(test);
}

void WeldTest::cutWeld(Weld& weld, EventReason reason) {
  if (weld.cut) return;
  weld.cut = true;
  weld.reason = reason;
  c_.cut_welds.push_back(static_cast<std::uint32_t>(&weld - c_.welds.data()));
}

int activeContacts(const Collection& c, const Weld& weld) {
  int active = weld.joints;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const InternalContact& inner = c.contacts[i];
    for (int p = 0; p < inner.count; ++p) active += inner.point(p).active && !inner.point(p).lost;
  }
  return active;
}

void listPivots(Collection& c) {
  c.pivots.clear();
  c.pivots_stale = false;
  for (std::uint32_t i = 0; i < c.welds.size(); ++i) {
    if (activeContacts(c, c.welds[i]) < 2) c.pivots.push_back(i);
  }
}

}  // namespace merge2d
