#pragma once
/// Box2D 2.4.1 as it comes, with its own dynamics: 10 velocity and 3 position iterations, warm
/// starting, no sleeping. Continuous collision is off, since nobody else here has it.

#include <box2d/box2d.h>

#include "bench/peers/peer.h"

namespace merge2d::bench {

class Box2dPeer final : public Peer {
 public:
  std::string name() const override { return "Box2D 2.4.1"; }
  void load(const Scene& scene) override;
  void add(const BodyDesc& desc) override;
  void step() override;
  std::vector<Vec2> positions() const override;

 private:
  struct Scripted {
    b2Body* body;
    const Script* script;  ///< of the scene, which outlives the peer
  };

  double step_ = 0.01;  // [s]
  double time_ = 0.0;   // [s]
  int iterations_ = 10;
  std::unique_ptr<b2World> world_;
  std::vector<b2Body*> bodies_;
  std::vector<Scripted> scripted_;
};

}  // namespace merge2d::bench
