#pragma once
/// Whether a collection falls apart at its cut welds. The same welds are found cut in step after
/// step while others hold their bodies together, so the answer is kept, and asked for as seldom as
/// possible.

#include <optional>

#include "src2d/merging/parts.h"

namespace merge2d {

/// The parts at the welds that are cut, by asking the criterion.
Parts judge(const State& state, Scratch& scratch, const Collection& c);

/// The welds that are cut or hold less than they did when that was last judged, but for those that
/// were found to be spare: in `scratch.others`. None when the same ones are cut as in a step in
/// which it held together, and nothing that held then has been lost since.
void listOthers(const State& state, Scratch& scratch, const Collection& c);

/// True when some member has lost all that held it with the cut ones of the others: then it falls
/// apart, and nobody need be asked.
bool losesAMember(const Collection& c, const Scratch& scratch);

/// The parts into which the welds that are cut divide the collection, once the others are listed;
/// nothing while it holds together. `anew`: something else has changed too, or a member was lost,
/// and the answers kept from earlier steps do not help.
std::optional<Parts> partsAtCuts(const State& state, Scratch& scratch, Collection& c, bool anew);

}  // namespace merge2d
