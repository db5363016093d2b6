#pragma once
/// The merge criteria of one pair of bodies in contact (Section 5).

#include <string_view>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Contact points of a pair that carry a force.
int activePoints(const State& state, const BodyPair& pair);

/// The impulse of a contact in this step, along its normal and tangent [N s].
Vec2 impulseOf(const Contact& contact);

/// Tests the merge criteria of one pair, and writes them down when somebody asks.
class PairTest {
 public:
  PairTest(const State& state, const BodyPair& pair, Notes* notes)
      : state_(state), pair_(pair), notes_(notes), first_(notes ? notes->decisions.size() : 0) {}

  /// True when the pair passes all of them in this step.
  bool ready();

  /// Writes the count before and after this step into the noted tests of the pair.
  void noteCount(int before, int now) const;

 private:
  bool below(std::string_view criterion, std::string_view equation, double value,
             double threshold) {
    return note(criterion, equation, value, threshold, value < threshold);
  }
  bool note(std::string_view criterion, std::string_view equation, double value, double threshold,
            bool ok);

  const State& state_;
  const BodyPair& pair_;
  Notes* notes_;
  std::size_t first_;  ///< of this pair's decisions
};

}  // namespace merge2d
