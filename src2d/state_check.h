#pragma once
/// Whether a state that was read from bytes can be used: every index points at something that is
/// there, lists that belong together are equally long, and sorted lists are in order. Bytes may be
/// damaged, or made by somebody with bad intentions.

#include <string>
#include <vector>

#include "src2d/setup.h"

namespace merge2d {

/// The state that was read, beside the tables that the scene gives.
struct RestoredState {
  const Setup& restored;
  const std::vector<Body>& bodies;  ///< as they are at the start of the scene
  std::size_t extents = 0;          ///< of bodies, at the start of the scene
  std::size_t launches = 0;         ///< the same
  const std::vector<Aabb>& boxes;   ///< of rigid things that are present
};

/// Throws InputError, with `source` in front, at the first fault.
void checkRestored(const RestoredState& of, const std::string& source);

}  // namespace merge2d
