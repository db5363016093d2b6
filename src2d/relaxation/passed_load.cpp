#include "src2d/relaxation/passed_load.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "src2d/collections/collection.h"
#include "src2d/collections/inner_push.h"
#include "src2d/proofs/coverage.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/load_certificate.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/relaxation/load_path.h"
#include "src2d/relaxation/region_members.h"

namespace merge2d {
namespace {

/// The part of a load that the impulses inside leave.
struct Remainder {
  std::vector<MemberLoad> loads;  ///< on members that move faster than the tolerance
  double speed = 0.0;             ///< of the others [m/s]
};

Remainder remainderOf(const State& state, Collection& c, const CollectionLoad& load,
                      double tolerance) {
  const Imbalance imbalance(state, c, load);
  Remainder rest{{}, imbalance.fastestOfOthers()};
  for (const MemberLoad& one : imbalance.unbalanced()) {
    const double speed = cornerSpeed(state, c, one.member, one.gain);
    if (speed > tolerance) {
      rest.loads.push_back(one);
    } else {
      rest.speed = std::max(rest.speed, speed);
    }
  }
  return rest;
}

}  // namespace

bool passesOn(const State& state, const Scratch& scratch, Collection& c,
              const CollectionLoad& load) {
  if (!opensInPart(state, c) || !isNewOutsideAlone(state, c, load)) return false;
  const double tolerance = toleratedResidual(state);
  const Remainder rest = remainderOf(state, c, load, tolerance);
  listWeldsOfMembers(c);
  LoadPath path(state, scratch, c);
  if (!path.find(rest.loads, load.frame, kDecided.tolerance * tolerance)) return false;
  path.apply(c);
  renewPush(state, c, path.members());
  c.residual = static_cast<float>(rest.speed);
  LoadCertificate& proof = c.certificate.front();
  proof.search = {};  // one ahead: its load lacks the columns of this one
  Witness witness = asWitness(state, c, load);
  readImpulses(c, witness);
  witness.motion = 2.0 * rest.speed;  // of two members against each other
  remember(state, c, std::move(witness));
  carryByLatest(c);
  proof.in_doubt = false;
  return true;
}

}  // namespace merge2d
