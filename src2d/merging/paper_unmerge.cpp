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

/// Tests the welds of one collection in one step.
class WeldCriteria {
 public:
  WeldCriteria(const State& state, const Scratch& scratch, Collection& c)
      : state_(state), scratch_(scratch), c_(c), turn_(state[c.rigid].rotation) {}

  /// Returns whether some weld is cut.
  bool testAll() {
    for (Weld& weld : c_.welds) weld.cut = false;
    for (std::uint32_t b = 0; b < c_.active_blocks; ++b) testContacts(b);
    for (std::uint32_t w = 0; w < c_.welds.size(); ++w) {
      if (isWatched(c_.welds[w])) testMotion(w);
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
  void testContacts(std::uint32_t b) {
    const ContactBlock& k = c_.blocks[b];
    InternalContact& inner = c_.contacts[c_.block_contact[b]];
    const Vec2 n = turn_ * Vec2(k.nx, k.ny);
    for (int i = 0; i < k.count; ++i) {
      PointWatch& point = inner.watch[static_cast<std::size_t>(i)];
      if (!point.active && broken(k, i)) continue;
      point.active = true;
      point.lost = broken(k, i);
      at_ = state_[c_.rigid].frame() * inner.point(i).position;
      if (point.lost) {
        testBroken(inner.weld, k.lambda_n(i));
      } else {
        const auto& u = scratch_.sweep_u;
        const double slip = contactVelocity(k, i, n.x(), n.y(), u[k.a], u[k.b]).t;
        testSliding(inner.weld, std::abs(slip), onEdge(k, i));
      }
    }
  }

  void testBroken(std::uint32_t w, double lambda_n) {
    note(w, {.criterion = "broken",
             .equation = "Section 6.3",
             .value = lambda_n,
             .threshold = 0.0,
             .verdict = "unmerge",
             .at = at_});
    cut(w, EventReason::Broken);
  }

  /// Eqs. (19) and (20).
  void testSliding(std::uint32_t w, double slip, bool on_edge) {
    const double threshold = state_.settings.unmerging.sliding;
    if (!on_edge) return;
    const bool slides = slip > threshold;
    note(w, {.criterion = "sliding",
             .equation = "(19)",
             .value = slip,
             .threshold = threshold,
             .verdict = slides ? "unmerge" : "keep",
             .at = at_});
    if (slides) cut(w, EventReason::Sliding);
  }

  /// Section 6.4.
  void testMotion(std::uint32_t w) {
    constexpr int kMost = 10'000;  // steps that are counted
    const UnmergingSettings& settings = state_.settings.unmerging;
    Weld& weld = c_.welds[w];
    const int before = weld.moving;
    const double motion = relativeMotion(weld);
    const bool fast = motion > settings.velocity;
    weld.moving = fast ? static_cast<std::uint16_t>(std::min(before + 1, kMost)) : 0;
    const bool moves = weld.moving >= settings.steps;
    note(w, {.criterion = "relative-motion",
             .equation = "(17)",
             .value = motion,
             .threshold = settings.velocity,
             .count = weld.moving,
             .needed = settings.steps,
             .verdict = moves             ? "unmerge"
                        : weld.moving > 0 ? "wait"
                                          : "keep",
             .before = before});
    if (moves) cut(w, EventReason::RelativeMotion);
  }

  /// Eq. (15) with the velocities of the sweep; of a pair with a pinned body only the other's box.
  double relativeMotion(const Weld& weld) const {
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

  void cut(std::uint32_t w, EventReason reason) {
    Weld& weld = c_.welds[w];
    if (weld.cut) return;
    weld.cut = any_ = true;
    weld.reason = reason;
  }

  void note(std::uint32_t w, Decision test) const {
    if (!scratch_.notes) return;
    test.a = c_.welds[w].a;
    test.b = c_.welds[w].b;
    test.stage = "Unmerge";
    scratch_.notes->decisions.push_back(test);
  }

  const State& state_;
  const Scratch& scratch_;
  Collection& c_;
  Rotation turn_;
  bool any_ = false;        ///< some weld is cut
  Vec2 at_ = Vec2::Zero();  ///< the contact point at hand, for the notes
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
    const bool cut = WeldCriteria(state, scratch, c).testAll();
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
