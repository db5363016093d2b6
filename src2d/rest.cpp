#include "src2d/rest.h"

#include <algorithm>
#include <cstring>

#include "src2d/sleeping/sleep.h"
#include "src2d/state_archive.h"

namespace merge2d {
namespace {

/// Sums up all fields in one number.
class StateSum : public StateWalk<StateSum> {
 public:
  template <class T>
  void plain(const T& value) {
    std::uint64_t bits = 0;
    static_assert(sizeof value <= sizeof bits);
    std::memcpy(&bits, &value, sizeof value);
    sum = (std::rotl(sum, 23) ^ bits) * 0x9e3779b97f4a7c15U;
  }
  template <class T>
  void list(const std::vector<T>& items) {
    plain(items.size());
    for (const T& item : items) (*this)(item);
  }
  std::uint64_t sum = 0;
};

/// Changes with everything that influences the steps to come, but for the time.
std::uint64_t sumOf(const State& state) {
  StateSum walk;
  walk(state.bodies, state.rigids, state.present.ids(), state.extents, state.collections.all(),
       state.next_collection, state.contacts, state.joints, state.joined_pairs,
       state.broadphase.near, state.moved, state.ready_before);
  return walk.sum;
}

/// True when nothing is new in this step.
bool nothingActs(const Setup& setup, const Scratch& scratch) {
  if (!scratch.events.empty() || !scratch.stirred.empty() || !scratch.kicks.empty()) return false;
  return std::ranges::all_of(setup.actions.scripts, [&](const Actions::Scripted& scripted) {
    return setup.state.rigid(scripted.body).still();
  });
}

bool sameLoad(const Load& a, const Load& b) {
  return a.body == b.body && a.force == b.force && a.torque == b.torque;
}

}  // namespace

bool Rest::holdsFor(const Setup& setup, const Scratch& scratch) const {
  return known_ && nothingActs(setup, scratch) &&
         std::ranges::equal(scratch.loads, loads_, sameLoad);
}

void Rest::lookAt(const Setup& setup, const Scratch& scratch) {
  constexpr int kLongest = 1024;  // steps between two comparisons
  known_ = false;
  const bool quiet = sleeps(setup.state.mode) && scratch.stats.active_bodies == 0;
  if (!quiet || !nothingActs(setup, scratch)) return forget();
  if (wait_ > 0) {
    --wait_;
    return;
  }
  const std::uint64_t sum = sumOf(setup.state);
  known_ = seen_ == sum;
  if (known_) {
    loads_ = scratch.loads;
  } else if (seen_) {
    wait_ = next_wait_;
    next_wait_ = std::min(2 * next_wait_, kLongest);
    seen_.reset();
  } else {
    seen_ = sum;
  }
}

}  // namespace merge2d
