#pragma once
/// Sides of a shape that nothing can touch which slides over another shape.
///
///        X →            A box that slides from T to S has sunk into T by a hair, and the narrow
///    ┌───────┐          phase finds the left side of S in its way; a disc finds the corner of S.
///    └───────┘          But X lies above the line in which it touches T, and S below it: where
///   ─────T─────┬─────S─────   X slides along that line, it meets nothing of S.
///
/// So it is within a body of several shapes, and between bodies (a floor of tiles, two tables).
/// Where a body of the seam responds to forces, X may part S and T: there X must rest on T already,
/// and S must lie beside T and go on with it. Contacts along one body's own flat sides:
/// internal_edges.h.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Empties the contacts with hidden sides that bear nothing yet, where the shape from which the
/// other one comes is about as near. Guarded by Seams.ABoxSlidesOverTiles.
void dropHiddenSides(State& state, Scratch& scratch);

}  // namespace merge2d
