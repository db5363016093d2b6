#pragma once
/// A run as a lesson needs it: every time step, kept small enough to hold thousands of them.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lessons/impulses.h"
#include "render/palette.h"
#include "src2d/scene/scene.h"
#include "src2d/trace/notes.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

/// Consecutive samples of something that comes and goes: the first step, and how many.
struct Span {
  std::int64_t first = 0;
  std::int64_t count = 0;
};

/// A body from its first step on.
struct BodyTrack {
  std::int64_t first = 0;
  std::vector<double> x, y, angle;   ///< centre of mass [m], [rad]
  std::vector<float> vx, vy, omega;  ///< [m/s], [rad/s]
  std::vector<std::int32_t> collection;
  std::vector<std::uint8_t> asleep;
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
    return step >= track.first && step < track.first + static_cast<std::int64_t>(track.x.size());
  }
  std::size_t sample(BodyId body, std::int64_t step) const {
    return static_cast<std::size_t>(step - tracks[index(body)].first);
  }
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
};

/// Runs a scene and keeps what it does. Throws SimulationError.
Recording record(const Scene& scene, const RecordOptions& options);

}  // namespace merge2d
