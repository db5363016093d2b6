#pragma once
/// One scene in the four modes, side by side.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/creep.h"
#include "app/hits.h"
#include "app/simulation.h"
#include "app/timed_run.h"

namespace merge2d {

inline constexpr std::array<Mode, 4> kModes = {Mode::Reference, Mode::Sleep, Mode::Merge,
                                               Mode::MergeSleep};

/// The time and the events of one step.
struct StepRow {
  StepTime time;  ///< zero without timings
  int active_bodies = 0, contacts = 0, internal_contacts = 0;
  int collections = 0, asleep = 0;
  int merges = 0, unmerges = 0, broken_joints = 0;
  double max_penetration = 0.0;  ///< [m]
};

/// How far the bodies' centres are from where they are in the reference.
struct Distance {
  double time = 0.0;     ///< [s]
  double mean = 0.0;     ///< over the dynamic bodies [m]
  double largest = 0.0;  ///< [m]
};

double meanMs(std::span<const StepRow> steps);
double medianMs(std::span<const StepRow> steps);
/// The mean over the steps of one of their numbers.
double mean(std::span<const StepRow> steps, int StepRow::*number);
double meanMs(std::span<const StepRow> steps, Stage stage);

/// A part of the run, after `from` and up to `to` [s].
struct Window {
  double from = 0.0, to = 0.0;
};

/// The run of one mode.
struct ModeRun {
  Mode mode = Mode::Reference;
  std::vector<StepRow> steps;
  std::vector<Distance> distances;  ///< after each step
  /// When bodies had turned by more than 45° from how they began, ascending [s]: the k-th domino
  /// falls at tipping_times[k - 1].
  std::vector<double> tipping_times;
  std::vector<Hit> hits;
  Creep creep;                   ///< in the last quarter of the run
  int flicker = 0;               ///< welds that formed and broke again within kFlickerSteps
  Stats last;                    ///< after the last step
  double max_penetration = 0.0;  ///< of all steps [m]

  /// The steps that end in the window, of `h` seconds each.
  std::span<const StepRow> within(const Window& window, double h) const;
  int merges() const;
  int unmerges() const;
  int brokenJoints() const;
  /// Merges and unmerges in the last quarter of the run: none, once a scene has settled.
  int lateEvents() const;
  double largestDistance() const;  ///< at any step [m]
};

/// How the times of the k-th bodies that tipped differ between two modes, of as many as both have.
struct TippingDifference {
  std::size_t compared = 0;
  double mean = 0.0, largest = 0.0;  ///< [s]
};
TippingDifference tippingDifference(const ModeRun& reference, const ModeRun& run);

inline constexpr int kFlickerSteps = 20;

/// Steps the four worlds in turns, so that a machine that is busy for a moment is busy for all of
/// them.
class Comparison {
 public:
  Comparison(std::shared_ptr<const Scene> scene, bool timings);
  ~Comparison();

  /// Takes a turn in each mode. Throws SimulationError, which names the mode, or Interrupted.
  void advance();
  bool done() const;

  const Scene& scene() const { return *scene_; }
  bool timings() const { return timings_; }
  std::int64_t steps() const { return steps_; }  ///< in all
  std::int64_t stepsDone() const;                ///< of each mode
  const std::string& nameOf(BodyId body) const;
  /// In the order of kModes.
  const std::array<ModeRun, kModes.size()>& runs() const { return runs_; }

 private:
  class Lane;

  template <class Do>
  void inEachMode(Do&& what);
  void measureDistances();

  std::shared_ptr<const Scene> scene_;
  bool timings_;
  std::int64_t steps_ = 0;
  std::array<std::unique_ptr<Lane>, kModes.size()> lanes_;
  std::array<ModeRun, kModes.size()> runs_;
};

}  // namespace merge2d
