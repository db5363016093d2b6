#include "render/graph_layout.h"

#include <algorithm>
#include <numbers>

#include "src2d/core/disjoint_sets.h"

namespace merge2d {
namespace {

constexpr double kGoldenAngle = std::numbers::pi * 0.7639320225002102;  // π (3 − √5)

bool everyPointIsKnown(const ContactGraph& graph) {
  return !graph.pairs.empty() &&
         std::all_of(graph.pairs.begin(), graph.pairs.end(), [](const GraphPair& pair) {
           return !pair.points.empty() || pair.contacts == 0;
         });
}

/// A body of one contact stands off it, away from the others.
void standOff(const ContactGraph& graph, GraphLayout& layout) {
  double size = 0.0;
  for (const auto& points : layout.points) {
    for (const Vec2& p : points) size = std::max(size, (p - points.front()).norm());
  }
  if (size == 0.0) size = 1.0;
  std::vector<Vec2> away(graph.bodies.size());
  for (std::uint32_t i = 0; i < away.size(); ++i) {
    away[i] = {std::cos(i * kGoldenAngle), std::sin(i * kGoldenAngle)};
  }
  for (const GraphPair& pair : graph.pairs) {
    const Vec2 d = layout.bodies[pair.a] - layout.bodies[pair.b];
    if (d.norm() < 1e-3 * size) continue;
    away[pair.a] = d.normalized();
    away[pair.b] = -d.normalized();
  }
  for (std::uint32_t i = 0; i < away.size(); ++i) {
    if (layout.points[i].size() < 2) layout.bodies[i] += 0.25 * size * away[i];
  }
}

GraphLayout placed(const ContactGraph& graph) {
  GraphLayout layout;
  layout.placed = true;
  layout.bodies.assign(graph.bodies.size(), Vec2::Zero());
  layout.points.resize(graph.bodies.size());
  for (const GraphPair& pair : graph.pairs) {
    for (const std::uint32_t body : {pair.a, pair.b}) {
      auto& points = layout.points[body];
      points.insert(points.end(), pair.points.begin(), pair.points.end());
    }
  }
  for (std::uint32_t i = 0; i < graph.bodies.size(); ++i) {
    for (const Vec2& p : layout.points[i]) {
      layout.bodies[i] += p / static_cast<double>(layout.points[i].size());
    }
  }
  standOff(graph, layout);
  return layout;
}

/// Spirals outwards, so that no two bodies start in one place.
std::vector<Vec2> spiral(std::size_t bodies) {
  std::vector<Vec2> at;
  for (std::size_t i = 0; i < bodies; ++i) {
    const double angle = static_cast<double>(i) * kGoldenAngle;
    at.push_back(std::sqrt(static_cast<double>(i) + 0.5) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return at;
}

/// One round: everything moves along its force by at most `step`. The ideal length of an edge is 1.
void relax(const ContactGraph& graph, std::vector<Vec2>& at, double step) {
  std::vector<Vec2> force(at.size(), Vec2::Zero());
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2 d = at[i] - at[j];
      const Vec2 push = d / std::max(1e-6, d.squaredNorm());
      force[i] += push;
      force[j] -= push;
    }
    force[i] -= 0.02 * at[i];
  }
  for (const GraphPair& pair : graph.pairs) {
    const Vec2 d = at[pair.a] - at[pair.b];
    const Vec2 pull = d * d.norm();
    force[pair.a] -= pull;
    force[pair.b] += pull;
  }
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] += force[i] * std::min(1.0, step / std::max(1e-9, force[i].norm()));
  }
}

/// Bodies that hang together, with the pairs between them.
struct Component {
  std::vector<std::uint32_t> bodies;  ///< of the whole graph, ascending
  ContactGraph graph;                 ///< the same, numbered from 0
  std::vector<Vec2> at;
  Aabb extent;
};

std::vector<Component> componentsOf(const ContactGraph& graph) {
  const auto bodies = static_cast<std::uint32_t>(graph.bodies.size());
  DisjointSets sets;
  sets.reset(bodies);
  for (const GraphPair& pair : graph.pairs) sets.unite(pair.a, pair.b);
  std::vector<Component> components;
  std::vector<std::uint32_t> component(bodies), number(bodies);
  for (std::uint32_t i = 0; i < bodies; ++i) {
    const std::uint32_t first = sets.find(i);  // of a set the smallest
    if (first == i) {
      component[i] = static_cast<std::uint32_t>(components.size());
      components.emplace_back();
    }
    Component& c = components[component[first]];
    component[i] = component[first];
    number[i] = static_cast<std::uint32_t>(c.bodies.size());
    c.bodies.push_back(i);
    c.graph.bodies.push_back(graph.bodies[i]);
  }
  for (GraphPair pair : graph.pairs) {
    Component& c = components[component[pair.a]];
    pair.a = number[pair.a];
    pair.b = number[pair.b];
    c.graph.pairs.push_back(pair);
  }
  return components;
}

void layOut(Component& c, double all_bodies) {
  constexpr double kWork = 1e8;  // pairs of bodies in all rounds
  constexpr int kMostRounds = 500;
  c.at = spiral(c.bodies.size());
  const auto n = static_cast<double>(c.bodies.size());
  const int rounds = static_cast<int>(std::min<double>(kMostRounds, kWork / (n * all_bodies)));
  for (int i = 0; i < rounds; ++i) relax(c.graph, c.at, 0.5 * (1.0 - i / (rounds + 1.0)));
  for (const Vec2& p : c.at) c.extent.include(p);
}

/// Puts the components beside each other, the highest first, in rows about as wide as all are high.
void pack(std::vector<Component>& components) {
  constexpr double kSpace = 1.0;
  std::stable_sort(components.begin(), components.end(), [](const auto& a, const auto& b) {
    return a.extent.extent().y() > b.extent.extent().y();
  });
  double area = 0.0;
  for (const Component& c : components) {
    area += (c.extent.extent() + Vec2(kSpace, kSpace)).prod();
  }
  const double width = 1.2 * std::sqrt(area);
  Vec2 corner = Vec2::Zero();  // upper left of the next one
  double row = 0.0;
  for (Component& c : components) {
    const Vec2 size = c.extent.extent();
    if (corner.x() > 0.0 && corner.x() + size.x() > width) {
      corner = {0.0, corner.y() - row - kSpace};
      row = 0.0;
    }
    const Vec2 way = corner - Vec2(c.extent.lower.x(), c.extent.upper.y());
    for (Vec2& p : c.at) p += way;
    corner.x() += size.x() + kSpace;
    row = std::max(row, size.y());
  }
}

GraphLayout relaxed(const ContactGraph& graph) {
  GraphLayout layout;
  layout.bodies.resize(graph.bodies.size());
  std::vector<Component> components = componentsOf(graph);
  for (Component& c : components) layOut(c, static_cast<double>(graph.bodies.size()));
  pack(components);
  for (const Component& c : components) {
    for (std::size_t i = 0; i < c.bodies.size(); ++i) layout.bodies[c.bodies[i]] = c.at[i];
  }
  return layout;
}

}  // namespace

GraphLayout layOutGraph(const ContactGraph& graph) {
  GraphLayout layout = everyPointIsKnown(graph) ? placed(graph) : relaxed(graph);
  for (const Vec2& at : layout.bodies) layout.extent.include(at);
  for (const auto& points : layout.points) {
    for (const Vec2& p : points) layout.extent.include(p);
  }
  return layout;
}

}  // namespace merge2d
