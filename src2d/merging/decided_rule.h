#pragma once
/// `unmerging.rule = "decided"`: a weld holds while its contacts can carry the load.
///
/// A collection is a hypothesis: its members move as one. Its proof is a set of admissible impulses
/// (Eqs. (2)-(7)) that carries the load of this step without relative motion. A load that known
/// proofs cover (load_certificate.h) leaves the collection quiet. Otherwise the impulses are sought
/// by the engine's own solver until they have converged (inner_solve.h); the welds whose bodies
/// move then are cut (decided_unmerge.h). For some steps after a touch or a hit the refined sweep
/// of the default rule decides.

#include "src2d/merging/rule.h"

namespace merge2d {

extern const UnmergingMethod kDecidedUnmerging;

}  // namespace merge2d
