#include "src2d/merging/unmerge.h"

#include <algorithm>

#include "src2d/contact/detection.h"
#include "src2d/merging/collection.h"
#include "src2d/merging/cycles.h"
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

/// Records one decision if somebody asks.
void record(const Scratch& scratch, const Weld& weld, const char* criterion, const char* equation,
            double value, double threshold, int count, int needed, bool cut) {
  if (!scratch.decisions) return;
  scratch.decisions->push_back({weld.a, weld.b, "Unmerge", criterion, equation, value, threshold,
                                count, needed, cut ? "unmerge" : "keep"});
}

class WeldTest {
 public:
  WeldTest(const State& state, Scratch& scratch, Collection& c, bool disturbed)
      : state_(state),
        scratch_(scratch),
        c_(c),
        turn_(state[c.rigid].rotation),
        whole_(disturbed) {}

  /// Adds this step's evidence to what was summed, and cuts the welds whose sum is too large. Only
  /// contacts at their limit, or watched since they were, need more than a look at their impulses.
  void testAll() {
    const std::size_t blocks = whole_ ? c_.blocks.size() : c_.active_blocks;
    for (std::uint32_t i = 0; i < blocks; ++i) {
      if (c_.watched[i] || scratch_.decisions || atLimit(c_.blocks[i])) testContacts(i);
    }
    if (c_.pivots_stale) listPivots(c_);
    for (const std::uint32_t pivot : c_.pivots) {
      testLost(c_.welds[pivot]);
      testMotion(c_.welds[pivot]);
    }
  }

  bool contactOpened() const { return opened_; }

  /// Looks again after more sweeps. What was summed may have come from a sweep that had not
  /// converged: it is replaced by today's velocity, as if it had been the same in all those steps.
  void confirmAll() {
    confirming_ = whole_ = true;
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
      if (edge || !pressed || scratch_.decisions) {
        const ContactVelocity w = lookAtPoint(k, inner.contact, i);
        if (!pressed && inner.active[i]) inner.lost[i] = testBroken(weld, inner.opening[i], w.n);
        if (pressed) testSliding(weld, inner.slip[i], w.t, edge);
      }
      c_.watched[b] |= edge || !pressed;
      opened_ |= inner.lost[i] && !was_lost;
      c_.pivots_stale |= was_lost != inner.lost[i] || was_active != inner.active[i];
    }
  }

  /// Velocity at a point after the sweep.
  ContactVelocity lookAtPoint(const ContactBlock& k, Contact& contact, int i) {
    const double nx = turn_.c * k.nx - turn_.s * k.ny, ny = turn_.s * k.nx + turn_.c * k.ny;
    const ContactVelocity w =
        contactVelocity(k, i, nx, ny, scratch_.sweep_u[k.a], scratch_.sweep_u[k.b]);
    contact.points[static_cast<std::size_t>(i)].w_n = static_cast<float>(w.n);
    contact.points[static_cast<std::size_t>(i)].w_t = static_cast<float>(w.t);
    return w;
  }

  /// True when the drift is too large. Evidence that more sweeps do not confirm is forgotten.
  bool exceeds(Drift& drift, double w, double threshold) const {
    if (confirming_) {
      if (std::abs(w) < residualVelocity(state_)) w = 0.0;
      drift.sum = static_cast<float>(w * std::max(drift.steps, 1));
      if (std::abs(drift.sum) > threshold) return true;
      drift = {};
      return false;
    }
    drift.sum += static_cast<float>(w);
    drift.steps += 1;
    return std::abs(drift.sum) > threshold;
  }

  /// True when the contact has opened.
  bool testBroken(std::uint32_t weld, Drift& opening, double w_n) {
    const bool literal = rule() == Rule::Paper;
    const double threshold = literal ? 0.0 : state_.settings.unmerging.sliding;
    const bool lost = exceeds(opening, std::max(0.0, w_n), threshold) || literal;
    record(scratch_, c_.welds[weld], "broken", "Section 6.3", opening.sum, threshold, opening.steps,
           0, lost);
    if (lost && literal) cutWeld(c_.welds[weld], EventReason::Broken);
    return lost;
  }

  /// A weld all of whose contacts have opened is broken; one that keeps a single contact is a
  /// pivot.
  void testLost(Weld& weld) {
    if (activeContacts(c_, weld) == 0 && hadContact(weld)) cutWeld(weld, EventReason::Broken);
  }

  bool hadContact(const Weld& weld) const {
    for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
      if (c_.contacts[i].active[0] || c_.contacts[i].active[1]) return true;
    }
    return false;
  }

  void testSliding(std::uint32_t weld, Drift& slip, double w_t, bool edge) {
    const double threshold = state_.settings.unmerging.sliding;
    if (rule() == Rule::Paper) slip = {};
    const bool cut = edge && exceeds(slip, w_t, threshold);
    record(scratch_, c_.welds[weld], "sliding", "(19), (20)", std::abs(slip.sum), threshold,
           slip.steps, 0, cut);
    if (cut) cutWeld(c_.welds[weld], EventReason::Sliding);
  }

  /// Relative motion (Section 6.4): only pairs with fewer than two contacts can turn in 2D.
  void testMotion(Weld& weld) {
    if (weld.cut || !hadContact(weld)) return;
    const UnmergingSettings& settings = state_.settings.unmerging;
    const double value = relativeMotion(weld);
    weld.loud_steps = value > settings.velocity ? weld.loud_steps + (confirming_ ? 0 : 1) : 0;
    const bool cut = weld.loud_steps >= settings.steps;
    record(scratch_, weld, "relative-motion", "(17)", value, settings.velocity, weld.loud_steps,
           settings.steps, cut);
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
  bool opened_ = false;  ///< some contact was lost that held before
  bool whole_ = false;   ///< dormant contacts were swept too
};

