/// Sections 6.3 and 6.4 to the letter.

#include <algorithm>
#include <cmath>

#include "src2d/collections/collection.h"
#include "src2d/collections/cuts.h"
#include "src2d/collections/joint_welds.h"
#include "src2d/dynamics/contact_limits.h"
#include "src2d/merging/metric.h"
#include "src2d/merging/paper_rule.h"

namespace merge2d {
namespace {

/// Section 6.3: a point that carries no force any more.
Criterion stillPresses(const ContactBlock& k, int i) {
  return {"broken", "Section 6.3", k.lambda_n(i), 0.0, !broken(k, i)};
}

/// Eq. (19), of a point on the edge of its cone, Eq. (20).
Criterion sticks(const UnmergingSettings& settings, double slip) {
  return {"sliding", "(19)", slip, settings.sliding, slip <= settings.sliding};
}

/// Section 6.4, with the measure of Eq. (17).
Criterion movesSlowly(const UnmergingSettings& settings, double motion) {
  return {"relative-motion", "Section 6.4", motion, settings.velocity, motion <= settings.velocity};
}

/// Asks the criteria of the welds of one collection in one step, and cuts the welds for which one
/// does not hold.
class WeldCutter {
 public:
  WeldCutter(const State& state, const Scratch& scratch, Collection& c)
      : state_(state), scratch_(scratch), c_(c), turn_(state[c.rigid].rotation) {}

  /// Returns whether some weld is cut.
  bool cutAll() {
    for (Weld& weld : c_.welds) weld.cut = false;
    for (std::uint32_t b = 0; b < c_.laid_out.active_blocks; ++b) askContacts(b);
    for (Weld& weld : c_.welds) {
      if (isWatched(weld)) askMotion(weld);
    }
    return any_;
  }

 private:
  /// "If there are less than three contacts between the pair of bodies" (Section 6.4): in 2D all
  /// but pairs of compound bodies.
  bool isWatched(const Weld& weld) const {
    return !weld.cut && !weld.expected && activeContacts(c_, weld) < 3;
  }

  /// Section 6.3, for the points of one block.
  void askContacts(std::uint32_t b) {
    const ContactBlock& k = c_.blocks[b];
    InternalContact& inner = c_.contacts[c_.block_contact[b]];
    Weld& weld = c_.welds[inner.weld];
    for (int i = 0; i < k.count; ++i) {
      PointWatch& point = inner.watch[static_cast<std::size_t>(i)];
      const Criterion presses = stillPresses(k, i);
      if (!point.active && !presses.holds) continue;
      point.active = true;
      point.lost = !presses.holds;
      if (!point.lost && !onEdge(k, i)) continue;
      const Criterion test = point.lost ? presses : sticks(state_.settings.unmerging, slipAt(k, i));
      const EventReason reason = point.lost ? EventReason::Broken : EventReason::Sliding;
      if (!test.holds) cut(weld, reason);
      Decision* d = recordWeld(weld, test, test.holds ? "keep" : "unmerge");
      if (d) d->at = state_[c_.rigid].frame() * inner.point(i).position;
    }
  }

  double slipAt(const ContactBlock& k, int i) const {
    const Vec2 n = turn_ * Vec2(k.nx, k.ny);
    const auto& u = scratch_.sweep_u;
    return std::abs(contactVelocity(k, i, n.x(), n.y(), u[k.a], u[k.b]).t);
  }

  /// Section 6.4.
  void askMotion(Weld& weld) {
    constexpr int kMost = 30'000;  // steps that are counted, as many as the setting may be
    const UnmergingSettings& settings = state_.settings.unmerging;
    const Criterion slow = movesSlowly(settings, motionOf(weld));
    const int before = weld.moving;
    weld.moving = slow.holds ? 0 : static_cast<std::uint16_t>(std::min(before + 1, kMost));
    const bool cuts = weld.moving >= settings.steps;
    if (cuts) cut(weld, EventReason::RelativeMotion);
    recordWeld(weld, slow,
               cuts         ? "unmerge"
               : slow.holds ? "keep"
                            : "wait",
               {before, weld.moving, settings.steps});
  }

  /// Eq. (15) with the velocities of the sweep; of a pair with a pinned body only the other's box.
  double motionOf(const Weld& weld) const {
    // Seen from the first body, so that it does not matter where in the world they are.
    const Vec2 origin = state_.pose(weld.a).position;
    const auto field = [&](BodyId b) {
      const SolverVelocity& u = scratch_.sweep_u[index(b)];
      return VelocityField{state_.pose(b).position - origin, {u.vx, u.vy}, u.omega};
    };
    const VelocityField a = field(weld.a), b = field(weld.b);
    double fastest = 0.0;
    for (const BodyId id : {weld.a, weld.b}) {
      if (state_[id].rigid != c_.rigid) continue;
      OrientedBox box = state_.extent(rigidOf(id)).box;
      const Pose pose = state_.pose(id);
      box.frame = Pose{pose.position - origin, pose.rotation} * box.frame;
      fastest = std::max(fastest, fastestCorner(box, a, b));
    }
    return fastest;
  }

  void cut(Weld& weld, EventReason reason) {
    if (weld.cut) return;
    weld.cut = any_ = true;
    weld.reason = reason;
  }

  /// Returns the record, or null.
  Decision* recordWeld(const Weld& weld, const Criterion& test, std::string_view verdict,
                       const TestCount& count = {}) const {
    if (!scratch_.notes) return nullptr;
    return &scratch_.notes->decisions.emplace_back(
        record(test, "Unmerge", weld.a, weld.b, verdict, count));
  }

  const State& state_;
  const Scratch& scratch_;
  Collection& c_;
  Rotation turn_;
  bool any_ = false;  ///< some weld is cut
};

/// One collection that lost welds.
struct Loss {
  RigidId rigid;
  Noted noted;
};

}  // namespace

void unmergeByContacts(State& state, Scratch& scratch) {
  std::vector<Loss> losses;
  const std::size_t slots = state.collections.size();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    Collection& c = state.collections[slot];
    if (!isSwept(state, c) || breakJointsInside(state, scratch, c)) continue;
    Noted noted(scratch.notes);
    const bool joints_loosened = loosenJoints(state, c, scratch.sweep_u);
    const bool cut = WeldCutter(state, scratch, c).cutAll();
    noted.close();
    if (joints_loosened || cut) losses.push_back({c.rigid, noted});
  }
  for (const Loss& loss : losses) {
    const Collection& c = state.collection(loss.rigid);
    const Parts parts = connectedParts(state, c);
    if (fallsApart(state, c, parts)) splitAtCuts(state, scratch, loss.rigid, parts);
    restate(state, loss.noted, "cut");  // but held together by others
  }
}

}  // namespace merge2d
