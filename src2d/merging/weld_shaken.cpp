/// Relative motion of the welds of a collection in the step in which a blow strikes it.

#include <algorithm>
#include <cmath>

#include "src2d/merging/disturbance.h"
#include "src2d/merging/momentum.h"
#include "src2d/merging/weld_checks.h"

namespace merge2d {
namespace {

/// Deviation: a body that a blow moves against the whole collection comes free, though each single
/// weld gives too little to be cut. Its speed against the whole, and the relative motion at its
/// weld that is needed beside that, as parts of the unmerging velocity. Guarded by
/// Blow.CarriesOffWhatManyJointsThatGiveLittleWouldHold.
constexpr double kCarriedOff = 1.5, kGives = 0.1;

}  // namespace

bool WeldTest::isStruck() const { return c_.struck == kFollowed; }

void WeldTest::testShaken() {
  const VelocityField whole = sweptField(state_, scratch_, c_);
  for (const BodyId member : c_.members) {
    if (!scratch_.shaken[index(member)]) continue;
    const std::uint32_t node = state_[rigidOf(member)].member;
    for (std::uint32_t k = c_.weld_at[node]; k < c_.weld_at[node + 1]; ++k) {
      Weld& weld = c_.welds[c_.weld_of[k]];
      const bool other = weld.b == member && scratch_.shaken[index(weld.a)];
      if (!other && !weld.cut && !weld.expected && weld.joints == 0) testShake(weld, whole);
    }
  }
}

void WeldTest::testShake(Weld& weld, const VelocityField& whole) {
  const double threshold = state_.settings.unmerging.velocity * caution(weld);
  const Turning now = relativeMotion(weld, {0.0, kGives * threshold});
  const double motion = std::abs(now.fastest);
  const bool parts = motion > threshold && now.nearest > noise();
  if (!parts && motion <= kGives * threshold) return;
  const double sway = swayAgainst(whole, weld), most = kCarriedOff * threshold;
  if (!parts && sway <= most) return;
  note(weld, [&] {
    return Decision{.criterion = parts ? "relative-motion" : "carried-off",
                    .equation = parts ? "(17)" : kOwnUnmerging,
                    .value = parts ? motion : sway,
                    .threshold = parts ? threshold : most,
                    .count = 1,
                    .verdict = "unmerge",
                    .caution = caution(weld)};
  });
  cutWeld(weld, EventReason::RelativeMotion);
}

double WeldTest::swayAgainst(const VelocityField& whole, const Weld& weld) const {
  double fastest = 0.0;
  for (const BodyId id : {weld.a, weld.b}) {
    if (state_[id].rigid != c_.rigid) continue;
    fastest = std::max(fastest, swaySquared(whole, state_.pose(id).position, velocity(id)));
  }
  return std::sqrt(fastest);
}

}  // namespace merge2d
