#include "src2d/proofs/load_certificate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src2d/proofs/load_product.h"
#include "src2d/proofs/load_projection.h"
#include "src2d/proofs/proof_gram.h"
#include "src2d/proofs/proof_impulses.h"

namespace merge2d {

void carryBy(Collection& c, const LoadCertificate::Weights& weights) {
  LoadCertificate& proof = c.certificate.front();
  proof.lambda_stale |= weights != proof.weights;
  proof.weights = weights;
}

namespace {

/// How far a witness is from the cone of the others, squared.
double worthOf(const LoadCertificate& proof, std::size_t which, double rounding) {
  WitnessGram gram{};
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
  if (xx <= rounding * rounding) return 0.0;  // a load of nothing
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
    proof.columns.clear();
    proof.weights = {};
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
