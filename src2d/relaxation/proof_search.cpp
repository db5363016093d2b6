#include "src2d/relaxation/proof_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "src2d/collections/collection.h"
#include "src2d/collections/inner_push.h"
#include "src2d/dynamics/newton.h"
#include "src2d/proofs/proof_impulses.h"
#include "src2d/relaxation/relaxation.h"

namespace merge2d {

bool isLookedAt(const State& state, const Collection& c) {
  const std::int64_t since_hit = state.step - c.hits.blow;
  return since_hit >= kDecided.patience || since_hit % state.settings.merging.steps == 0;
}

namespace {

/// Nothing of the frame moves.
void startFrame(const State& state, std::vector<SolverVelocity>& u, const Collection& c) {
  u.resize(state.bodies.size() + 1);
  for (const Weld& weld : c.welds) u[index(weld.a)] = u[index(weld.b)] = {};
  for (const JointBlock& k : c.joints) u[k.a] = u[k.b] = {};
}

/// A search starts from the impulses that the witnesses foretell, or else from those that there
/// are.
ProofSearch& newSearch(const State& state, Collection& c, Witness&& load) {
  ProofSearch& search = c.certificate.front().search;
  search = {};
  search.load = std::move(load);
  search.load.lambda.clear();
  predictImpulses(state, c, search.load);
  if (search.load.lambda.empty()) readImpulses(c, search.load);
  return search;
}

/// The members' velocities under the load that is sought, and under the impulses found so far.
void startMembers(const State& state, std::vector<SolverVelocity>& u, Collection& c, bool pushed) {
  const LoadCertificate& proof = c.certificate.front();
  if (pushed) layOutPush(state, c);
  startFrame(state, u, c);
  for (std::uint32_t m = 0; m < c.members.size(); ++m) {
    if (proof.search.ahead && c.members[m] == proof.heaviest) continue;
    Twist start = proof.search.start[m];
    if (pushed) addTo(start, c.push.of[m], 1.0);
    u[index(c.members[m])] = memberVelocity(state, c.members[m], start);
  }
}

/// False where the solve goes on in the next step: it may spend as many rows as sweeps may.
bool solveDirectly(const State& state, const SearchTools& tools, Collection& c) {
  std::vector<SolverVelocity>& u = tools.sweeps.memory.trial_u;
  c.push.forget();
  startMembers(state, u, c, false);
  std::vector<std::uint32_t> bodies;
  bodies.reserve(c.members.size());
  for (const BodyId b : c.members) bodies.push_back(static_cast<std::uint32_t>(index(b)));
  ProofSearch& search = c.certificate.front().search;
  search.nncg.previous = 0.0;
  const double most = kDecided.row_sweeps / static_cast<double>(c.blocks.size() + c.joints.size());
  return continueByNewton(c.blocks, c.joints, bodies, u, toleratedResidual(state), search.newton,
                          std::max(1, static_cast<int>(most)), *tools.newton);
}

}  // namespace

void beginSearch(const State& state, Collection& c, const CollectionLoad& load) {
  ProofSearch& search = newSearch(state, c, asWitness(state, c, load));
  loadMembers(state, c, load, search.start);
  swapImpulses(c, search.load);  // the progress outlives a new layout
  c.certificate.front().weights = {};
}

bool isDirect(const State& state, const ProofSearch& search) {
  return search.isInAllRows() && !search.ahead && !search.isSuspended() &&
         lasts(state, search.steps) &&
         std::has_single_bit(static_cast<std::uint16_t>(search.steps));
}

void renewLoad(const State& state, Collection& c, const CollectionLoad& load) {
  ProofSearch& search = c.certificate.front().search;
  Witness witness = asWitness(state, c, load);
  witness.lambda = std::move(search.load.lambda);
  search.load = std::move(witness);
  loadMembers(state, c, load, search.start);
}

void beginSearchAhead(const State& state, Collection& c, Witness&& load, double way) {
  ProofSearch& search = newSearch(state, c, std::move(load));
  search.ahead = true;
  search.way = way;
  for (std::uint32_t m = 0; m < c.members.size(); ++m) {
    search.start.push_back(loadOnMember(state, c, search.load, m));
  }
}

void makeRoom(const State& state, Scratch& scratch, const Collection& c) {
  const ProofSearch& search = c.certificate.front().search;
  if (isDirect(state, search) || search.isSuspended()) scratch.newton.try_emplace(c.id);
}

SearchTools searchToolsOf(Scratch& scratch, const SweepTools& sweeps, const Collection& c) {
  const auto newton = scratch.newton.find(c.id);
  return {sweeps, newton == scratch.newton.end() ? nullptr : &newton->second, scratch.notes};
}

void continueSearch(const State& state, const SearchTools& tools, Collection& c, double tolerance) {
  ProofSearch& search = c.certificate.front().search;
  const SweepTools& sweeps = tools.sweeps;
  if (search.ahead) swapImpulses(c, search.load);
  const bool begins = isDirect(state, search) && c.residual > toleratedResidual(state);
  if ((begins || search.isSuspended()) && !solveDirectly(state, tools, c)) return;
  startMembers(state, sweeps.memory.trial_u, c, true);
  const auto budget = SweepBudget::ofSearch(state, c.blocks.size(), search.steps);
  c.residual = static_cast<float>(relax(state, sweeps, c, tolerance, budget, &search));
  if (search.ahead) swapImpulses(c, search.load);
}

double fastestContact(const SweepMemory& memory, const Collection& c) {
  const auto& u = memory.trial_u;
  double most = 0.0;
  for (const ContactBlock& k : c.blocks) {
    for (int p = 0; p < k.count; ++p) {
      const ContactVelocity w = contactVelocity(k, p, k.nx, k.ny, u[k.a], u[k.b]);
      const double speed = std::max(std::abs(w.n), std::abs(w.t));
      // What is no number is not at rest: the full solve tells of it.
      if (std::isnan(w.n) || std::isnan(w.t)) return std::numeric_limits<double>::infinity();
      most = std::max(most, speed);
    }
  }
  return most;
}

}  // namespace merge2d
