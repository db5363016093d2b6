#pragma once
/// Pixels of a drawn scene that may mean something else than they are taken for.

#include <string>
#include <vector>

#include "src2d/scene/image.h"

namespace merge2d {

/// A sentence for each kind: colours near the border of two meanings, and mixtures of their
/// neighbours, as smoothed borders have.
std::vector<std::string> doubtsAboutColours(const Image& image);

}  // namespace merge2d
