#include "src2d/contact/followed_hits.h"

#include <algorithm>
#include <vector>

#include "src2d/contact/table.h"

namespace merge2d {
namespace {

/// How many pairs of bodies in contact the islands have.
class PairIslands {
 public:
  PairIslands(const State& state, DisjointSets& sets) : state_(state), sets_(sets) {
    sets_.reset(state.rigids.size());
    std::vector<std::uint32_t> movers;  // of each pair
    const ContactKey* last = nullptr;
    for (const ContactTable::Slot slot : state.contacts.order) {
      const Contact& contact = state.contacts[slot];
      if (contact.count == 0) continue;
      const ContactKey& key = contact.key;
      if (!last || last->a != key.a || last->b != key.b) {
        movers.push_back(moverOf(key));
        unite(key);
      }
      last = &key;
    }
    pairs_.assign(state.rigids.size(), 0);
    for (const std::uint32_t mover : movers) pairs_[sets_.find(mover)] += 1;
    for (const Collection& c : state.collections) {
      if (c.id == kNoCollection) continue;
      pairs_[sets_.find(static_cast<std::uint32_t>(c.rigid))] += c.welds.size();
    }
  }

  /// Of the island of a contact.
  std::size_t sizeOf(const ContactKey& key) const { return pairs_[sets_.find(moverOf(key))]; }

 private:
  void unite(const ContactKey& key) {
    if (state_.responds(key.a) && state_.responds(key.b)) sets_.unite(rigid(key.a), rigid(key.b));
  }
  std::uint32_t rigid(BodyId body) const { return static_cast<std::uint32_t>(state_[body].rigid); }
  std::uint32_t moverOf(const ContactKey& key) const {
    return rigid(state_.responds(key.a) ? key.a : key.b);
  }

  const State& state_;
  DisjointSets& sets_;
  std::vector<std::size_t> pairs_;  ///< per island, at its name
};

}  // namespace

void followSoftHits(State& state, Scratch& scratch, std::span<const SoftHit> soft) {
  constexpr std::size_t kFew = 16;  // pairs of bodies
  if (soft.empty()) return;
  const PairIslands islands(state, scratch.sets);
  for (const SoftHit& hit : soft) {
    if (islands.sizeOf(hit.cast.key) > kFew) continue;
    state.contacts[*findContact(state.contacts, hit.cast.key)] = hit.contact;
    scratch.casts.push_back(hit.cast);
  }
}

}  // namespace merge2d
