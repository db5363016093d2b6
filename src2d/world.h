#pragma once
/// The simulator: a scene that moves on by time steps.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src2d/core/notes.h"
#include "src2d/core/sweep_path.h"
#include "src2d/scene/scene.h"
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
  int threads = 1;         ///< that share the work of a step; the results do not depend on it
  SweepPath sweep_path = kFastestPath;  ///< nor on this
};

/// Whether a state may be taken over that was saved under other settings or in another mode.
enum class SavedUnder : std::uint8_t { SameSettings, AnySettings };

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
  /// All bodies of the run by id, also those that are not emitted yet or have been removed; valid
  /// until a body is added.
  const std::vector<BodyInfo>& bodies() const;
  /// All that influences the steps to come, as bytes: a world of the same scene, settings and mode
  /// that takes them over continues bit for bit as this one does, also where bodies, joints or
  /// springs were added.
  std::string save() const;
  /// Takes over the bytes that `save` gave. `source` names the bytes in messages. Settings,
  /// gravity, time step and mode stay those of this world; with AnySettings the bytes may come from
  /// others. Throws InputError when they are damaged, or of another version, scene, settings or
  /// mode.
  void restore(std::string_view bytes, const std::string& source,
               SavedUnder under = SavedUnder::SameSettings);

  std::size_t memoryBytes() const;  ///< held by the simulation's tables

  /// Fills `out` with what can be seen now, reusing its memory.
  void capture(Snapshot& out) const;
  Snapshot capture() const;
  /// The same without contacts, welds, joints and decisions: what a long run can afford each step.
  void captureMotion(Snapshot& out) const;
  /// Statistics and events of the last step alone: cheap.
  const Stats& stats() const;
  const std::vector<Event>& events() const;
  /// How deep bodies overlap where the last step has changed it [m]: the largest over all steps is
  /// that of all contacts. Bodies that rest cost nothing.
  double deepestOverlap() const;

  /// Whether the following steps note their decisions.
  void takeNotes(bool on);
  /// The notes of the stages of the last step; empty when nobody asked.
  const Notes& notes() const;

  /// Called after each stage of each step; null for none. The world does not own it.
  void observe(Observer* observer);

  // Changes between two steps. Each wakes the bodies concerned and what touches them, and takes
  // them out of their collections where they could not stay; all are part of a saved state. They
  // throw InputError for a body that is not there and for numbers that are not finite.

  /// An impulse [N s] at a world point, given at the start of the next step.
  void applyImpulse(BodyId body, const Vec2& at, const Vec2& impulse);
  /// A force [N] at a world point, which acts during the next step.
  void applyForce(BodyId body, const Vec2& at, const Vec2& force);

  /// Of the centre of mass [m, rad]. The body comes free; a scripted one cannot be placed.
  void setPose(BodyId body, const Vec2& x, double angle);
  /// Of the centre of mass [m/s, rad/s]. The body comes free; it must not be pinned or scripted.
  void setVelocity(BodyId body, const Vec2& v, double omega);
  /// Holds a body where it is, or lets it go at rest. A scripted body is neither.
  void pin(BodyId body);
  void unpin(BodyId body);
  /// Takes a body out of its collection; it may merge again.
  void release(BodyId body);
  void wake(BodyId body);
  /// The coefficient of a body's surface, 0 or more; it wakes the bodies that it touches.
  void setFriction(BodyId body, double friction);

  /// Adds a body behind all others; it may be dynamic or pinned. Ids are never used again.
  BodyId addBody(const BodyDesc& desc);
  /// Removes a body with its joints and springs.
  void removeBody(BodyId body);
  /// Springs are numbered in the order of the scene, then as they are added. `to` is where the end
  /// of a spring that holds to the world is [m]: a spring that follows the pointer drags its body.
  std::uint32_t addSpring(const SpringDesc& desc);
  void moveSpring(std::uint32_t spring, const Vec2& to);
  void removeSpring(std::uint32_t spring);
  /// Joints are numbered in the same way. Places, directions and angles of the description are
  /// those that the bodies have now.
  std::uint32_t addJoint(const JointDesc& desc);
  void removeJoint(std::uint32_t joint);

  /// The settings in force; those of the scene stay as they were.
  const Settings& settings() const;
  void setSettings(const Settings& settings);
  Vec2 gravity() const;
  void setGravity(const Vec2& gravity);
  /// The length h of the steps to come [s].
  double timeStep() const;
  /// 1e-6 to 1 s. Wakes all bodies; forces at rest, and collections, stay as they are.
  void setTimeStep(double h);
  /// Where the new mode does not merge, all collections are taken apart.
  void setMode(Mode mode);

  // What can be seen, into arrays of the caller with one element (or three) per body of `bodies()`:
  // far cheaper than a snapshot. A body that is not there has NaN, or −1.

  void poses(std::span<double> out) const;       ///< x, y [m], angle [rad] of centres of mass
  void velocities(std::span<double> out) const;  ///< vx, vy [m/s], omega [rad/s]
  void collections(std::span<std::int32_t> out) const;  ///< ids; −1 when free

  /// A world point [m] as descriptions of springs have it: in the frame that the body was described
  /// in, whose origin need not be the centre of mass. Throws InputError for a body that is not
  /// there.
  Vec2 toBodyFrame(BodyId body, const Vec2& at) const;

 private:
  void checkSpring(std::uint32_t spring) const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace merge2d
