#pragma once
/// The combination of the loads of a certificate that is nearest to another load.

#include "src2d/core/nonnegative_fit.h"
#include "src2d/dynamics/collections.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/load_product.h"

namespace merge2d {

inline constexpr std::size_t kWitnesses = LoadCertificate::kMost;

/// A load beside those of the witnesses.
struct Projection {
  LoadCertificate::Weights weights{};
  double left = 0.0;  ///< |ℓ − Σ βᵢ ℓᵢ|², of which rounding may leave less than nothing
};

/// Products of witnesses: that of i and j at kWitnesses i + j.
using WitnessGram = std::array<double, kWitnesses * kWitnesses>;

/// So little may be left over of any load [m/s]: one member gains no more by it than a search
/// leaves.
inline double leftOfRest(const State& state) { return kOuterWeight * toleratedResidual(state); }

/// The nearest combination of the first `n` loads of `gram` to one of products `b` and square `ll`.
/// Loads are known but for `rounding` [m/s]: one of nothing else must not get a weight.
inline Projection project(WitnessGram gram, const LoadCertificate::Weights& b, std::size_t n,
                          double ll, double rounding) {
  for (std::size_t i = 0; i < n; ++i) {
    gram[i * kWitnesses + i] += rounding * rounding;
  }
  Projection p{nonNegativeFit(gram, b, n), ll};
  for (std::size_t i = 0; i < n; ++i) {
    p.left -= 2.0 * p.weights[i] * b[i];
    for (std::size_t j = 0; j < n; ++j) {
      p.left += p.weights[i] * p.weights[j] * gram[i * kWitnesses + j];
    }
  }
  return p;
}

}  // namespace merge2d
