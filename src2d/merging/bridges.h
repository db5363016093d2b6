#pragma once
/// Bridges of the graph of welds: a part that hangs on one weld alone.

#include "src2d/dynamics/state.h"

namespace merge2d {

/// Marks the welds whose cut would leave two parts that nothing else joins. The force in such a
/// weld follows from the weight of either part, so rigid rows and soft contacts agree on it. Bodies
/// of the frame count as one. The welds of each node must be listed.
void markBridges(Collection& collection);

}  // namespace merge2d
