#pragma once
/// The simulator: a scene that moves on by time steps.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "src2d/scene/scene.h"
#include "src2d/trace/notes.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

struct State;
struct Scratch;

/// Sees a world after each stage of a step. Read-only: a watched world equals an unwatched one.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void afterStage(Stage stage, const State& state, const Scratch& scratch) = 0;
};

struct WorldOptions {
  Mode mode = Mode::MergeSleep;
  bool timings = true;     ///< measure the seconds per stage
  bool decisions = false;  ///< note every test of a criterion, and what else `notes` holds
};

class World {
 public:
  /// Keeps a copy of the scene.
  explicit World(const Scene& scene, const WorldOptions& options = {});
  /// Shares the scene with others.
  explicit World(std::shared_ptr<const Scene> scene, const WorldOptions& options = {});
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Advances the state by one time step: Algorithm 1. Throws SimulationError when a number stops
  /// being finite.
  void step();

  std::int64_t steps() const;  ///< taken so far
  double time() const;         ///< [s]
  const Scene& scene() const;
  Mode mode() const;
  /// All bodies of the run by id, also those that are not emitted yet; never changes.
  const std::vector<BodyInfo>& bodies() const;
  /// All that influences the steps to come, as bytes: a world of the same scene and mode that takes
  /// them over continues bit for bit as this one does.
  std::string save() const;
  /// Takes over what `save` gave. `source` names the bytes in messages. Throws InputError when they
  /// are damaged, or of another version, scene or mode.
  void restore(std::string_view bytes, const std::string& source);

  std::size_t memoryBytes() const;  ///< held by the simulation's tables

  /// Fills `out` with what can be seen now, reusing its memory.
  void capture(Snapshot& out) const;
  Snapshot capture() const;
  /// Statistics and events of the last step alone: cheap.
  const Stats& stats() const;
  const std::vector<Event>& events() const;

  /// Whether the following steps note their decisions.
  void takeNotes(bool on);
  /// What the stages of the last step wrote down; empty when nobody asked.
  const Notes& notes() const;

  /// Called after each stage of each step; null for none. The world does not own it.
  void observe(Observer* observer);

  /// An impulse [N s] at a world point, given at the start of the next step.
  void applyImpulse(BodyId body, const Vec2& at, const Vec2& impulse);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace merge2d
