#pragma once
/// Products of loads, by which they are compared [m²/s²].

#include "src2d/proofs/decided_settings.h"

namespace merge2d {

/// Of a velocity from outside, beside those of the frame.
inline constexpr double kOuterWeight = kDecided.outer_weight;

inline double dot(const FrameLoad& x, const FrameLoad& y) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

/// Of the loads of two witnesses of one certificate.
inline double product(const Witness& x, const Witness& y) {
  double sum = dot(x.frame, y.frame);
  for (std::size_t k = 0; k < x.outer.size(); ++k) {
    sum += kOuterWeight * kOuterWeight * dot(x.outer[k], y.outer[k]);
  }
  return sum;
}

}  // namespace merge2d
