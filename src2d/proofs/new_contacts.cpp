#include "src2d/proofs/new_contacts.h"

#include "src2d/core/nonnegative_fit.h"
#include "src2d/proofs/proof_columns.h"

namespace merge2d {

NewContacts::NewContacts(const State& state, const Collection& c,
                         const std::vector<std::uint32_t>& blocks)
    : state_(state), c_(c) {
  for (const std::uint32_t i : blocks) add(i);
}

/// A point that has not closed yet carries nothing.
void NewContacts::add(std::uint32_t i) {
  const ContactBlock& k = c_.blocks[i];
  for (std::size_t p = 0; p < static_cast<std::size_t>(k.count); ++p) {
    if (k.bias[p] > 0.0) continue;
    for (const double mu : {k.mu, -k.mu}) {
      Edge edge{i, p, mu, {}};
      Impulses unit{};
      unit[p] = 1.0;
      unit[p + 2] = mu;
      const BlockGains gains = gainsOf(state_, k, unit);
      const auto push = [&](std::uint32_t body, const SolverVelocity& u) {
        if (hasColumn(state_, c_, body))
          edge.pushes.push_back({BodyId{body}, {u.vx, u.vy, u.omega}});
      };
      push(k.a, gains.a);
      push(k.b, gains.b);
      edges_.push_back(std::move(edge));
      if (mu == 0.0) break;
    }
  }
}

double NewContacts::energy(const Push& x, const Twist& y) const {
  const Body& body = state_[x.body];
  return body.mass * (x.gain.vx * y.vx + x.gain.vy * y.vy) + body.inertia * x.gain.omega * y.omega;
}

double NewContacts::product(const Edge& x, const Edge& y) const {
  double sum = 0.0;
  for (const Push& of_x : x.pushes) {
    for (const Push& of_y : y.pushes) {
      if (of_x.body == of_y.body) sum += energy(of_x, of_y.gain);
    }
  }
  return sum;
}

void NewContacts::takeOver(LoadCertificate& proof, Witness& witness) const {
  constexpr double kRidge = 1e-10;  // edges of many points depend on each other
  const double size = sizeOf(state_, c_);
  std::array<double, kMost * kMost> gram{};
  std::array<double, kMost> b{};
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    for (const Push& push : edges_[i].pushes) {
      const Twist& outer = witness.outer[columnOf(proof, push.body)];
      b[i] += energy(push, {outer.vx, outer.vy, outer.omega / size});
    }
    for (std::size_t j = 0; j < edges_.size(); ++j) {
      gram[i * kMost + j] = product(edges_[i], edges_[j]);
    }
    gram[i * kMost + i] *= 1.0 + kRidge;
  }
  const auto part = nonNegativeFit<kMost>(gram, b, edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Edge& edge = edges_[i];
    Impulses& lambda = witness.lambda[edge.block];
    lambda[edge.point] += part[i];
    lambda[edge.point + 2] += part[i] * edge.mu;
  }
}

}  // namespace merge2d
