#pragma once
/// The events of a step, as plain data.

#include <array>
#include <cstdint>

#include "src2d/core/ids.h"

namespace merge2d {

enum class EventType { Merge, Unmerge, Sleep, Wake, Impact, Emit, Break };
enum class EventReason : std::uint8_t { None, Broken, Sliding, RelativeMotion, User };
inline constexpr std::array kEventReasons = {EventReason::None, EventReason::Broken,
                                             EventReason::Sliding, EventReason::RelativeMotion,
                                             EventReason::User};

/// One event. A `Merge` is a join: of two things one was made, so that n bodies need n − 1 of
/// them, however many contacts hold them together afterwards. An `Unmerge` is the end of one weld,
/// with its reason: a body that leaves two neighbours gives two of them. An `Impact` is a pair that
/// meets faster than gravity could have made it in two steps. A `Break` is the end of a joint that
/// bore too much.
struct Event {
  EventType type = EventType::Merge;
  BodyId a{}, b{};  ///< the pair; equal where one body is meant
  CollectionId collection = kNoCollection;
  EventReason reason = EventReason::None;
};

}  // namespace merge2d
