#include <algorithm>
#include <cmath>

#include "api/handles.h"

using merge2d::given;
using merge2d::guarded;
using merge2d::toVec;

namespace merge2d {
namespace {

void requireFinite(std::initializer_list<double> numbers) {
  for (const double number : numbers) {
    if (!std::isfinite(number)) throw InputError("the place of a query must be finite");
  }
}

void tell(const std::vector<BodyId>& found, m2_body* bodies, std::size_t capacity,
          std::size_t* count) {
  given(count, "count") = found.size();
  for (std::size_t i = 0; i < std::min(capacity, found.size()); ++i) {
    (&given(bodies, "bodies"))[i] = static_cast<m2_body>(found[i]);
  }
}

m2_collection_id collectionOf(const m2_world& world, m2_body body) {
  std::vector<std::int32_t> all(world.world.bodies().size());
  if (body >= all.size()) {
    throw InputError(fmt::format("there is no body {}: the world has {}", body, all.size()));
  }
  world.world.collections(all);
  return all[body];
}

}  // namespace
}  // namespace merge2d

const merge2d::BodyLocator& m2_world::places() {
  if (!located) locator.update(world);
  located = true;
  return locator;
}

m2_status m2_world_query_point(m2_world* world, m2_vec point, m2_body* bodies, size_t capacity,
                               size_t* count) {
  return guarded([&] {
    merge2d::requireFinite({point.x, point.y});
    merge2d::tell(given(world, "world").places().at(toVec(point)), bodies, capacity, count);
  });
}

m2_status m2_world_query_box(m2_world* world, m2_vec lower, m2_vec upper, m2_body* bodies,
                             size_t capacity, size_t* count) {
  const bool finite = std::isfinite(upper.x - lower.x) && std::isfinite(upper.y - lower.y);
  if (finite && (lower.x >= upper.x || lower.y >= upper.y)) {
    return guarded([&] {
      throw merge2d::InputError(
          fmt::format("the lower corner of a box is left of and below the upper one, but they are "
                      "({}, {}) and ({}, {})",
                      lower.x, lower.y, upper.x, upper.y));
    });
  }
  m2_shape box = m2_box(upper.x - lower.x, upper.y - lower.y);
  return m2_world_query_shape(world, &box, {0.5 * (lower.x + upper.x), 0.5 * (lower.y + upper.y)},
                              0.0, bodies, capacity, count);
}

m2_status m2_world_query_shape(m2_world* world, const m2_shape* shape, m2_vec position,
                               double angle, m2_body* bodies, size_t capacity, size_t* count) {
  return guarded([&] {
    merge2d::requireFinite({position.x, position.y, angle});
    const auto pieces = merge2d::toShapes(given(shape, "shape"));
    merge2d::tell(
        given(world, "world").places().touching(pieces, merge2d::Pose::at(toVec(position), angle)),
        bodies, capacity, count);
  });
}

m2_status m2_world_cast_ray(m2_world* world, m2_vec from, m2_vec to, m2_ray_hit* hit) {
  return guarded([&] {
    merge2d::requireFinite({from.x, from.y, to.x, to.y});
    m2_ray_hit& out = given(hit, "hit");
    out = {M2_NO_BODY, M2_NO_COLLECTION, 1.0, to, {0.0, 0.0}};
    const auto found = given(world, "world").places().castRay(toVec(from), toVec(to));
    if (!found) return;
    const auto body = static_cast<m2_body>(found->body);
    out = {body, merge2d::collectionOf(*world, body), found->fraction,
           merge2d::fromVec(found->point), merge2d::fromVec(found->normal)};
  });
}

m2_status m2_world_collection_of(const m2_world* world, m2_body body, m2_collection_id* id) {
  return guarded([&] { given(id, "id") = merge2d::collectionOf(given(world, "world"), body); });
}
