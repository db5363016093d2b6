#include "src2d/relaxation/reached_collection.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "src2d/collections/collection.h"
#include "src2d/collections/inner_push.h"
#include "src2d/proofs/collection_load.h"
#include "src2d/proofs/coverage.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/relaxation/region_loads.h"
#include "src2d/relaxation/region_members.h"

namespace merge2d {
namespace {

/// A blow moves one that floats faster than an impact is.
bool isStruck(const State& state, const Collection& c, const CollectionLoad& load) {
  return !state[c.rigid].floating() || load.norm > impactSpeed(state);
}

/// Those on which something acts from outside.
std::vector<std::uint32_t> membersActedOn(const CollectionLoad& load) {
  std::vector<std::uint32_t> members;
  for (const OuterLoad& outer : load.outer) members.push_back(outer.member);
  return members;
}

/// The members that cannot pass on the loads that the solve has put on them.
std::vector<std::uint32_t> overloadedMembers(State& state, const Scratch& scratch, Collection& c) {
  const CollectionLoad load = loadOn(state, scratch, c);
  if (!isStruck(state, c, load) || coverageOf(state, c, load).carried.holds) return {};
  bringBlocksBack(state, c);
  c.certificate.front().last_doubt = state.step;
  writeImpulses(c);
  listWeldsOfMembers(c);
  if (state[c.rigid].floating()) return membersActedOn(load);
  layOutPush(state, c);
  return findDisturbed(state, scratch, c, true);
}

void recordOpened(const State& state, const Scratch& scratch, const Collection& c) {
  if (!scratch.notes) return;
  const BodyId first = state.firstBody(c.rigid);
  scratch.notes->decisions.push_back(
      record(kNeighbourHit, "SingleIterationPGS", first, first, "open"));
}

}  // namespace

void beginReached(const State& state, const Scratch& scratch, const Collection& c,
                  OpenRegion& region) {
  region.slot = static_cast<std::uint32_t>(state.collections.slotOf(c));
  const CollectionLoad load = loadOn(state, scratch, c);
  region.outer.assign(load.outer.begin(), load.outer.end());
  region.passes = true;
}

bool openReached(State& state, Scratch& scratch, OpenRegion& region) {
  Collection& c = state.collections[region.slot];
  const std::int64_t last = std::exchange(c.hits.blow, state.step);
  const std::vector<std::uint32_t> overloaded = overloadedMembers(state, scratch, c);
  if (overloaded.empty()) {
    c.hits.blow = last;
    return false;
  }
  scratch.doubts[region.slot] = Doubt::Open;
  scratch.opened.push_back(c.rigid);
  recordOpened(state, scratch, c);
  if (!opensInPart(state, c)) {
    addAll(state, scratch, region);
    return true;
  }
  for (const std::uint32_t m : overloaded) addMember(state, scratch, region, m);
  return true;
}

}  // namespace merge2d
