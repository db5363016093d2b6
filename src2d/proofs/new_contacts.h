#pragma once
/// Contacts that a collection has gained: in each proof they take over from forces outside what
/// they can.

#include "src2d/proofs/load_certificate.h"

namespace merge2d {

/// Impulses at contacts that were not there when a proof was found.
class NewContacts {
 public:
  /// The contacts are given by their blocks.
  NewContacts(const State& state, const Collection& collection,
              const std::vector<std::uint32_t>& blocks);

  bool areFew() const { return edges_.size() <= kMost; }

  /// Adds those impulses that leave least of the load from outside in a proof, whose columns exist.
  /// For few of them.
  void takeOver(LoadCertificate& proof, Witness& witness) const;

 private:
  static constexpr std::size_t kMost = 16;  // edges: of eight points

  struct Push {
    BodyId body{};
    Twist gain;
  };
  /// One edge of a point's cone: n ± μ t.
  struct Edge {
    std::uint32_t block = 0;
    std::size_t point = 0;
    double mu = 0.0;
    std::vector<Push> pushes;
  };

  void add(std::uint32_t block);
  double energy(const Push& x, const Twist& y) const;
  double product(const Edge& x, const Edge& y) const;

  const State& state_;
  const Collection& c_;
  std::vector<Edge> edges_;
};

}  // namespace merge2d
