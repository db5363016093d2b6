#include "src2d/trace/snapshot.h"

namespace merge2d {

const char* name(EventType type) {
  static constexpr const char* kNames[] = {"merge",  "unmerge", "sleep", "wake",
                                           "impact", "emit",    "break"};
  return kNames[static_cast<std::size_t>(type)];
}

const char* name(EventReason reason) {
  static constexpr const char* kNames[kEventReasons.size()] = {"none", "broken", "sliding",
                                                               "relative-motion", "user"};
  return kNames[static_cast<std::size_t>(reason)];
}

const char* name(ContactState state) {
  static constexpr const char* kNames[] = {"broken", "sticking", "sliding"};
  return kNames[static_cast<std::size_t>(state)];
}

const char* name(Mode mode) {
  static constexpr const char* kNames[] = {"reference", "sleep", "merge", "merge+sleep"};
  return kNames[static_cast<std::size_t>(mode)];
}

const char* name(Motion motion) {
  static constexpr const char* kNames[] = {"dynamic", "pinned", "scripted"};
  return kNames[static_cast<std::size_t>(motion)];
}

}  // namespace merge2d
