/// The functions of wide_block.h, compiled once for each set of instructions.

#include "src2d/dynamics/wide_block.h"
#include "src2d/scene/compliance.h"

namespace merge2d {

// Vectors are passed by reference, and within this file: no interface depends on how.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace portable {
#include "src2d/dynamics/wide_kernel.h"
#include "src2d/dynamics/wide_nncg_kernel.h"
#include "src2d/dynamics/wide_rows_kernel.h"
constexpr WideKernels kKernels{warmStartWide,  sweepWide,  makeRowsWide,
                               velocitiesWide, changeWide, stepWide};
}  // namespace portable

#if defined(__x86_64__) && !defined(__AVX2__)
#define MERGE2D_HAS_AVX2
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace avx2 {
#include "src2d/dynamics/wide_kernel.h"
#include "src2d/dynamics/wide_nncg_kernel.h"
#include "src2d/dynamics/wide_rows_kernel.h"
constexpr WideKernels kKernels{warmStartWide,  sweepWide,  makeRowsWide,
                               velocitiesWide, changeWide, stepWide};
}  // namespace avx2
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

#pragma GCC diagnostic pop

const WideKernels& wideKernels([[maybe_unused]] SweepPath path) {
#ifdef MERGE2D_HAS_AVX2
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (path == SweepPath::Avx2 && has_avx2) return avx2::kKernels;
#endif
  return portable::kKernels;
}

}  // namespace merge2d
