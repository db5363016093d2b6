#pragma once
/// Non-negative least squares over a few vectors that are known by their products.

#include <span>

#include "src2d/dynamics/collections.h"

namespace merge2d {

/// The weights β ≥ 0 that minimise |ℓ − Σ βᵢ ℓᵢ| over the first `n` vectors ℓᵢ, from the products
/// `gram` = ℓᵢ · ℓⱼ and `b` = ℓᵢ · ℓ; the others are 0. Source: Lawson, Hanson 1974.
LoadCertificate::Weights nonNegativeFit(std::span<const double> gram,
                                        const LoadCertificate::Weights& b, std::size_t n);

}  // namespace merge2d
