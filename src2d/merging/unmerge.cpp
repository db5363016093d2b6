#include "src2d/merging/unmerge.h"

#include <algorithm>

#include "src2d/contact/detection.h"
#include "src2d/merging/collection.h"
#include "src2d/merging/cycles.h"
#include "src2d/merging/joint_welds.h"
#include "src2d/merging/metric.h"
#include "src2d/merging/sweep.h"

namespace merge2d {
namespace {

/// A tangential impulse this near to its limit is on the edge of the cone, Eq. (20).
constexpr double kOnEdge = 1.0 - 1e-9;

bool broken(const ContactBlock& k, int i) { return k.lambda_n(i) <= 0.0 && !k.bilateral; }
bool onEdge(const ContactBlock& k, int i) {
  return !k.bilateral && std::abs(k.lambda_t(i)) >= kOnEdge * k.mu * k.lambda_n(i);
}

/// The result of summing one more velocity.
struct Evidence {
  double sum = 0.0;  ///< its size [m/s]
  int steps = 0;
  bool exceeds = false;
};

class WeldTest {
 public:
  WeldTest(const State& state, Scratch& scratch, Collection& c, bool disturbed)
      : state_(state),
        scratch_(scratch),
        c_(c),
        turn_(state[c.rigid].rotation),
        disturbed_(disturbed),
        whole_(disturbed) {}

