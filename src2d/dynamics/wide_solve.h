#pragma once
/// The full solve of large islands, four blocks at a time.

#include "src2d/dynamics/rows.h"

namespace merge2d {

/// True for an island that is worth it: packing a small one would cost as much.
bool isWide(const Island& island);

/// Makes its rows, sweeps over them and stores the impulses. Where it is hit, rows and impulses are
/// left in Scratch::blocks instead.
SweepChange solveWide(const SolverSettings& settings, Scratch& scratch, Island& island,
                      const SweepTools& tools, ContactRows& rows);

}  // namespace merge2d
