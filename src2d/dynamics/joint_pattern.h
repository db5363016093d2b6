#pragma once
/// In which order the joints of an island are eliminated, and where their matrix fills in.

#include <cstdint>
#include <utility>
#include <vector>

namespace merge2d {

/// The bodies at both ends of a joint, as indices into the velocities; kFixedEnd: none that
/// responds.
using JointEnds = std::pair<std::uint32_t, std::uint32_t>;
inline constexpr std::uint32_t kFixedEnd = ~0u;

/// The lower triangle of L in J M⁻¹ Jᵀ = L D Lᵀ, in blocks of one joint each. Column c stands for
/// joint `order[c]`; below its diagonal it has blocks in the rows[first[c]] … rows[first[c + 1]].
struct JointPattern {
  std::vector<JointEnds> ends;          ///< per joint: the ends for which it was made
  std::vector<std::uint32_t> order;     ///< without those that are left out
  std::vector<std::uint32_t> left_out;  ///< joints in a crowd that would fill the matrix
  std::vector<std::uint32_t> first, rows;
};

/// By minimum degree, of equals the first joint: chains and trees of joints fill in no blocks but
/// those between joints of one body.
JointPattern eliminationPattern(std::vector<JointEnds> ends);

}  // namespace merge2d
