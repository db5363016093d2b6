#include "src2d/proofs/load_certificate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src2d/core/nonnegative_fit.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/load_product.h"
#include "src2d/proofs/proof_gram.h"
#include "src2d/proofs/proof_impulses.h"

namespace merge2d {
namespace {

constexpr std::size_t kWitnesses = LoadCertificate::kMost;

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

/// A load beside those of the witnesses.
struct Projection {
  LoadCertificate::Weights weights{};
  double left = 0.0;  ///< |ℓ − Σ βᵢ ℓᵢ|², of which rounding may leave less than nothing
};

using Gram = std::array<double, kWitnesses * kWitnesses>;

/// So little may be left over of any load [m/s]: one member gains no more by it than a search
/// leaves.
double leftOfRest(const State& state) { return kOuterWeight * toleratedResidual(state); }

/// So much may be left over of a load of that norm [m/s].
double mostLeft(const State& state, double norm) {
  return std::max(leftOfRest(state), kDecided.left_over * norm);
}

/// The nearest combination of the first `n` loads of `gram` to one of products `b` and square `ll`.
/// Loads are known but for `rounding` [m/s]: one of nothing else must not get a weight.
Projection project(Gram gram, const LoadCertificate::Weights& b, std::size_t n, double ll,
                   double rounding) {
  for (std::size_t i = 0; i < n; ++i) {
    gram[i * kWitnesses + i] += rounding * rounding;
  }
  Projection p{nonNegativeFit(gram, b, n), ll};
  for (std::size_t i = 0; i < n; ++i) {
    p.left -= 2.0 * p.weights[i] * b[i];
    for (std::size_t j = 0; j < n; ++j) {
      p.left += p.weights[i] * p.weights[j] * gram[i * kWitnesses + j];
    }
  }
  return p;
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
    Coverage none = leaving(ll, {});
    none.carried.holds = false;
    return none;
  }
  const Coverage known = leaving(leftByWeights(state, c, load, scale), proof.weights);
  if (known.carried.holds) return known;
  Gram gram{};
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

void carryBy(Collection& c, const LoadCertificate::Weights& weights) {
  LoadCertificate& proof = c.certificate.front();
  proof.lambda_stale |= weights != proof.weights;
  proof.weights = weights;
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

namespace {

/// How far a witness is from the cone of the others, squared.
double worthOf(const LoadCertificate& proof, std::size_t which, double rounding) {
  Gram gram{};
  LoadCertificate::Weights b{};
  const std::size_t all = proof.witnesses.size();
  std::size_t n = 0;
  for (std::size_t i = 0; i < all; ++i) {
    if (i == which) continue;
    std::size_t m = 0;
    for (std::size_t j = 0; j < all; ++j) {
      if (j != which) gram[n * kWitnesses + m++] = proof.gram[i * all + j];
    }
    b[n++] = proof.gram[i * all + which];
  }
  const double xx = proof.gram[which * all + which];
  return project(gram, b, n, xx, rounding).left / xx;
}

/// Drops the witness without which the others lose least; inherited ones first.
void makePlace(LoadCertificate& proof, double rounding) {
  if (proof.witnesses.size() < kWitnesses) return;
  std::size_t least = 0;
  double worth = 1e300;
  const std::size_t end = proof.inherited > 0 ? proof.inherited : proof.witnesses.size();
  for (std::size_t i = 0; i < end; ++i) {
    const double of = worthOf(proof, i, rounding);
    if (of < worth) {
      worth = of;
      least = i;
    }
  }
  dropFromGram(proof, least);
  proof.witnesses.erase(proof.witnesses.begin() + static_cast<std::ptrdiff_t>(least));
  if (proof.inherited > 0) --proof.inherited;
}

/// The columns of the certificate, and those of this load too.
void addColumns(Collection& c, const CollectionLoad& load) {
  LoadCertificate& proof = c.certificate.front();
  std::vector<BodyId> columns = proof.columns;
  for (const OuterLoad& o : load.outer) {
    if (c.members[o.member] != proof.heaviest) columns.push_back(c.members[o.member]);
  }
  std::ranges::sort(columns);
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  if (columns == proof.columns) return;
  for (Witness& witness : proof.witnesses) {
    std::vector<Twist> outer(columns.size());
    for (std::size_t k = 0; k < proof.columns.size(); ++k) {
      const auto at = std::ranges::lower_bound(columns, proof.columns[k]) - columns.begin();
      outer[static_cast<std::size_t>(at)] = witness.outer[k];
    }
    witness.outer = std::move(outer);
  }
  proof.columns = std::move(columns);
}

}  // namespace

BodyId heaviestOf(const State& state, const Collection& c) {
  if (!state[c.rigid].floating()) return LoadCertificate{}.heaviest;
  return *std::ranges::max_element(c.members, {}, [&](BodyId b) { return state[b].mass; });
}

void restart(const State& state, LoadCertificate& proof) {
  fillGram(proof);
  proof.weights = {};
  proof.lambda_stale = false;
  proof.since = state.step;
  proof.search = {};
  proof.inherited = proof.witnesses.size();
}

void remember(const State& state, Collection& c, Witness&& witness) {
  writeImpulses(c);
  LoadCertificate& proof = c.certificate.front();
  makePlace(proof, leftOfRest(state));
  proof.witnesses.push_back(std::move(witness));
  addToGram(proof);
  proof.weights = {};
}

void carryByLatest(Collection& c) {
  LoadCertificate& proof = c.certificate.front();
  proof.weights[proof.witnesses.size() - 1] = 1.0;
}

void forgetProofs(Collection& c) {
  writeImpulses(c);
  for (LoadCertificate& proof : c.certificate) {
    proof.witnesses.clear();
    proof.inherited = 0;
    proof.gram.clear();
    proof.in_doubt = true;
    proof.search = {};
  }
}

Witness asWitness(const State& state, Collection& c, const CollectionLoad& load) {
  LoadCertificate& proof = c.certificate.front();
  addColumns(c, load);
  Witness witness;
  witness.frame = load.frame;
  witness.outer.assign(proof.columns.size(), {});
  for (const OuterLoad& o : load.outer) {
    const BodyId b = c.members[o.member];
    if (b == proof.heaviest) continue;
    const auto at = std::ranges::lower_bound(proof.columns, b) - proof.columns.begin();
    witness.outer[static_cast<std::size_t>(at)] = gainOf(state, c, load, o);
  }
  return witness;
}

namespace {

/// x + s (x − y) of the loads of two witnesses, with the impulses of x.
Witness extrapolated(const Witness& x, const Witness& y, double s) {
  const auto of = [&](double a, double b) { return a + s * (a - b); };
  Witness next = x;
  for (std::size_t i = 0; i < next.frame.size(); ++i) next.frame[i] = of(x.frame[i], y.frame[i]);
  for (std::size_t k = 0; k < next.outer.size(); ++k) {
    const Twist &a = x.outer[k], &b = y.outer[k];
    next.outer[k] = {of(a.vx, b.vx), of(a.vy, b.vy), of(a.omega, b.omega)};
  }
  return next;
}

/// Of those found since the layout; without impulses.
Witness meanOf(const LoadCertificate& proof) {
  const auto found = std::span(proof.witnesses).subspan(proof.inherited);
  Witness mean{found.front().frame, found.front().outer, {}};
  for (std::size_t n = 1; n < found.size(); ++n) {
    mean = extrapolated(mean, found[n], -1.0 / static_cast<double>(n + 1));
  }
  return mean;
}

}  // namespace

Witness beyond(const LoadCertificate& proof, const Witness& load, double part, double& way) {
  const Witness mean = meanOf(proof);
  const double square = product(load, load) - 2.0 * product(load, mean) + product(mean, mean);
  way = part * std::sqrt(std::max(square, 0.0));
  return extrapolated(load, mean, part);
}

Twist loadOnMember(const State& state, const Collection& c, const Witness& load,
                   std::uint32_t member) {
  const BodyId b = c.members[member];
  Twist u = velocityAt(state, c, load.frame, state[b].local);
  const auto& columns = c.certificate.front().columns;
  const auto at = std::ranges::lower_bound(columns, b);
  if (at == columns.end() || *at != b) return u;
  const Twist& e = load.outer[static_cast<std::size_t>(at - columns.begin())];
  u.vx += e.vx;
  u.vy += e.vy;
  u.omega += e.omega / sizeOf(state, c);
  return u;
}

}  // namespace merge2d
