#pragma once
/// The load on the members of a collection in one step, seen from its frame.

#include <span>
#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// The load on one collection in this step. Bodies outside act on `outer`, ascending by member.
struct CollectionLoad {
  FrameLoad frame{};
  std::span<const OuterLoad> outer;
  Rotation back;            ///< from the world into the collection's frame
  double size = 1.0;        ///< of the collection [m]
  double norm = 0.0;        ///< of `frame` [m/s]
  double outer_norm = 0.0;  ///< of the velocities that `outer` gives [m/s]
};

/// Lists the forces and impulses from outside on the members of awake collections, with the contact
/// impulses of the last step, in `scratch.outer_loads`.
void listOuterLoads(const State& state, Scratch& scratch);

/// The load on a collection, once those are listed.
CollectionLoad loadOn(const State& state, const Scratch& scratch, const Collection& c);

/// The length by which spins are compared with velocities: half a diagonal, to the digits of a
/// float. More of them would tell where the frame of the world has its origin [m].
double sizeOf(const State& state, const Collection& c);

/// The velocity that an outer load gives its member, in the collection's frame; the spin times the
/// size of the collection [m/s].
Twist gainOf(const State& state, const Collection& c, const CollectionLoad& load,
             const OuterLoad& outer);

/// The velocity that the motion of the frame gives a member at a place in the frame.
Twist velocityAt(const State& state, const Collection& c, const FrameLoad& load, const Vec2& local);

/// The velocity that the frame's motion and an outer load give the member of that load, in the
/// collection's frame.
Twist memberGain(const State& state, const Collection& c, const CollectionLoad& load,
                 const OuterLoad& outer);

/// The velocities that a load gives all members, in the collection's frame, before contacts and
/// joints inside act: momentum and angular momentum of a floating collection are zero.
void loadMembers(const State& state, const Collection& c, const CollectionLoad& load,
                 std::vector<Twist>& out);

}  // namespace merge2d
