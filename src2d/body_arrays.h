#pragma once
/// Numbers of all bodies in arrays of a caller, a row for each id; NaN, or kNoCollection, where a
/// body is gone. An array of another size is an InputError.

#include <cstdint>
#include <span>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Three numbers a body: its centre of mass in the world [m], and its angle [rad].
void writePoses(const State& state, std::span<double> out);

/// Three numbers a body: the velocity of its centre of mass [m/s], and its spin [rad/s].
void writeVelocities(const State& state, std::span<double> out);

/// The id of the collection that a body is in.
void writeCollections(const State& state, std::span<std::int32_t> out);

}  // namespace merge2d
