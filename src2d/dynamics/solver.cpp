#include "src2d/dynamics/solver.h"

#include <algorithm>
#include <utility>

#include "src2d/dynamics/hits.h"
#include "src2d/dynamics/joint_rows.h"
#include "src2d/dynamics/newton.h"
#include "src2d/dynamics/nncg.h"
#include "src2d/dynamics/thread_memory.h"
#include "src2d/dynamics/wide_solve.h"

namespace merge2d {
namespace {

void sweep(std::span<ContactBlock> blocks, std::vector<SolverVelocity>& u, SolverMethod method) {
  if (method == SolverMethod::Pgs) {
    for (ContactBlock& k : blocks) solveRows(k, k.nx, k.ny, u[k.a], u[k.b]);
  } else {
    for (ContactBlock& k : blocks) solveBlock(k, k.nx, k.ny, u[k.a], u[k.b]);
  }
}

void warmStart(std::span<const ContactBlock> blocks, std::vector<SolverVelocity>& u) {
  for (const ContactBlock& k : blocks) applyImpulses(k, u[k.a], u[k.b]);
}

/// Bends change little: contacts need not find their impulses anew. The second time takes back the
/// bend by the first one.
constexpr int kSweepsForBends = 2, kTimesForBends = 2;

/// The bodies, contacts and joints of one island.
struct IslandParts {
  std::span<ContactBlock> blocks;
  std::span<JointBlock> joints;
  std::span<const std::uint32_t> bodies;
};

/// Leaves the errors of joints that no small motion takes back (joint_rows.h).
void dropFutileCorrections(const State& state, const IslandParts& island,
                           std::vector<SolverVelocity>& u, JointSolver& together,
                           CorrectionMemory& m) {
  double error = 0.0;
  for (const JointBlock& k : island.joints) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(k.coupled); ++i) {
      error = std::max(error, state.h * std::abs(k.rows[i].bias));
    }
  }
  rememberMotion(island.joints, u, m.before);
  m.uncorrected.keep(island.blocks, island.joints, island.bodies, u);
  together.correct();
  const bool holds = correctionHolds(state, island.joints, u, m.before, error);
  m.uncorrected.restore(island.blocks, island.joints, island.bodies, u);
  if (holds) return;
  for (JointBlock& k : island.joints) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(k.coupled); ++i) k.rows[i].bias = 0.0;
  }
}

/// Calls `solve` with the bends of the joints allowed for, where that is a correction.
template <class Solve>
void solveBends(const State& state, const IslandParts& island, std::vector<SolverVelocity>& u,
                CorrectionMemory& m, Solve&& solve) {
  m.bends.assign(island.joints.size(), {});
  rememberMotion(island.joints, u, m.before);
  m.uncorrected.keep(island.blocks, island.joints, island.bodies, u);
  double error = 0.0;  // of the motion that is to be corrected
  for (int i = 0; i < kTimesForBends && allowForBends(state, island.joints, u, m.bends); ++i) {
    for (const JointErrors& bend : m.bends) {
      for (const double part : bend) {
        if (i == 0) error = std::max(error, state.h * std::abs(part));
      }
    }
    solve();
  }
  if (error == 0.0 || correctionHolds(state, island.joints, u, m.before, error)) return;
  m.uncorrected.restore(island.blocks, island.joints, island.bodies, u);
}

/// Sweeps an island with joints: all of them together, then the contacts.
SweepChange sweepWithJoints(const State& state, Scratch& scratch, const IslandParts& parts,
                            NncgBuffers& buffers) {
  const SolverSettings& settings = state.settings.solver;
  auto& u = scratch.u;
  JointSolver together(parts.joints, u, scratch.joint_memory);
  dropFutileCorrections(state, parts, u, together, scratch.corrections);
  Nncg iteration(
      parts.blocks.size() + parts.joints.size(),
      [&](std::size_t i) -> Impulses& {
        return i < parts.blocks.size() ? parts.blocks[i].lambda
                                       : parts.joints[i - parts.blocks.size()].lambda;
      },
      parts.bodies.size(), [&](std::size_t i) -> SolverVelocity& { return u[parts.bodies[i]]; },
      [&] {
        together.sweep();
        sweep(parts.blocks, u, settings.method);
      },
      buffers);
  const auto done = [&] { return parts.blocks.empty() && together.isExact(); };
  SweepChange change = iteration.run(settings.iterations, isAccelerated(settings.method), done);
  solveBends(state, parts, u, scratch.corrections,
             [&] { change = iteration.run(kSweepsForBends, false, done); });
  return change;
}

