#include "bench/peers/merge2d_peer.h"

namespace merge2d::bench {

void Merge2dPeer::load(const Scene& scene) {
  WorldOptions options;
  options.mode = mode_;
  options.timings = false;
  // The scene is the caller's, as for the other engines.
  world_.emplace(std::shared_ptr<const Scene>(std::shared_ptr<const void>(), &scene), options);
}

std::vector<Vec2> Merge2dPeer::positions() const {
  std::vector<Vec2> result;
  for (const BodyState& body : world_->capture().bodies) result.push_back(body.x);
  return result;
}

}  // namespace merge2d::bench
