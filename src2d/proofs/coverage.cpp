#include "src2d/proofs/coverage.h"

#include <algorithm>
#include <cmath>

#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/load_product.h"
#include "src2d/proofs/load_projection.h"

namespace merge2d {
namespace {

/// ℓ · ℓᵢ of a load and a witness.
double product(const State& state, const Collection& c, const CollectionLoad& load,
               const Witness& witness) {
  double sum = dot(load.frame, witness.frame);
  const auto& columns = c.certificate.front().columns;
  std::size_t k = 0;
  for (const OuterLoad& o : load.outer) {
    const BodyId b = c.members[o.member];
    while (k < columns.size() && columns[k] < b) ++k;
    if (k == columns.size()) break;
    if (columns[k] != b) continue;
    sum += kOuterWeight * kOuterWeight * dot(gainOf(state, c, load, o), witness.outer[k]);
  }
  return sum;
}

/// ℓ · ℓ.
double square(const CollectionLoad& load) {
  const double outer = kOuterWeight * load.outer_norm;
  return load.norm * load.norm + outer * outer;
}

/// So much may be left over of a load of that norm [m/s].
double mostLeft(const State& state, double norm) {
  return std::max(leftOfRest(state), kDecided.left_over * norm);
}

/// A product of loads, with its part from outside in that scale.
double weighed(double of_frame, double whole, double scale) {
  return of_frame + scale * (whole - of_frame);
}

/// |ℓ − Σ βᵢ ℓᵢ|² with the weights that there are, and loads from outside in that scale: in most
/// steps these cover the load still.
double leftByWeights(const State& state, const Collection& c, const CollectionLoad& load,
                     double scale) {
  const LoadCertificate& proof = c.certificate.front();
  const std::size_t n = proof.witnesses.size();
  FrameLoad frame = load.frame;
  double left = square(load);
  for (std::size_t i = 0; i < n; ++i) {
    const double weight = proof.weights[i];
    if (weight == 0.0) continue;
    const Witness& witness = proof.witnesses[i];
    for (std::size_t k = 0; k < frame.size(); ++k) frame[k] -= weight * witness.frame[k];
    left -= 2.0 * weight * product(state, c, load, witness);
    for (std::size_t j = 0; j < n; ++j) left += weight * proof.weights[j] * proof.gram[i * n + j];
  }
  return weighed(dot(frame, frame), left, scale);
}

/// How fast members move under the impulses of a combination [m/s].
double motionOf(const LoadCertificate& proof, const LoadCertificate::Weights& weights) {
  double motion = 0.0;
  for (std::size_t i = 0; i < proof.witnesses.size(); ++i) {
    motion += weights[i] * proof.witnesses[i].motion;
  }
  return motion;
}

}  // namespace

Coverage coverageOf(const State& state, const Collection& c, const CollectionLoad& load) {
  const LoadCertificate& proof = c.certificate.front();
  const double most = mostLeft(state, load.norm);
  const double outer = most + mostLeft(state, kOuterWeight * load.outer_norm);
  const double scale = most * most / (outer * outer);  // of the loads from outside
  const auto leaving = [&](double left, const LoadCertificate::Weights& weights) {
    // Not where they are no numbers.
    const double part = left <= 0.0 ? 0.0 : std::sqrt(left), motion = motionOf(proof, weights);
    const Criterion leaves{"proof", kOwnDecided, part, most, left <= most * most};
    const Criterion rests{"proof-motion", kOwnDecided, motion, cutSpeed(state),
                          motion <= cutSpeed(state)};
    return Coverage{leaves.holds && !rests.holds ? rests : leaves, weights};
  };
  const std::size_t n = proof.witnesses.size();
  const double ll = weighed(load.norm * load.norm, square(load), scale);
  if (n == 0) {
    const double all = ll <= 0.0 ? 0.0 : std::sqrt(ll);
    return {{"proof", kOwnDecided, all, 0.0, false}, {}};
  }
  const Coverage known = leaving(leftByWeights(state, c, load, scale), proof.weights);
  if (known.carried.holds) return known;
  WitnessGram gram{};
  LoadCertificate::Weights b{};
  for (std::size_t i = 0; i < n; ++i) {
    const Witness& witness = proof.witnesses[i];
    b[i] = weighed(dot(load.frame, witness.frame), product(state, c, load, witness), scale);
    for (std::size_t j = 0; j < n; ++j) {
      const double of_frames = dot(witness.frame, proof.witnesses[j].frame);
      gram[i * kWitnesses + j] = weighed(of_frames, proof.gram[i * n + j], scale);
    }
  }
  const Projection nearest = project(gram, b, n, ll, leftOfRest(state));
  return leaving(nearest.left, nearest.weights);
}

bool isNewOutsideAlone(const State& state, const Collection& c, const CollectionLoad& load) {
  const auto& witnesses = c.certificate.front().witnesses;
  if (witnesses.empty()) return false;
  const FrameLoad& known = witnesses.back().frame;
  double left = 0.0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    left += (load.frame[i] - known[i]) * (load.frame[i] - known[i]);
  }
  const double most = mostLeft(state, load.norm);
  return left <= most * most;
}

bool leadsTo(const State& state, const Collection& c, const CollectionLoad& load) {
  const ProofSearch& search = c.certificate.front().search;
  const double left =
      square(load) - 2.0 * product(state, c, load, search.load) + product(search.load, search.load);
  return left <= search.way * search.way;
}

}  // namespace merge2d
