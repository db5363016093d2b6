#pragma once
/// How the contacts of a step are swept.

#include <cstdint>

namespace merge2d {

/// All give the same bits. A path that the processor does not have is taken as the next one.
enum class SweepPath : std::uint8_t {
  Avx2,      ///< four blocks at a time, in registers of four numbers
  Portable,  ///< four blocks at a time, in the registers that every processor of its kind has
  OneByOne,
};

#ifdef __wasm__
/// WebAssembly is compiled without vectors: four at a time would be slower.
inline constexpr SweepPath kFastestPath = SweepPath::OneByOne;
#else
inline constexpr SweepPath kFastestPath = SweepPath::Avx2;
#endif

}  // namespace merge2d
