#pragma once
/// Forces from outside: springs, timed forces and impulses, magnets, emission, and scripted motion.

#include "src2d/dynamics/schedule.h"
#include "src2d/dynamics/state.h"

namespace merge2d {

/// A scene's timed parts with bodies resolved and anchors measured from the centres of mass.
struct Actions {
  std::vector<TimedSpring> springs;
  std::vector<ForceDesc> forces;      ///< `at` from the centre of mass
  std::vector<ImpulseDesc> impulses;  ///< ascending in time
  std::vector<MagnetDesc> magnets;
  struct Emission {
    double time = 0.0;
    BodyId body{};
  };
  std::vector<Emission> emissions;  ///< ascending in time
  std::size_t next_impulse = 0, next_emission = 0;
  struct Scripted {
    BodyId body{};
    Script script;
    Pose start;  ///< of the body frame
    double start_angle = 0.0;
    Vec2 center = Vec2::Zero();  ///< centre of mass in the body frame
  };
  std::vector<Scripted> scripts;
  std::vector<Kick> user_kicks;  ///< for the next step
  std::vector<Load> user_loads;  ///< the same
  std::vector<BodyId> loaded;    ///< bodies of `user_loads` of the last step
  std::vector<BodyId> stirred;   ///< changed by the user since the last step
  /// A body that was pinned at first, with the velocity that it is let go with.
  struct Launch {
    BodyId body{};
    double time = 0.0;  ///< [s]
    Vec2 v = Vec2::Zero();
    double omega = 0.0;
    bool done = false;
  };
  std::vector<Launch> launches;
  Timetable timetable;
};

/// The pose of a scripted body's frame at `time`.
struct ScriptPose {
  Vec2 position = Vec2::Zero();
  double angle = 0.0;
};
ScriptPose scriptPose(const Actions::Scripted& scripted, double time);

/// Gives scripted bodies the velocity that brings them to their pose at the end of the step, and
/// lists those that stood still before in `scratch.started`.
void moveScripted(State& state, const Actions& actions, Scratch& scratch);

/// Lists the forces of this step: springs and timed forces.
void listLoads(State& state, Actions& actions, Scratch& scratch);

/// Lists the impulses given in this step.
void listKicks(State& state, Actions& actions, Scratch& scratch);

}  // namespace merge2d
