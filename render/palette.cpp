#include "render/palette.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "render/theme.h"

namespace merge2d {
namespace {

bool before(const std::pair<CollectionId, std::size_t>& entry, CollectionId id) {
  return entry.first < id;
}

/// The collections that have a contact with `id`, with repetitions.
std::vector<CollectionId> neighbours(const Snapshot& snapshot, CollectionId id) {
  const auto collection = [&](BodyId body) {
    const auto found = std::ranges::lower_bound(snapshot.bodies, body, {}, &BodyState::id);
    return found != snapshot.bodies.end() && found->id == body ? found->collection : kNoCollection;
  };
  std::vector<CollectionId> out;
  for (const ContactView& contact : snapshot.contacts) {
    if (contact.internal) continue;
    const CollectionId a = collection(contact.a), b = collection(contact.b);
    if (a == id && b != id) out.push_back(b);
    if (b == id && a != id) out.push_back(a);
  }
  return out;
}

}  // namespace

std::size_t slotOf(const CollectionSlots& slots, CollectionId id) {
  const auto found = std::lower_bound(slots.begin(), slots.end(), id, before);
  return found != slots.end() && found->first == id ? found->second : 0;
}

CollectionSlots CollectionColors::update(const Snapshot& snapshot) {
  CollectionSlots alive;
  std::vector<const CollectionView*> added;
  for (const CollectionView& collection : snapshot.collections) {
    const auto at = std::lower_bound(known_.begin(), known_.end(), collection.id, before);
    if (at != known_.end() && at->first == collection.id) {
      alive.push_back(*at);
    } else {
      added.push_back(&collection);
    }
  }
  for (const CollectionView* collection : added) {
    const std::pair entry{collection->id, choose(snapshot, *collection, alive)};
    const auto insert = [&](CollectionSlots& slots) {
      slots.insert(std::lower_bound(slots.begin(), slots.end(), entry.first, before), entry);
    };
    insert(known_);
    insert(alive);
  }
  return alive;
}

/// Not the colour of a neighbour, then the one whose nearest bearer is farthest away, then not the
/// faint one, then the one that was given out longest ago.
std::size_t CollectionColors::choose(const Snapshot& snapshot, const CollectionView& added,
                                     const CollectionSlots& alive) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::array<bool, Theme::kCollections> touching{};
  std::array<double, Theme::kCollections> distance;
  distance.fill(kFar);
  for (const CollectionId id : neighbours(snapshot, added.id)) {
    const auto at = std::lower_bound(alive.begin(), alive.end(), id, before);
    if (at != alive.end() && at->first == id) touching[at->second] = true;
  }
  for (const CollectionView& other : snapshot.collections) {
    const auto at = std::lower_bound(alive.begin(), alive.end(), other.id, before);
    if (at == alive.end() || at->first != other.id) continue;
    distance[at->second] = std::min(distance[at->second], (other.x - added.x).norm());
  }
  last_use_.resize(Theme::kCollections);
  const auto cost = [&](std::size_t slot) {
    return std::tuple{touching[slot], -distance[slot], slot == Theme::kFaint, last_use_[slot],
                      slot};
  };
  std::size_t best = 0;
  for (std::size_t slot = 1; slot < Theme::kCollections; ++slot) {
    if (cost(slot) < cost(best)) best = slot;
  }
  last_use_[best] = ++choices_;
  return best;
}

}  // namespace merge2d
