#pragma once
/// Chipmunk 7.0.3: the scene's iterations, a slop of 5 mm as Box2D's (its own is made for pixels),
/// and otherwise as it comes; it does not sleep unless asked to.

#include <chipmunk/chipmunk.h>

#include "bench/peers/peer.h"

namespace merge2d::bench {

class ChipmunkPeer final : public Peer {
 public:
  std::string name() const override { return "Chipmunk 7.0.3"; }
  void load(const Scene& scene) override;
  void add(const BodyDesc& desc) override;
  void step() override;
  std::vector<Vec2> positions() const override;

 private:
  template <typename T, void (*kFree)(T*)>
  struct Free {
    void operator()(T* object) const { kFree(object); }
  };
  template <typename T, void (*kFree)(T*)>
  using Owned = std::unique_ptr<T, Free<T, kFree>>;

  struct Scripted {
    cpBody* body;
    const Script* script;  ///< of the scene, which outlives the peer
  };

  void addShape(cpBody* body, const BodyDesc& desc, const ConvexShape& shape);

  double step_ = 0.01;  // [s]
  double time_ = 0.0;   // [s]
  // The space goes first: on its way out it looks at what it holds.
  std::vector<Owned<cpBody, cpBodyFree>> bodies_;
  std::vector<Owned<cpShape, cpShapeFree>> shapes_;
  Owned<cpSpace, cpSpaceFree> space_;
  std::vector<Scripted> scripted_;
};

}  // namespace merge2d::bench