/// An island block by block. Far-away bodies do not matter: each island has its own ρ.
SweepChange solveOneByOne(const State& state, Scratch& scratch, const Island& island,
                          const SweepTools& tools) {
  NncgBuffers& buffers = tools.memory.nncg;
  const SolverSettings& settings = state.settings.solver;
  const std::span blocks(scratch.blocks.data() + island.first, island.last - island.first);
  const std::span bodies(scratch.island_bodies.data() + island.first_body,
                         island.last_body - island.first_body);
  const std::span joints(scratch.joint_blocks.data() + island.first_joint,
                         island.last_joint - island.first_joint);
  auto& u = scratch.u;
  const bool direct =
      settings.method == SolverMethod::Newton && solveByNewton(blocks, joints, bodies, u);
  if (!direct) {
    warmStart(blocks, u);
    warmStartJoints(joints, u);
  }
  if (!joints.empty()) return sweepWithJoints(state, scratch, {blocks, joints, bodies}, buffers);
  Nncg iteration(
      blocks.size(), [&](std::size_t i) -> Impulses& { return blocks[i].lambda; }, bodies.size(),
      [&](std::size_t i) -> SolverVelocity& { return u[bodies[i]]; },
      [&] { sweep(blocks, u, settings.method); }, buffers);
  return iteration.run(settings.iterations, isAccelerated(settings.method));
}

template <class Visit>
void forEachBlock(const Island& island, TaskPool* tasks, Visit&& visit) {
  constexpr std::size_t kGrain = 64;  // blocks
  forEachIndex(tasks, island.last - island.first, kGrain,
               [&](std::size_t i, int) { visit(island.first + static_cast<std::uint32_t>(i)); });
}

/// Makes the rows of an island, solves it, and stores the impulses, unless hits are still to come.
SweepChange solveIsland(const State& state, Scratch& scratch, Island& island,
                        const SweepTools& tools, ContactRows& rows) {
  const SolverMethod method = state.settings.solver.method;
  const bool sweeps = method != SolverMethod::Pgs && method != SolverMethod::Newton;
  if (isWide(island) && tools.path != SweepPath::OneByOne && sweeps) {
    return solveWide(state.settings.solver, scratch, island, tools, rows);
  }
  forEachBlock(island, tools.tasks, [&](std::uint32_t i) { rows.make(i); });
  for (std::uint32_t i = island.first; i < island.last; ++i) {
    island.hits |= scratch.blocks[i].hits != 0;
  }
  const SweepChange change = solveOneByOne(state, scratch, island, tools);
  if (!island.hits) forEachBlock(island, tools.tasks, [&](std::uint32_t i) { rows.store(i); });
  return change;
}

bool isLargeIsland(const Island& island) {
  constexpr std::size_t kLeastLarge = 1000;  // blocks
  return island.last - island.first >= kLeastLarge;
}

/// Whether the threads share the colours of large islands: where each cannot have one of its own.
bool sharesColours(const State& state, const Scratch& scratch) {
  const bool wide = scratch.sweep_path != SweepPath::OneByOne &&
                    state.settings.solver.method != SolverMethod::Pgs;
  return wide && std::ranges::count_if(scratch.islands, isLargeIsland) < threadsOf(scratch);
}

/// Islands share fixed bodies alone, and are solved side by side. Joints are solved with a memory
/// of their own, in order.
void solveIslands(const State& state, Scratch& scratch, ContactRows& rows) {
  auto& islands = scratch.islands;
  provideMemory(scratch);
  scratch.island_changes.assign(islands.size(), {});
  const bool shares = sharesColours(state, scratch);
  const auto isInTurn = [&](const Island& i) {
    return i.first_joint != i.last_joint || (shares && isLargeIsland(i));
  };
  const auto solve = [&](std::size_t i, const SweepTools& tools) {
    scratch.island_changes[i] = solveIsland(state, scratch, islands[i], tools, rows);
  };
  forEachIndex(scratch.tasks, islands.size(), 1, [&](std::size_t i, int thread) {
    if (!isInTurn(islands[i])) solve(i, toolsOf(scratch, thread));
  });
  scratch.joint_memory.next = 0;
  for (std::size_t i = 0; i < islands.size(); ++i) {
    if (isInTurn(islands[i])) solve(i, ownTools(scratch));
  }
  if (std::ranges::none_of(islands, isWide)) scratch.sweeps.front().wide.release();
}

}  // namespace

void solveContacts(State& state, Scratch& scratch) {
  const bool post = state.settings.solver.stabilisation == Stabilisation::Post;
  if (std::exchange(scratch.solved, false) && !post) return;
  solveAllRows(state, scratch);
  breakOverloadedJoints(state, scratch);
}

void solveAllRows(State& state, Scratch& scratch) {
  listRows(state, scratch);
  ContactRows rows(state, scratch);
  scratch.hit_ways.clear();
  SweepChange all;
  solveIslands(state, scratch, rows);
  for (std::size_t i = 0; i < scratch.islands.size(); ++i) {
    const Island& island = scratch.islands[i];
    if (island.hits) {
      resolveHits(state, scratch, island);
      forEachBlock(island, scratch.tasks, [&](std::uint32_t block) { rows.store(block); });
    }
    all.squared += scratch.island_changes[i].squared;
    all.total += scratch.island_changes[i].total;
  }
  std::ranges::sort(scratch.hit_ways, {}, &HitWay::id);
  scratch.stats.contacts = 0;
  for (const RowSource& source : scratch.row_sources) {
    scratch.stats.contacts += source.isInner()
                                  ? state.collections[source.slot()].blocks[source.block()].count
                                  : source.count();
  }
  storeJointImpulses(state, scratch);
  scratch.stats.residual = all.total > 0.0 ? std::sqrt(all.squared / all.total) : 0.0;
}

}  // namespace merge2d
