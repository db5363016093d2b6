#pragma once
/// Non-negative least squares over a few vectors that are known by their products.

#include <span>

#include "src2d/dynamics/collections.h"

namespace merge2d {

/// The weights w >= 0 that minimise |x - sum w_i x_i| over the first `n` vectors, from the products
/// `gram` = x_i . x_j and `b` = x_i . x; the others are 0. Source: Lawson, Hanson 1974.
LoadCertificate::Weights nonNegativeFit(std::span<const double> gram,
                                        const LoadCertificate::Weights& b, std::size_t n);

}  // namespace merge2d
