#pragma once
/// The impulses that belong to proofs, and those in the blocks of a collection.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Puts the impulses that stand in blocks and joints into a witness, or takes them from there.
void readImpulses(const Collection& c, Witness& to);
void swapImpulses(Collection& c, Witness& with);

/// The impulses that would carry a load if they were linear in it: extrapolated from those of the
/// witnesses, and brought back to their limits. None without witnesses found
/// since the layout, or with loads of rounding alone.
void predictImpulses(const State& state, const Collection& c, Witness& load);

/// Writes the impulses that belong to the weights into blocks, or contacts without one, and joints.
/// To be called before anything reads them there: in a steady step nothing does.
void writeImpulses(Collection& c);

}  // namespace merge2d
