#pragma once
/// The impulses inside time steps: what the single sweep began with and what it left. The page
/// shows them at the stages WarmStart to SolveLCP.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "src2d/trace/snapshot.h"

namespace merge2d {

struct Recording;

/// One step. The impulses after its full solve are those of the step's end, in its ContactTracks.
struct ImpulsesInside {
  std::int64_t step = 0;
  bool sweeping = false;  ///< something was merged, so that there was a sweep

  // Per contact, in the order of the recording's tracks.
  std::vector<std::int32_t> contact;    ///< index into Recording::contacts
  std::vector<float> warm_n, warm_t;    ///< after WarmStart, before the sweep [N s]
  std::vector<float> swept_n, swept_t;  ///< after the sweep [N s]
  /// After Unmerge, with which the full solve begins: outside of collections the warm ones again;
  /// inside the swept ones, unless cuts made Unmerge sweep once more.
  std::vector<float> begin_n, begin_t;
  std::vector<std::uint8_t> inner;  ///< inside a collection during the sweep
};

/// The most contacts, over all steps, whose impulses a recording keeps.
inline constexpr std::size_t kMostImpulses = 250'000;

struct StepRecord;

/// Which track a contact belongs to.
class ContactTracks {
 public:
  /// Of the tracks that `recording` has now; it may gain more.
  void update(const Recording& recording);
  /// Index into Recording::contacts, if there is one.
  std::optional<std::int32_t> of(const ContactView& contact) const;

 private:
  std::map<std::tuple<BodyId, BodyId, std::uint32_t>, std::int32_t> index_;
};

/// The impulses inside one recorded step, for the contacts that have tracks.
ImpulsesInside impulsesInside(const StepRecord& record, const ContactTracks& tracks);

/// Looks into a recorded run once more and keeps the impulses inside its steps in
/// `recording.inside`: of `wanted` steps first, then of those in which most bodies met, merged or
/// came apart, then of all others, as long as there are no more than kMostImpulses. `progress` is
/// called after each step and may throw. A run in keyframes is left as it was recorded. Throws
/// SimulationError.
void lookInside(Recording& recording, const std::vector<std::int64_t>& wanted = {},
                const std::function<void(std::int64_t)>& progress = nullptr);

}  // namespace merge2d
