#pragma once
/// Snapshots into a recording.

#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "lessons/keyframes.h"
#include "lessons/recording.h"
#include "render/palette.h"

namespace merge2d {

/// Adds one step after the other. `out` holds the bodies already, and must outlive the feed.
class SnapshotFeed {
 public:
  explicit SnapshotFeed(Recording& out);
  /// Contacts and decisions are kept in steps that are multiples of Recording::every.
  void add(const Snapshot& seen);
  /// To be called after the last step of a run that is kept in keyframes.
  void finish();

 private:
  void addBodies(const Snapshot& seen);
  void addContacts(const Snapshot& seen);
  ContactTrack& contactTrack(const ContactView& c);
  void addDecision(std::int64_t step, Decision d);

  Recording& out_;
  CollectionColors colors_;
  std::optional<KeyframeFilter> keyframes_;  ///< of a long run
  std::map<std::tuple<std::size_t, std::size_t, std::uint32_t>, std::size_t> contact_of_;
  std::map<std::tuple<std::size_t, std::size_t, std::string, std::string>, std::size_t>
      decision_of_;
};

}  // namespace merge2d
