#pragma once
/// Ourselves in one of the modes that do not sleep: nobody else here sleeps either.

#include <optional>

#include "bench/peers/peer.h"
#include "src2d/world.h"

namespace merge2d::bench {

class Merge2dPeer final : public Peer {
 public:
  explicit Merge2dPeer(Mode mode) : mode_(mode) {}

  std::string name() const override { return std::string("merge2d ") + merge2d::name(mode_); }
  void load(const Scene& scene) override;
  void add(const BodyDesc& desc) override { world_->addBody(desc); }
  void step() override { world_->step(); }
  std::vector<Vec2> positions() const override;
  std::size_t ownBytes() const override { return world_->memoryBytes(); }

 private:
  Mode mode_;
  std::optional<World> world_;
};

}  // namespace merge2d::bench
