#include "src2d/contact/followed_hits.h"

#include <algorithm>
#include <vector>

#include "src2d/contact/table.h"

namespace merge2d {
namespace {

/// The islands of all bodies in contact, by their pairs of bodies.
class PairIslands {
 public:
  PairIslands(const State& state, DisjointSets& sets) : state_(state), sets_(sets) {
    sets_.reset(state.rigids.size());
    const ContactKey* last = nullptr;
    for (const ContactTable::Slot slot : state.contacts.order) {
      const Contact& contact = state.contacts[slot];
      if (contact.count == 0) continue;
      const ContactKey& key = contact.key;
      if (!last || last->a != key.a || last->b != key.b) add(key);
      last = &key;
    }
  }

  /// The number of pairs in the island of a contact.
  std::size_t sizeOf(const ContactKey& key) const {
    const std::uint32_t island = sets_.find(moverOf(key));
    const auto in_island = [&](std::uint32_t rigid) { return sets_.find(rigid) == island; };
    auto count = static_cast<std::size_t>(std::ranges::count_if(pairs_, in_island));
    for (const Collection& c : state_.collections) {
      const bool counts = c.id != kNoCollection && in_island(static_cast<std::uint32_t>(c.rigid));
      if (counts) count += c.welds.size();
    }
    return count;
  }

 private:
  void add(const ContactKey& key) {
    pairs_.push_back(moverOf(key));
    if (state_.responds(key.a) && state_.responds(key.b)) sets_.unite(rigid(key.a), rigid(key.b));
  }
  std::uint32_t rigid(BodyId body) const { return static_cast<std::uint32_t>(state_[body].rigid); }
  std::uint32_t moverOf(const ContactKey& key) const {
    return rigid(state_.responds(key.a) ? key.a : key.b);
  }

  const State& state_;
  DisjointSets& sets_;
  std::vector<std::uint32_t> pairs_;  ///< of each pair, a rigid thing of its island
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