  /// Adds this step's evidence to what was summed, and cuts the welds whose sum is too large. Only
  /// contacts at their limit, or watched since they were, need more than a look at their impulses.
  void testAll() {
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

  bool contactOpened() const { return opened_; }
  bool somethingGrows() const { return growing_; }

  /// Looks again after more sweeps. What was summed may have come from a sweep that had not
  /// converged: it is replaced by today's velocity, as if it had been the same in all those steps.
  void confirmAll() {
    confirming_ = whole_ = true;
    growing_ = false;
    for (const std::uint32_t weld : c_.cut_welds) c_.welds[weld].cut = false;
    c_.cut_welds.clear();
    testAll();
  }

 private:
  static bool atLimit(const ContactBlock& k) {
    for (int i = 0; i < k.count; ++i) {
      if (broken(k, i) || onEdge(k, i)) return true;
    }
    return false;
  }

  /// Broken (Section 6.3) and on edge (Eqs. (19), (20)).
  void testContacts(std::uint32_t b) {
    ContactBlock& k = c_.blocks[b];
    InternalContact& inner = c_.contacts[c_.block_contact[b]];
    const std::uint32_t weld = c_.block_weld[b];
    c_.watched[b] = 0;
    for (int i = 0; i < k.count; ++i) {
      const bool pressed = !broken(k, i), edge = pressed && onEdge(k, i);
      const bool was_lost = inner.lost[i], was_active = inner.active[i];
      if (pressed) {
        inner.active[i] = true;
        k.bias[i] = 0.0;
        inner.lost[i] = false;
        inner.opening[i] = {};
      }
      if (!edge) inner.slip[i] = {};
      if (scratch_.notes) {
        at_ = state_[c_.rigid].frame() * inner.contact.points[static_cast<std::size_t>(i)].position;
      }
      if (edge || !pressed) {
        const ContactVelocity w = velocityAt(k, i);
        if (!pressed && inner.active[i]) inner.lost[i] = testBroken(weld, inner.opening[i], w.n);
        if (edge) testSliding(weld, inner.slip[i], w.t);
      }
      if (pressed) noteCone(weld, k, i, edge);
      c_.watched[b] |= edge || !pressed;
      opened_ |= inner.lost[i] && !was_lost;
      c_.pivots_stale |= was_lost != inner.lost[i] || was_active != inner.active[i];
    }
  }

  /// Velocity at a point after the sweep.
  ContactVelocity velocityAt(const ContactBlock& k, int i) const {
    const double nx = turn_.c * k.nx - turn_.s * k.ny, ny = turn_.s * k.nx + turn_.c * k.ny;
    return contactVelocity(k, i, nx, ny, scratch_.sweep_u[k.a], scratch_.sweep_u[k.b]);
  }

  /// Adds to what was summed. Evidence that more sweeps do not confirm is forgotten.
  Evidence weigh(Drift& drift, double w, double threshold) {
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

  /// True when the contact has opened.
  bool testBroken(std::uint32_t weld, Drift& opening, double w_n) {
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

  /// A weld all of whose contacts have opened is broken; one that keeps a single contact is a
  /// pivot.
  void testLost(Weld& weld) {
    const int held = activeContacts(c_, weld);
    if (!hadContact(weld)) return;
    if (held == 0) cutWeld(weld, EventReason::Broken);
    note(weld, {.criterion = "broken",
                .equation = "Section 6.3",
                .value = static_cast<double>(held),
                .threshold = 1.0,
                .verdict = held == 0 ? "unmerge" : "keep"});
  }

  /// How much may open. Where something new entered, the sweeps have converged, and less will do.
  double openingThreshold() const {
    constexpr double kBeyondResidual = 5.0;
    const double sliding = state_.settings.unmerging.sliding;
    return disturbed_ ? std::min(sliding, kBeyondResidual * residualVelocity(state_)) : sliding;
  }

  bool hadContact(const Weld& weld) const {
    if (weld.joints > 0) return true;
    for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
      if (c_.contacts[i].active[0] || c_.contacts[i].active[1]) return true;
    }
    return false;
  }

  /// A contact on the edge of its cone.
  void testSliding(std::uint32_t weld, Drift& slip, double w_t) {
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

  void noteCone(std::uint32_t weld, const ContactBlock& k, int i, bool edge) {
    note(c_.welds[weld], {.criterion = "cone",
                          .equation = "(20)",
                          .value = std::abs(k.lambda_t(i)),
                          .threshold = k.mu * k.lambda_n(i),
                          .verdict = edge ? "edge" : "keep",
                          .at = at_});
  }

  /// Relative motion (Section 6.4): only pairs with fewer than two contacts can turn in 2D.
  void testMotion(Weld& weld) {
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

  double relativeMotion(const Weld& weld) const {
    const auto field = [&](BodyId b) {
      const SolverVelocity& u = scratch_.sweep_u[index(b)];
      return VelocityField{state_.pose(b).position, {u.vx, u.vy}, u.omega};
    };
    const VelocityField a = field(weld.a), b = field(weld.b);
    double fastest = 0.0;
    for (const BodyId id : {weld.a, weld.b}) {
      if (state_[id].rigid != c_.rigid) continue;  // only the box of the body that can move
      OrientedBox box = state_[rigidOf(id)].box;
      box.frame = state_.pose(id) * box.frame;
      fastest = std::max(fastest, fastestCorner(box, a, b));
    }
    return fastest;
  }

  /// Writes one test down if somebody asks.
  void note(const Weld& weld, Decision test) const {
    if (!scratch_.notes) return;
    test.a = weld.a;
    test.b = weld.b;
    test.stage = "Unmerge";
    scratch_.notes->decisions.push_back(test);
  }

  void cutWeld(Weld& weld, EventReason reason) {
    if (weld.cut) return;
    weld.cut = true;
    weld.reason = reason;
    c_.cut_welds.push_back(static_cast<std::uint32_t>(&weld - c_.welds.data()));
  }

  Rule rule() const { return state_.settings.unmerging.rule; }

  const State& state_;
  Scratch& scratch_;
  Collection& c_;
  Rotation turn_;
  bool confirming_ = false;
  bool growing_ = false;    ///< some sum grew in this step, and is not too large yet
  bool opened_ = false;     ///< some contact was lost that held before
  bool disturbed_ = false;  ///< something new entered in this step: the sweeps have converged
  bool whole_ = false;      ///< dormant contacts were swept too
  Vec2 at_ = Vec2::Zero();  ///< the contact point at hand, for the notes
};

/// What still hangs together without the cut welds. Node 0 is the frame; it holds bodies in place
/// but does not join them into one collection.
struct Parts {
  std::vector<std::uint32_t> part;     ///< per member
  std::vector<std::uint8_t> anchored;  ///< per part
};

/// True when all members hang together, or each on the frame, by welds with two contacts alone: a
/// quick answer that is right most times.
bool hangsTogether(const State& state, const Collection& c, DisjointSets& sets) {
  const auto node = [&](BodyId b) {
    return state[b].rigid == c.rigid ? static_cast<std::uint32_t>(memberIndex(c, b)) + 1 : 0u;
  };
  sets.reset(c.members.size() + 1);
  std::size_t joined = 0;
  bool on_frame = state[c.rigid].floating();
  for (const Weld& weld : c.welds) {
    if (weld.cut || activeContacts(c, weld) < 2) continue;
    const std::uint32_t a = node(weld.a), b = node(weld.b);
    if (a == 0 || b == 0) {
      on_frame = true;
    } else {
      joined += sets.unite(a, b) ? 1 : 0;
    }
  }
  return on_frame && joined + 1 == c.members.size();
}

/// The contacts of a weld that hold, in the collection's frame, and what its joints are worth.
void addPins(const State& state, const Collection& c, const Weld& weld, std::uint32_t a,
             std::uint32_t b, std::vector<Pin>& pins) {
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const InternalContact& inner = c.contacts[i];
    for (std::size_t p = 0; p < static_cast<std::size_t>(inner.contact.count); ++p) {
      if (!inner.active[p] || inner.lost[p]) continue;
      pins.push_back({.a = a, .b = b, .at = inner.contact.points[p].position, .placed = true});
    }
  }
  if (weld.joints == 0) return;
  const Vec2 at = jointPoint(state, c, weld);
  for (int i = 0; i < weld.joints; ++i) {
    pins.push_back({.a = a, .b = b, .at = at + i * Vec2::UnitX(), .placed = true});
  }
}

Parts partsWithoutCuts(const State& state, const Collection& c) {
  const auto node = [&](BodyId b) {
    return state[b].rigid == c.rigid ? static_cast<std::uint32_t>(memberIndex(c, b)) + 1 : 0u;
  };
  std::vector<Pin> pins;
  for (const Weld& weld : c.welds) {
    if (!weld.cut) addPins(state, c, weld, node(weld.a), node(weld.b), pins);
  }
  const auto nodes = static_cast<std::uint32_t>(c.members.size() + 1);
  const CycleCriterion criterion = state.settings.unmerging.rule == Rule::Paper
                                       ? CycleCriterion::Off
                                       : state.settings.merging.cycles;
  const Groups group = heldGroups(nodes, pins, criterion);

  // Bodies of one rigid group that touch each other, not only the frame, stay one part.
  DisjointSets parts;
  parts.reset(nodes);
  for (const Pin& pin : pins) {
    if (pin.a != 0 && pin.b != 0 && group[pin.a] == group[pin.b]) parts.unite(pin.a, pin.b);
  }
  Parts result;
  std::vector<std::uint32_t> number(nodes, ~0u);
  for (std::uint32_t n = 1; n < nodes; ++n) {
    std::uint32_t& p = number[parts.find(n)];
    if (p == ~0u) {
      p = static_cast<std::uint32_t>(result.anchored.size());
      result.anchored.push_back(0);
    }
    result.part.push_back(p);
    if (group[n] == group[0]) result.anchored[p] = 1;
  }
  return result;
}

/// One event per weld that ends.
void reportCuts(const State& state, const Collection& before, Scratch& scratch) {
  for (const Weld& weld : before.welds) {
    const bool together = state[weld.a].rigid == state[weld.b].rigid;
    const bool on_frame =
        !state.rigid(weld.a).floating() && state.rigid(weld.a).anchor == state.rigid(weld.b).anchor;
    if (together || on_frame) continue;
    scratch.events.push_back({EventType::Unmerge, weld.a, weld.b, before.id,
                              weld.cut ? weld.reason : EventReason::Cycle});
    if (weld.cut || !scratch.notes) continue;
    scratch.notes->decisions.push_back({.a = weld.a,
                                        .b = weld.b,
                                        .stage = "Unmerge",
                                        .criterion = "cycle",
                                        .equation = "Section 8.2",
                                        .value = static_cast<double>(activeContacts(before, weld)),
                                        .threshold = 2.0,
                                        .verdict = "unmerge"});
  }
}

/// What was decided about welds may not be what came of it: `from` one verdict `to` another, in the
/// decisions from `first` on, where the pair stayed together.
void restate(const State& state, Notes* notes, std::size_t first, std::string_view to) {
  if (!notes) return;
  for (std::size_t i = first; i < notes->decisions.size(); ++i) {
    Decision& d = notes->decisions[i];
    const Rigid &a = state.rigid(d.a), &b = state.rigid(d.b);
    const bool together = &a == &b || (!a.floating() && a.anchor == b.anchor);
    if (together && d.verdict == "unmerge") d.verdict = to;
  }
}

bool fallsApart(const State& state, const Collection& c, const Parts& parts) {
  return parts.anchored.size() > 1 || (parts.anchored[0] != 0) != !state[c.rigid].floating();
}

void splitAtCuts(State& state, Scratch& scratch, RigidId id, const Parts& parts) {
  Collection before;
  before.id = state.collection(id).id;
  before.welds = state.collection(id).welds;
  if (scratch.notes) before.contacts = state.collection(id).contacts;
  splitCollection(state, id, parts.part, parts.anchored);
  reportCuts(state, before, scratch);
  scratch.split = true;
}

/// Breaks the joints that bear too much, also after more sweeps, and parts what they held.
bool breakInside(State& state, Scratch& scratch, Collection& c) {
  sweepAgain(state, scratch, c);
  if (!anyJointBreaks(state, c)) return false;
  breakJointsInside(state, c);
  const Parts parts = partsWithoutCuts(state, c);
  if (fallsApart(state, c, parts)) splitAtCuts(state, scratch, c.rigid, parts);
  scratch.split = true;  // to be laid out anew
  return true;
}

/// Some weld is cut that was not in the last step.
bool newCut(const Collection& c, const Scratch& scratch) {
  return std::any_of(c.cut_welds.begin(), c.cut_welds.end(), [&](std::uint32_t weld) {
    const auto& before = scratch.cuts_before;
    return std::find(before.begin(), before.end(), weld) == before.end();
  });
}

/// Tests the welds of one collection, and splits it where it falls apart.
void testCollection(State& state, Scratch& scratch, std::size_t slot) {
  Collection& c = state.collections[slot];
  scratch.cuts_before.assign(c.cut_welds.begin(), c.cut_welds.end());
  for (const std::uint32_t weld : c.cut_welds) c.welds[weld].cut = false;
  c.cut_welds.clear();
  if (anyJointBreaks(state, c) && breakInside(state, scratch, c)) return;
  const bool loosened = loosenJoints(state, c, scratch.sweep_u);
  const std::size_t first = scratch.notes ? scratch.notes->decisions.size() : 0;
  WeldTest test(state, scratch, c, scratch.disturbed[slot] != 0);
  test.testAll();
  // Broken welds that do not part the graph are found again in each step: look anew only when
  // there is one more.
  if (!newCut(c, scratch) && !test.contactOpened() && !loosened) return;
  if (hangsTogether(state, c, scratch.sets)) return;
  Parts parts = partsWithoutCuts(state, c);
  if (!fallsApart(state, c, parts)) return;
  const UnmergingSettings& settings = state.settings.unmerging;
  if (settings.rule == Rule::Default && settings.ordering) {
    // One sweep may not have converged: before anything parts, look again after more.
    restate(state, scratch.notes, first, "recheck");
    sweepAgain(state, scratch, c);
    confirmJoints(state, c, scratch.sweep_u);
    test.confirmAll();
    parts = partsWithoutCuts(state, c);
    c.refuted = !test.somethingGrows();
    if (!fallsApart(state, c, parts)) return;
  }
  splitAtCuts(state, scratch, c.rigid, parts);
}

void finishSplits(State& state, Scratch& scratch) {
  if (!scratch.split) return;
  scratch.split = false;
  layOutCollections(state);
  collectPairs(state, scratch);
}

}  // namespace

int activeContacts(const Collection& c, const Weld& weld) {
  int active = weld.joints;
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    const InternalContact& inner = c.contacts[i];
    for (int p = 0; p < inner.contact.count; ++p) active += inner.active[p] && !inner.lost[p];
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

void unmerge(State& state, Scratch& scratch) {
  if (!scratch.sweeping) return;
  const std::size_t slots = state.collections.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    if (!isSwept(state, state.collections[slot])) continue;
    const std::size_t first = scratch.notes ? scratch.notes->decisions.size() : 0;
    testCollection(state, scratch, slot);
    restate(state, scratch.notes, first, "cut");  // cut, but held together by others
  }
  finishSplits(state, scratch);
}

void releaseBody(State& state, Scratch& scratch, BodyId body) {
  const std::size_t slots = state.collections.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    Collection& c = state.collections[slot];
    if (c.id == kNoCollection) continue;
    bool any = false;
    for (Weld& weld : c.welds) {
      if (weld.a != body && weld.b != body) continue;
      weld.cut = any = true;
      weld.reason = EventReason::User;
    }
    if (any) splitAtCuts(state, scratch, c.rigid, partsWithoutCuts(state, c));
  }
  finishSplits(state, scratch);
}

}  // namespace merge2d
