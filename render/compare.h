#pragma once
/// Are two pictures the same? Not to the bit: processors round the last bit differently.

#include <filesystem>
#include <string>

#include "render/picture.h"

namespace merge2d {

struct PictureDifference {
  bool same_size = true;
  double fraction = 0.0;  ///< of pixels that differ by more than the tolerance
  int largest = 0;        ///< difference of a channel
};

/// `tolerance` per channel, of 255.
PictureDifference comparePictures(const Picture& a, const Picture& b, int tolerance = 2);

/// Where the pictures differ, in red over a pale copy of the first.
Picture differencePicture(const Picture& a, const Picture& b, int tolerance = 2);

/// Compares a picture with the one in a file. An empty answer means that they agree; otherwise it
/// says how they differ and where the picture and its difference picture were put: in the folder
/// `out`, under the same name.
std::string compareWithReference(const Picture& picture, const std::filesystem::path& reference,
                                 const std::filesystem::path& out, double allowed_fraction = 0.002);

}  // namespace merge2d
