#include <algorithm>
#include <span>

#include "api/handles.h"

using merge2d::given;
using merge2d::guarded;

namespace merge2d {
namespace {

std::size_t bodiesOf(const m2_world& world) { return world.world.bodies().size(); }

/// Room for all bodies that may come: only pages that are used take memory.
template <class T>
std::unique_ptr<T[]> room(std::size_t columns) {
  return std::make_unique_for_overwrite<T[]>(columns * SceneLimits::kBodies);
}

/// Brings the arrays that somebody watches up to date.
void refresh(m2_world& world) {
  WatchedArrays& watched = world.watched;
  if (!watched.poses && !watched.velocities && !watched.collections) return;
  const std::size_t count = bodiesOf(world);
  if (watched.poses) world.world.poses({watched.poses.get(), 3 * count});
  if (watched.velocities) world.world.velocities({watched.velocities.get(), 3 * count});
  if (watched.collections) world.world.collections({watched.collections.get(), count});
}

/// Begins to watch an array.
template <class T>
const T* watch(m2_world* world, std::unique_ptr<T[]> WatchedArrays::*array, std::size_t columns) {
  const T* found = nullptr;
  guarded([&] {
    m2_world& w = given(world, "world");
    if (!(w.watched.*array)) {
      w.watched.*array = room<T>(columns);
      refresh(w);
    }
    found = (w.watched.*array).get();
  });
  return found;
}

}  // namespace
}  // namespace merge2d

void m2_world::changed() {
  records.captured = located = false;
  merge2d::refresh(*this);
}

m2_status m2_world_poses(const m2_world* world, double* out, size_t count) {
  return guarded([&] { given(world, "world").world.poses({&given(out, "out"), count}); });
}

m2_status m2_world_velocities(const m2_world* world, double* out, size_t count) {
  return guarded([&] { given(world, "world").world.velocities({&given(out, "out"), count}); });
}

m2_status m2_world_collections_of(const m2_world* world, int32_t* out, size_t count) {
  return guarded([&] { given(world, "world").world.collections({&given(out, "out"), count}); });
}

const double* m2_world_watch_poses(m2_world* world) {
  return merge2d::watch(world, &WatchedArrays::poses, 3);
}

const double* m2_world_watch_velocities(m2_world* world) {
  return merge2d::watch(world, &WatchedArrays::velocities, 3);
}

const int32_t* m2_world_watch_collections(m2_world* world) {
  return merge2d::watch(world, &WatchedArrays::collections, 1);
}
