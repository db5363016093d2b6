#pragma once
/// The tests of the welds of one collection (Sections 6.3 and 6.4): broken, sliding, moving.

#include <algorithm>

#include "src2d/dynamics/state.h"
#include "src2d/merging/caution.h"
#include "src2d/merging/metric.h"
#include "src2d/merging/refine.h"

namespace merge2d {

/// Tests the welds of one collection in one step.
class WeldTest {
 public:
  WeldTest(const State& state, Scratch& scratch, Collection& c, bool disturbed)
      : state_(state),
        scratch_(scratch),
        c_(c),
        turn_(state[c.rigid].rotation),
        residual_(residualVelocity(state)),
        leant_(scratch.leant),
        disturbed_(disturbed),
        whole_(disturbed) {}

  /// Adds this step's evidence to the sums, and cuts the welds whose sum is too large. Only
  /// contacts at their limit, or watched since they were, need more than a look at their impulses.
  void testAll();

  bool somethingGrows() const { return growing_; }

  /// Looks again after more sweeps. A sum may have come from a sweep that had not converged: it is
  /// replaced by today's velocity, as if that had been the same in all those steps.
  void confirmAll();

 private:
  /// The result of summing one more velocity.
  struct Evidence {
    double sum = 0.0;  ///< its size [m/s]
    int steps = 0;
    bool exceeds = false;
  };

  /// How the two bodies of a pivot move against each other.
  struct Turning {
    double fastest = 0.0;  ///< corner of both boxes; its sign is that of the rotation [m/s]
    double nearest = 0.0;  ///< the fastest corner of the box that moves less [m/s]
  };

  /// The bounds that the relative motion of a weld must exceed [m/s].
  struct Least {
    double noise, slow;  ///< noiseAt(), slowFor()
    double most() const { return std::max(noise, slow); }
  };

  /// Broken (Section 6.3) and on edge (Eqs. (19), (20)).
  void testContacts(std::uint32_t b);

  /// No contact of it presses.
  bool carriesNothing(std::uint32_t weld) const;

  /// One of its contacts has opened: see Collection::loosened.
  void noteLoosened(std::uint32_t weld);

  /// Adds to a sum. Evidence that more sweeps do not confirm is forgotten.
  Evidence weigh(Drift& drift, double w, double threshold);
  Evidence weigh(Drift& drift, double w, double threshold, double noise);

  /// True when the contact has opened.
  bool testBroken(std::uint32_t weld, Drift& opening, double w_n);

  void testPivot(const Pivot& pivot);

  /// A weld all of whose contacts have opened is broken; one that keeps a single contact is a
  /// pivot.
  void testLost(std::uint32_t weld);

  /// How much may open. Where something new entered, the sweeps have converged, and less will do.
  double openingThreshold() const;

  /// A contact on the edge of its cone.
  void testSliding(std::uint32_t weld, Drift& slip, double w_t);

  void noteCone(std::uint32_t weld, const ContactBlock& k, int i, bool edge);

  /// Relative motion (Section 6.4): only pairs with fewer than two contacts can turn in 2D.
  void testMotion(Weld& weld);

  /// Notes a bridge that rests on fewer contacts than it has: it may be about to turn on them.
  void leans(std::uint32_t weld);

  /// Relative motion of those, long before the contact that carries nothing has opened.
  void testLeaning();

  /// Something hits the collection in this step.
  bool isStruck() const;

  /// All welds around bodies that a blow reached. Deviation: in the paper only contacts at their
  /// limits part, which holds for sweeps that have converged. A blow is over in a step, and its
  /// sweeps leave the last joints of a chain at odds with each other: held together, they would
  /// take all of it. Guarded by Blow.LiftsWhatStandsAbove.
  void testShaken();
  void testShake(Weld& weld, const VelocityField& whole);

  /// The faster of the weld's two bodies against the motion of the whole collection [m/s].
  double swayAgainst(const VelocityField& whole, const Weld& weld) const;

  /// A pivot that turns slowly gathers speed: each step starts from the velocity of the whole, so
  /// its gains are summed, as slip is.
  bool turns(Weld& weld, const Turning& now, const Least& least);

  /// A pivot that nothing else holds turns on however slowly it begins: then it need not be fast,
  /// but be seen for some steps; for fewer where a load has just set in, which may tip it.
  bool tipsFor(const Weld& weld) const;
  /// Nothing else holds against the frame, and it was not cut in vain before. In a heap more than
  /// the rows of one weld hold: a body that barely tips there soon leans on its neighbours, unless
  /// a new load tips it.
  bool mustTip(const Weld& weld) const;
  /// The error that the sweep may have left in the relative motion of a weld, where nothing else
  /// holds [m/s].
  double noiseAt(const Weld& weld) const;

  /// A slower pivot counts as still: rigid rows may find a slow motion where soft contacts hold,
  /// the faster the more often the weld was cut in vain. Not where nothing else holds: there both
  /// know the same forces.
  double slowFor(const Weld& weld) const;

  Least least(const Weld& weld) const { return {noiseAt(weld), slowFor(weld)}; }

  /// All zero when no corner can be fast enough to matter.
  Turning relativeMotion(const Weld& weld, const Least& least) const;

  /// After the sweeps of this step so far.
  const SolverVelocity& velocity(BodyId b) const { return scratch_.sweep_u[index(b)]; }

  /// From the centre of mass of the weld's first body to that of the other.
  Vec2 between(const Weld& weld) const;

  /// True when no corner can be faster: a bound that spares most pivots a look at their corners.
  bool slowerThan(double limit, const Weld& weld, const VelocityField& a,
                  const VelocityField& b) const;

  /// No corner is faster than these: a coarser bound that needs no root and no pose, and one that
  /// needs to know where the two are [m/s].
  double fastestBound(const Weld& weld, const Pivot& pivot) const;
  double closerBound(const Weld& weld, const Pivot& pivot) const;

  /// Most pivots do not move, which a look at their two velocities tells.
  bool staysPut(const Pivot& pivot) const;

  /// Writes one test down if somebody asks: only then is `test()` made.
  template <class MakeDecision>
  void note(const Weld& weld, MakeDecision&& test) const {
    if (scratch_.notes) writeDown(weld, test());
  }
  void writeDown(const Weld& weld, Decision test) const;

  void cutWeld(Weld& weld, EventReason reason);

  /// Factor on all thresholds of a weld.
  double caution(const Weld& weld) const { return cautionWith(state_, c_, weld); }

  /// The error that the last sweep may have left in a velocity [m/s].
  double noise() const;

  /// Its bodies are where more sweeps begin.
  void doubt(const Weld& weld);

  const State& state_;
  Scratch& scratch_;
  Collection& c_;
  Rotation turn_;
  double residual_;                    ///< residualVelocity() [m/s]
  std::vector<std::uint32_t>& leant_;  ///< bridges that leaned in the last step
  double still_ = 0.0;                 ///< least() of an ordinary weld [m/s]
  bool confirming_ = false;
  bool growing_ = false;  ///< some sum grew in this step, and is not too large yet, or not for long
  bool disturbed_ = false;  ///< something new entered in this step: the sweeps have converged
  bool whole_ = false;      ///< dormant contacts were swept too
  Vec2 at_ = Vec2::Zero();  ///< the contact point at hand, for the notes
};

}  // namespace merge2d
