#include "src2d/cycles/motions.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>
#include <optional>
#include <random>

#include "src2d/core/disjoint_sets.h"
#include "src2d/cycles/tolerance.h"

namespace merge2d {
namespace {

using Vector = Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

/// The reference of the velocities of a node: the middle of its pins, and their distance from
/// there.
struct Reference {
  Vec2 middle = Vec2::Zero();
  double size = 0.0;
  int pins = 0;
  bool point = false;  ///< they are all in one place
};

std::vector<Reference> referencesOf(std::uint32_t nodes, std::span<const Pin> pins,
                                    double resolution) {
  std::vector<Reference> references(nodes);
  const auto forEachEnd = [&](const auto& visit) {
    for (const Pin& pin : pins) {
      visit(references[pin.a], pin.at);
      visit(references[pin.b], pin.at);
    }
  };
  forEachEnd([](Reference& r, const Vec2& at) {
    r.middle += at;
    r.pins += 1;
  });
  for (Reference& r : references) r.middle /= std::max(1, r.pins);
  forEachEnd(
      [](Reference& r, const Vec2& at) { r.size = std::max(r.size, (at - r.middle).norm()); });
  for (Reference& r : references) {
    r.point = r.size <= resolution;
    if (r.point) r.size = 1.0;
  }
  return references;
}

/// J without the columns of node 0, which stays where it is. Unknowns: (v, size · ω) per node.
Sparse jacobian(std::span<const Pin> pins, const std::vector<Reference>& references) {
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (const Pin& pin : pins) {
    const auto add = [&](std::uint32_t node, double sign) {
      if (node == 0) return;
      const Reference& r = references[node];
      const Vec2 arm = r.point ? Vec2(Vec2::Zero()) : Vec2((pin.at - r.middle) / r.size);
      const int column = 3 * static_cast<int>(node - 1);
      entries.emplace_back(row, column, sign);
      entries.emplace_back(row, column + 2, -sign * arm.y());
      entries.emplace_back(row + 1, column + 1, sign);
      entries.emplace_back(row + 1, column + 2, sign * arm.x());
    };
    add(pin.a, 1.0);
    add(pin.b, -1.0);
    row += 2;
  }
  Sparse j(row, 3 * static_cast<int>(references.size() - 1));
  j.setFromTriplets(entries.begin(), entries.end());
  return j;
}

/// Tells beforehand how many multiplications the factors take.
struct Factors : Eigen::SimplicialLDLT<Sparse> {
  double work() const { return m_nonZerosPerCol.cast<double>().squaredNorm(); }
};

/// A random unit vector of the null space of J, or nothing when its rank is full. Inverse iteration
/// on JᵀJ leaves of a random vector what belongs to the smallest singular values: others, σ, fade
/// by (tolerance / σ)² each time. A graph so large and tangled that this would take seconds
/// counts as in general position; bodies in the plane do not touch like that.
std::optional<Vector> anyMotion(const Sparse& j) {
  constexpr int kIterations = 4;
  constexpr double kMostWork = 2e9;
  Sparse normal = j.transpose() * j;
  Sparse shift(normal.rows(), normal.cols());
  shift.setIdentity();
  normal += kRankTolerance * kRankTolerance * shift;
  Factors factors;
  factors.analyzePattern(normal);
  if (factors.work() > kMostWork) return std::nullopt;
  factors.factorize(normal);
  std::mt19937_64 random(1);
  Vector x(normal.cols());
  for (double& entry : x) entry = static_cast<double>(random() >> 11u) * 0x1p-52 - 1.0;
  for (int i = 0; i < kIterations; ++i) x = factors.solve(x).normalized();
  if ((j * x).norm() > kRankTolerance) return std::nullopt;
  return x;
}

/// Nodes that are linked by pins and turn alike in a motion.
DisjointSets turningAlike(std::span<const Pin> pins, const std::vector<Reference>& references,
                          const Vector& motion) {
  constexpr double kAlike = 1e-5;  // of the motion's length
  const auto omega = [&](std::uint32_t node) {
    return node == 0 ? 0.0 : motion[3 * static_cast<int>(node) - 1] / references[node].size;
  };
  DisjointSets alike;
  alike.reset(references.size());
  for (const Pin& pin : pins) {
    const double size = std::min(references[pin.a].size, references[pin.b].size);
    if (size * std::abs(omega(pin.a) - omega(pin.b)) < kAlike) alike.unite(pin.a, pin.b);
  }
  return alike;
}

/// Some nodes, numbered anew from 0, and the pins between them.
struct Part {
  std::vector<std::uint32_t> nodes;  ///< ascending
  std::vector<Pin> pins;
};

std::vector<Part> partsOf(std::uint32_t nodes, std::span<const Pin> pins, DisjointSets& sets) {
  std::vector<Part> parts(nodes);
  std::vector<std::uint32_t> number(nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) {
    auto& members = parts[sets.find(i)].nodes;
    number[i] = static_cast<std::uint32_t>(members.size());
    members.push_back(i);
  }
  for (Pin pin : pins) {
    const std::uint32_t set = sets.find(pin.a);
    if (set != sets.find(pin.b)) continue;
    pin.a = number[pin.a];
    pin.b = number[pin.b];
    parts[set].pins.push_back(pin);
  }
  std::erase_if(parts, [](const Part& part) { return part.nodes.size() < 2; });
  return parts;
}

}  // namespace

Groups placedGroups(std::uint32_t nodes, std::span<const Pin> pins, double resolution) {
  Groups groups(nodes);
  std::iota(groups.begin(), groups.end(), 0u);
  if (nodes < 2 || pins.empty()) return groups;
  const std::vector<Reference> references = referencesOf(nodes, pins, resolution);
  const std::optional<Vector> motion = anyMotion(jacobian(pins, references));
  if (!motion) {
    std::fill(groups.begin(), groups.end(), 0u);
    return groups;
  }
  DisjointSets alike = turningAlike(pins, references, *motion);
  for (const Part& part : partsOf(nodes, pins, alike)) {
    if (part.nodes.size() == nodes) break;  // neither rigid nor in parts, within the tolerance
    const Groups inner =
        placedGroups(static_cast<std::uint32_t>(part.nodes.size()), part.pins, resolution);
    for (std::size_t i = 0; i < inner.size(); ++i) groups[part.nodes[i]] = part.nodes[inner[i]];
  }
  return groups;
}

}  // namespace merge2d
