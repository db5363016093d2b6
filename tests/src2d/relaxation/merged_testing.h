#pragma once
/// A collection on the ground, to look into.

#include <stdexcept>

#include "src2d/collections/collection.h"
#include "src2d/collections/inner_push.h"
#include "src2d/proofs/collection_load.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/relaxation/load_path.h"
#include "src2d/setup.h"
#include "src2d/state_file.h"
#include "tests/support/merging_testing.h"

namespace merge2d {

/// A scene whose boxes have merged on the ground.
class Merged {
 public:
  explicit Merged(const Scene& scene) {
    Simulation run(scene, Mode::Merge);
    run.until(2.0);
    setUp(run.world().scene(), Mode::Merge, setup_);
    restoreState(run.world().save(), "world", run.world().scene(), setup_);
    scratch_.open.assign(state().bodies.size(), 0);
    bringBlocksBack(state(), collection());
    writeImpulses(collection());
    listWeldsOfMembers(collection());
    layOutPush(state(), collection());
  }

  State& state() { return setup_.state; }
  Collection& collection() {
    for (Collection& c : state().collections) {
      if (c.id != kNoCollection) return c;
    }
    throw std::logic_error("nothing has merged");
  }
  Scratch& scratch() { return scratch_; }
  std::uint32_t last() { return static_cast<std::uint32_t>(collection().members.size()) - 1; }
  LoadPath path() { return {state(), scratch_, collection()}; }
  void open(std::uint32_t member) { scratch_.open[index(collection().members[member])] = 1; }

  /// The load on the collection where an impulse acts on one member alone [N s].
  CollectionLoad loadWith(std::uint32_t member, const Vec2& impulse) {
    outer_.member = member;
    outer_.impulse = impulse;
    CollectionLoad load = loadOn(state(), scratch_, collection());
    load.outer = {&outer_, 1};
    load.outer_norm = impulse.norm() / state()[collection().members[member]].mass;
    return load;
  }

  void expectAdmissible() {
    for (const ContactBlock& k : collection().blocks) {
      for (int i = 0; i < k.count; ++i) {
        EXPECT_GE(k.lambda_n(i), -1e-12);
        EXPECT_LE(std::abs(k.lambda_t(i)), k.mu * k.lambda_n(i) + 1e-9);
      }
    }
  }

 private:
  merge2d::Setup setup_;
  Scratch scratch_;
  OuterLoad outer_;
};

}  // namespace merge2d
