#include "src2d/proofs/proof_impulses.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "src2d/core/memory.h"
#include "src2d/core/small_cholesky.h"
#include "src2d/proofs/load_product.h"
#include "src2d/proofs/load_projection.h"

namespace merge2d {
namespace {

/// The nearest combination of the witnesses' loads, with weights of any sign; a little damped, as
/// loads that hardly differ tell little. None where all loads are no more than `rounding` [m/s].
std::optional<LoadCertificate::Weights> combinationFor(const LoadCertificate& proof,
                                                       const Witness& load, double rounding) {
  constexpr double kDamping = 1e-8;  // of the largest square
  const std::size_t all = proof.witnesses.size(), n = all - proof.inherited;
  std::array<LoadCertificate::Weights, LoadCertificate::kMost> gram{};
  LoadCertificate::Weights b{};
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = proof.inherited + i;
    for (std::size_t j = 0; j < n; ++j) gram[i][j] = proof.gram[at * all + proof.inherited + j];
    b[i] = product(proof.witnesses[at], load);
    largest = std::max(largest, gram[i][i]);
  }
  if (largest <= rounding * rounding) return std::nullopt;
  for (std::size_t i = 0; i < n; ++i) gram[i][i] += kDamping * largest;
  return solveSymmetric(gram, b, n);
}

void limitImpulses(const Collection& c, Witness& load) {
  for (std::size_t b = 0; b < c.blocks.size(); ++b) {
    const ContactBlock& k = c.blocks[b];
    if (k.bilateral) continue;
    Impulses& lambda = load.lambda[b];
    for (std::size_t i = 0; i < 2; ++i) {
      lambda[i] = static_cast<int>(i) < k.count ? std::max(0.0, lambda[i]) : 0.0;
      const bool rolls = i == 1 && k.rolls();
      const double most = rolls ? k.rolling() * lambda[0] : k.mu * lambda[i];
      lambda[i + 2] = std::clamp(lambda[i + 2], -most, most);
    }
  }
}

}  // namespace

void readImpulses(const Collection& c, Witness& to) {
  to.lambda.clear();
  reserveTightly(to.lambda, c.blocks.size() + c.joints.size());
  for (const ContactBlock& k : c.blocks) to.lambda.push_back(k.lambda);
  for (const JointBlock& k : c.joints) to.lambda.push_back(k.lambda);
}

void swapImpulses(Collection& c, Witness& with) {
  c.push.forget();
  std::size_t at = 0;
  for (ContactBlock& k : c.blocks) std::swap(k.lambda, with.lambda[at++]);
  for (JointBlock& k : c.joints) std::swap(k.lambda, with.lambda[at++]);
}

void predictImpulses(const State& state, const Collection& c, Witness& load) {
  const LoadCertificate& proof = c.certificate.front();
  if (proof.witnesses.size() == proof.inherited) return;
  const auto w = combinationFor(proof, load, leftOfRest(state));
  if (!w) return;
  load.lambda.assign(c.blocks.size() + c.joints.size(), {});
  for (std::size_t i = proof.inherited; i < proof.witnesses.size(); ++i) {
    const double part = (*w)[i - proof.inherited];
    for (std::size_t k = 0; k < load.lambda.size(); ++k) {
      for (std::size_t r = 0; r < 4; ++r) {
        load.lambda[k][r] += part * proof.witnesses[i].lambda[k][r];
      }
    }
  }
  limitImpulses(c, load);
}

void writeImpulses(Collection& c) {
  if (c.certificate.empty() || !c.certificate.front().areRowsStale()) return;
  LoadCertificate& proof = c.certificate.front();
  proof.lambda_stale = false;
  c.push.forget();
  std::size_t at = 0;
  if (areBlocksAway(c)) {
    for (const std::uint32_t i : c.block_contact) c.contacts[i].setImpulses(proof.impulses(at++));
  }
  for (ContactBlock& k : c.blocks) k.lambda = proof.impulses(at++);
  for (JointBlock& k : c.joints) k.lambda = proof.impulses(at++);
}

}  // namespace merge2d
