#pragma once
/// Many bodies in one place. Each touches each of the others, so that n of them cost n² contacts,
/// and they fly apart in the first step: nobody means that.

#include <optional>
#include <string>

#include "src2d/scene/scene.h"

namespace merge2d {

/// How many other bodies may lie in the place of one: each covers a shape's centre of the other.
/// Bodies that do not collide, since they are joined or do not move, do not count.
inline constexpr std::size_t kInOnePlace = 100;
/// The same where both are held by joints, as the links of a chain that is rolled up are.
inline constexpr std::size_t kHeldInOnePlace = 1'000;

struct Crowd {
  std::string key;       ///< of the table that is to blame: "repeat"
  std::string body;      ///< its first body or its emitter: "brick[0,0]"
  std::string sentence;  ///< "2,999 bodies lie in the place of brick[0,0] …"
};

/// The first crowd of a scene, in time that grows with the number of shapes (and its logarithm).
std::optional<Crowd> findCrowd(const Scene& scene);

/// Throws InputError where there is one.
void refuseCrowds(const Scene& scene);

}  // namespace merge2d
