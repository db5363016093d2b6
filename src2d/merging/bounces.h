#pragma once
/// Bounces that arrive at collections. Bodies that bounce are followed hit by hit, each on its own
/// (dynamics/hits.h), so a bounce frees those that it reaches, under every rule
/// (docs/decisions/hits.md).

#include <vector>

#include "src2d/dynamics/state.h"

namespace merge2d {

/// How fast the bounces of this step arrive at each body [m/s]; empty when there are none, or no
/// collections. To be asked before collections are split.
std::vector<double> arrivingSpeeds(const State& state, const Scratch& scratch);

/// Whether bounces arrive at welds.
bool bounceAtWelds(const State& state, const std::vector<double>& arrives);

/// Cuts the welds at which bounces arrive, and splits their collections.
void releaseBouncing(State& state, Scratch& scratch, const std::vector<double>& arrives);

}  // namespace merge2d
