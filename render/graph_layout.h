#pragma once
/// Where the bodies of a contact graph are drawn.

#include <vector>

#include "src2d/cycles/contact_graph.h"
#include "src2d/geometry/box.h"

namespace merge2d {

struct GraphLayout {
  bool placed = false;                    ///< the contact points are known
  std::vector<Vec2> bodies;               ///< the middle of each
  std::vector<std::vector<Vec2>> points;  ///< of each body's contacts, when placed
  Aabb extent;
};

/// Bodies amid their contact points when all of these are known; otherwise where springs between
/// those in contact, and repulsion between all, put them (Fruchterman and Reingold, 1991), and what
/// does not hang together side by side.
GraphLayout layOutGraph(const ContactGraph& graph);

}  // namespace merge2d
