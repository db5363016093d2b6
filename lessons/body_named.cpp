#include "lessons/body_named.h"

#include <fmt/format.h>

#include <vector>

#include "src2d/core/suggest.h"

namespace merge2d {

BodyId bodyNamed(const Value& place, const Scene& scene, std::string_view wanted) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].name == wanted) return BodyId{static_cast<std::uint32_t>(i)};
    names.push_back(scene.bodies[i].name);
  }
  place.fail(fmt::format("the scene has no body '{}'{}", wanted, didYouMean(wanted, names)));
}

}  // namespace merge2d
