#pragma once
/// Situations that a careless step would make grow faster than linearly.

#include <functional>
#include <vector>

namespace merge2d::bench {

constexpr int kHuge = 99'000;  ///< bodies of which one run counts, as it takes half a minute

/// Gives the seconds of a step with `n` bodies, or so.
struct Situation {
  const char* name;
  double limit;  ///< of the exponent
  std::vector<int> sizes;
  std::function<double(int n)> seconds;
  /// The same step without the disturbance: the ratio of the two is printed as well.
  std::function<double(int n)> without = nullptr;
};

const std::vector<Situation>& situations();

}  // namespace merge2d::bench
