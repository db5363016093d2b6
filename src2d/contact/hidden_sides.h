#pragma once
/// Sides of a shape that another shape hides: nothing can touch them.
///
///        X →            A box that slides from T to S has sunk into T by a hair, and the narrow
///    ┌───────┐          phase finds the left side of S in its way; a disc finds the corner of S.
///    └───────┘          The point lies on T as well, and T covers that side.
///   ─────T─────┬─────S─────
///
/// It holds within a body of several shapes, and between bodies (a floor of tiles, two tables).
/// Where a body of the seam responds to forces, X may part S and T: there X must rest on T already
/// and slide towards S, and S must lie flush and go on with T. Contacts along one body's own flat
/// sides: internal_edges.h.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Empties the contacts with hidden sides that bear nothing yet, where the shape that hides the
/// side is about as near. Guarded by Seams.ABoxSlidesOverTiles.
void dropHiddenSides(State& state, Scratch& scratch);

}  // namespace merge2d
