#pragma once
/// How well the cycle criteria judge. All criteria look at one and the same run, the reference: at
/// times half a second apart, the pairs that are ready to merge by their velocities are judged, and
/// what the reference does in the next seconds says who was right. Only pairs with a single contact
/// count: the criteria agree on others.

#include <array>

#include "src2d/scene/scene.h"

namespace merge2d {

inline constexpr std::array kCriteria = {CycleCriterion::Off, CycleCriterion::Triangle,
                                         CycleCriterion::Rigid};
inline constexpr std::array kCriterionNames = {"off", "triangle", "rigid"};

/// The verdicts of one criterion on the pairs of a single contact.
struct Score {
  int welded = 0, false_soon = 0, false_later = 0, missed = 0;
};

/// Why `rigid` was wrong: the first of the contacts that held the pair to be lost, or why they were
/// not enough.
struct Causes {
  int hit = 0;       ///< false: something met the group from outside before
  int opened = 0;    ///< false: a contact opened
  int slid = 0;      ///< false: a contact slid, on the edge of its friction cone
  int crept = 0;     ///< false: a contact slipped inside its cone: the solver had not converged
  int none = 0;      ///< false, with all contacts that held the pair still there
  int early = 0;     ///< missed: held by contacts of which some were not ready yet
  int balanced = 0;  ///< missed: free to turn, but in balance
};

struct Judgement {
  std::array<Score, 3> scores;  ///< as kCriteria
  Causes causes;

  Judgement& operator+=(const Judgement& more);
};

/// Judges a scene at times in [from, until].
Judgement judgeScene(const Scene& scene, double from, double until);

}  // namespace merge2d
