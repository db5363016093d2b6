#pragma once
/// A run as a lesson needs it: every time step, kept small enough to hold thousands of them.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lessons/impulses.h"
#include "render/palette.h"
#include "src2d/core/notes.h"
#include "src2d/scene/scene.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

/// Consecutive samples of something that comes and goes: the first one, and how many. Sample i is
/// of step i * Recording::every.
struct Span {
  std::int64_t first = 0;
  std::int64_t count = 0;
};

/// A body from its first step on: a sample for each step, or keyframes (lessons/keyframes.h).
struct BodyTrack {
  std::int64_t first = 0;
  std::vector<std::int32_t> at;      ///< steps of the keyframes; empty: each step from `first` on
  std::vector<double> x, y, angle;   ///< centre of mass [m], [rad]
  std::vector<float> vx, vy, omega;  ///< [m/s], [rad/s]
  std::vector<std::int32_t> collection;
  std::vector<std::uint8_t> asleep;

  /// One more sample.
  void append(const BodyState& body);
};

/// A contact point while it exists. Its place is kept in the frame of body a, where it rests while
/// the bodies move together.
struct ContactTrack {
  BodyId a{}, b{};
  std::uint32_t feature = 0;
  double mu = 0.0;
  std::vector<Span> spans{};
  std::vector<float> x{}, y{}, normal{};      ///< in a's frame [m], [rad]
  std::vector<float> gap{};                   ///< [m]
  std::vector<float> lambda_n{}, lambda_t{};  ///< [N s]
  std::vector<float> w_n{}, w_t{};            ///< [m/s]
  std::vector<std::uint8_t> state{};          ///< ContactState
  std::vector<std::uint8_t> internal{}, fresh{};
};

/// One criterion about one pair, in the steps in which it was tested. Of several contact points of
/// a pair the one nearest to its limit counts.
struct DecisionTrack {
  BodyId a{}, b{};
  std::string stage{}, criterion{}, equation{};
  double threshold = 0.0;
  int needed = 0;
  std::vector<Span> spans{};
  std::vector<float> value{};
  std::vector<std::uint8_t> count{};
  std::vector<std::uint8_t> passed{};  ///< "merge", "keep", "below": the pair stays or may merge
};

struct TimedEvent {
  std::int64_t step = 0;
  Event event;
};

/// Momentum and energy of all bodies that respond to forces, about one stage.
struct LedgerEntry {
  std::int64_t step = 0;
  Stage stage = Stage::Merge;  ///< Unmerge or Merge
  struct Sums {
    double px = 0.0, py = 0.0;  ///< [N s]
    double angular = 0.0;       ///< about the world's origin [N m s]
    double kinetic = 0.0;       ///< [J]
  } before, after;
  bool anchored = false;  ///< something was welded to a fixed body, which takes momentum up
};

/// The breadth-first order of the sweep in a step with something new.
struct SweepOrder {
  std::int64_t step = 0;
  std::vector<NotedVisit> visits;
};

/// The slot of the palette that a collection has for life.
struct CollectionColor {
  CollectionId id{};
  std::size_t slot = 0;
};

/// How much of a run is kept.
enum class Detail {
  Motion,  ///< bodies, collections, events, statistics: a ghost, a what-if
  Full,    ///< contacts and decisions too
};

struct Recording {
  Scene scene;
  Mode mode = Mode::MergeSleep;
  Detail detail = Detail::Full;
  std::int64_t steps = 0;
  /// Above 1 for a long run: bodies are kept in keyframes, and contacts, decisions, the ledger and
  /// the impulses inside steps for steps that are multiples of it.
  std::int64_t every = 1;
  std::vector<BodyInfo> bodies;
  std::vector<BodyTrack> tracks;  ///< per body
  std::vector<ContactTrack> contacts;
  std::vector<DecisionTrack> decisions;
  std::vector<TimedEvent> events;  ///< in order
  std::vector<Stats> stats;        ///< per step from 0; seconds are left out
  std::vector<CollectionColor> colors;
  std::vector<SweepOrder> orders;  ///< of the first kMostOrders steps with something new
  static constexpr std::size_t kMostOrders = 60;
  static constexpr std::size_t kMostVisits = 400;
  std::vector<LedgerEntry> ledger;     ///< of each stage that merged or unmerged something
  std::vector<ImpulsesInside> inside;  ///< of steps that were looked into, those worth most first

  bool present(BodyId body, std::int64_t step) const {
    const BodyTrack& track = tracks[index(body)];
    const std::int64_t end = track.at.empty()
                                 ? track.first + static_cast<std::int64_t>(track.x.size())
                                 : track.at.back() + std::int64_t{1};
    return step >= track.first && step < end;
  }
  /// The sample of a step in which the body is present: of keyframes the last one up to it.
  std::size_t sample(BodyId body, std::int64_t step) const {
    const BodyTrack& track = tracks[index(body)];
    if (track.at.empty()) return static_cast<std::size_t>(step - track.first);
    const auto after = std::ranges::upper_bound(track.at, step);
    return static_cast<std::size_t>(after - track.at.begin()) - 1;
  }
  /// The sample of a contact or decision at a step, in a long run at the last step that was kept.
  std::optional<std::size_t> sampleAt(const std::vector<Span>& spans, std::int64_t step) const;
  CollectionId collection(BodyId body, std::int64_t step) const {
    if (!present(body, step)) return kNoCollection;
    return CollectionId{tracks[index(body)].collection[sample(body, step)]};
  }
};

struct RecordOptions {
  Mode mode = Mode::MergeSleep;
  Detail detail = Detail::Full;
  std::int64_t steps = 0;
  std::function<void(std::int64_t)> progress = nullptr;  ///< called after each step; may throw
  /// Steps times bodies up to which each step is kept in full; longer runs are kept in keyframes.
  std::int64_t most_in_full = 3'000'000;
  /// Of a longer run, as many states of a body are kept together with their contacts.
  std::int64_t most_with_contacts = 600'000;
};

/// Notes the order of the sweep of a step with something new, as long as there is room.
void keepOrder(const Notes& notes, std::int64_t step, Recording& out);

/// Runs a scene and keeps what it does. Throws SimulationError.
Recording record(const Scene& scene, const RecordOptions& options);

}  // namespace merge2d