/// What still hangs together without the cut welds. Node 0 is the frame; it holds bodies in place
/// but does not join them into one collection.
struct Parts {
  std::vector<std::uint32_t> part;     ///< per member
  std::vector<std::uint8_t> anchored;  ///< per part
};

Parts partsWithoutCuts(const State& state, const Collection& c) {
  const auto node = [&](BodyId b) {
    return state[b].rigid == c.rigid ? static_cast<std::uint32_t>(memberIndex(c, b)) + 1 : 0u;
  };
  std::vector<ContactEdge> edges;
  for (const Weld& weld : c.welds) {
    const int contacts = activeContacts(c, weld);
    if (!weld.cut && contacts > 0) edges.push_back({node(weld.a), node(weld.b), contacts});
  }
  const auto nodes = static_cast<std::uint32_t>(c.members.size() + 1);
  const CycleCriterion criterion = state.settings.unmerging.rule == Rule::Paper
                                       ? CycleCriterion::Off
                                       : state.settings.merging.cycles;
  const auto group = rigidGroups(nodes, edges, criterion);

  // Bodies of one rigid group that touch each other, not only the frame, stay one part.
  DisjointSets parts;
  parts.reset(nodes);
  for (const ContactEdge& e : edges) {
    if (e.a != 0 && e.b != 0 && group[e.a] == group[e.b]) parts.unite(e.a, e.b);
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
  }
}

bool fallsApart(const State& state, const Collection& c, const Parts& parts) {
  return parts.anchored.size() > 1 || (parts.anchored[0] != 0) != !state[c.rigid].floating();
}

void splitAtCuts(State& state, Scratch& scratch, RigidId id, const Parts& parts) {
  Collection before;
  before.id = state.collection(id).id;
  before.welds = state.collection(id).welds;
  splitCollection(state, id, parts.part, parts.anchored);
  reportCuts(state, before, scratch);
  scratch.split = true;
}

/// Some weld is cut that was not in the last step.
bool newCut(const Collection& c, const Scratch& scratch) {
  return std::any_of(c.cut_welds.begin(), c.cut_welds.end(), [&](std::uint32_t weld) {
    const auto& before = scratch.cuts_before;
    return std::find(before.begin(), before.end(), weld) == before.end();
  });
}

void finishSplits(State& state, Scratch& scratch) {
  if (!scratch.split) return;
  scratch.split = false;
  layOutCollections(state);
  collectPairs(state, scratch);
}

}  // namespace

int activeContacts(const Collection& c, const Weld& weld) {
  int active = 0;
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
    Collection& c = state.collections[slot];
    scratch.cuts_before.assign(c.cut_welds.begin(), c.cut_welds.end());
    for (const std::uint32_t weld : c.cut_welds) c.welds[weld].cut = false;
    c.cut_welds.clear();
    WeldTest test(state, scratch, c, scratch.disturbed[slot] != 0);
    test.testAll();
    // Broken welds that do not part the graph are found again in each step: look anew only when
    // there is one more.
    if (!newCut(c, scratch) && !test.contactOpened()) continue;
    Parts parts = partsWithoutCuts(state, c);
    if (!fallsApart(state, c, parts)) continue;
    const UnmergingSettings& settings = state.settings.unmerging;
    if (settings.rule == Rule::Default && settings.ordering) {
      // One sweep may not have converged: before anything parts, look again after more.
      sweepAgain(state, scratch, c);
      test.confirmAll();
      parts = partsWithoutCuts(state, c);
      if (!fallsApart(state, c, parts)) continue;
    }
    splitAtCuts(state, scratch, c.rigid, parts);
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
