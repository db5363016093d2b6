#include "src2d/dynamics/solver.h"

#include <algorithm>
#include <utility>

#include "src2d/dynamics/hits.h"
#include "src2d/dynamics/joint_rows.h"
#include "src2d/dynamics/newton.h"
#include "src2d/dynamics/nncg.h"
#include "src2d/dynamics/thread_memory.h"
#include "src2d/dynamics/wide_blocks.h"

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

/// The solution of an island, to go back to.
class IslandSolution {
 public:
  void keep(std::span<const ContactBlock> blocks, std::span<const JointBlock> joints,
            std::span<const std::uint32_t> bodies, const std::vector<SolverVelocity>& u) {
    u_.clear();
    impulses_.clear();
    for (const std::uint32_t b : bodies) u_.push_back(u[b]);
    for (const ContactBlock& k : blocks) impulses_.push_back(k.lambda);
    joints_.assign(joints.begin(), joints.end());
  }
  void restore(std::span<ContactBlock> blocks, std::span<JointBlock> joints,
               std::span<const std::uint32_t> bodies, std::vector<SolverVelocity>& u) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) u[bodies[i]] = u_[i];
    for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].lambda = impulses_[i];
    std::ranges::copy(joints_, joints.begin());
  }

 private:
  std::vector<SolverVelocity> u_;
  std::vector<Impulses> impulses_;
  std::vector<JointBlock> joints_;
};

/// The bodies, contacts and joints of one island.
struct IslandParts {
  std::span<ContactBlock> blocks;
  std::span<JointBlock> joints;
  std::span<const std::uint32_t> bodies;
};

/// Memory of the corrections, which is kept.
struct CorrectionMemory {
  std::vector<JointErrors> bends;
  std::vector<JointMotion> before;
  IslandSolution uncorrected;
};

CorrectionMemory& correctionMemory() {
  thread_local CorrectionMemory memory;
  return memory;
}

/// Leaves the errors of joints that no small motion takes back (joint_rows.h).
void dropFutileCorrections(const State& state, const IslandParts& island,
                           std::vector<SolverVelocity>& u, JointSolver& together) {
  CorrectionMemory& m = correctionMemory();
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
                Solve&& solve) {
  CorrectionMemory& m = correctionMemory();
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

/// Islands of fewer blocks are swept one by one: packing them would cost as much.
constexpr std::size_t kLeastWide = 24;

bool isWide(const Island& island) {
  return island.first_joint == island.last_joint && island.last - island.first >= kLeastWide;
}

/// The sweeps of an island without joints, four blocks at a time.
SweepChange solveWide(Scratch& scratch, const Island& island, const SolverSettings& settings,
                      const SweepTools& tools) {
  WideBlocks& wide = tools.memory.wide;
  const std::size_t size = island.last - island.first;
  const std::span blocks(scratch.blocks.data() + island.first, size);
  auto& u = scratch.u;
  wide.pack(blocks, {scratch.block_order.data() + island.first, size}, u,
            static_cast<std::uint32_t>(u.size() - 1));
  Nncg iteration(
      size, [&](std::size_t i) -> Impulses& { return wide.impulses()[i]; },
      island.last_body - island.first_body,
      [&](std::size_t i) -> SolverVelocity& {
        return u[scratch.island_bodies[island.first_body + i]];
      },
      [&] { wide.sweep(blocks, u, tools.path, tools.tasks); }, tools.memory.nncg);
  const SweepChange change = iteration.run(settings.iterations, isAccelerated(settings.method));
  wide.storeImpulses(blocks);
  return change;
}

/// Far-away bodies do not matter: each island has its own ρ.
SweepChange solveIsland(const State& state, Scratch& scratch, const Island& island,
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
  const auto body = [&](std::size_t i) -> SolverVelocity& { return u[bodies[i]]; };
  const bool accelerate = isAccelerated(settings.method);
  if (isWide(island) && tools.path != SweepPath::OneByOne && settings.method != SolverMethod::Pgs) {
    return solveWide(scratch, island, settings, tools);
  }
  if (joints.empty()) {
    Nncg iteration(
        blocks.size(), [&](std::size_t i) -> Impulses& { return blocks[i].lambda; }, bodies.size(),
        body, [&] { sweep(blocks, u, settings.method); }, buffers);
    return iteration.run(settings.iterations, accelerate);
  }
  JointSolver together(joints, u, scratch.joint_memory);
  const IslandParts parts{blocks, joints, bodies};
  dropFutileCorrections(state, parts, u, together);
  Nncg iteration(
      blocks.size() + joints.size(),
      [&](std::size_t i) -> Impulses& {
        return i < blocks.size() ? blocks[i].lambda : joints[i - blocks.size()].lambda;
      },
      bodies.size(), body,
      [&] {
        together.sweep();
        sweep(blocks, u, settings.method);
      },
      buffers);
  const auto done = [&] { return blocks.empty() && together.isExact(); };
  SweepChange change = iteration.run(settings.iterations, accelerate, done);
  solveBends(state, parts, u, [&] { change = iteration.run(kSweepsForBends, false, done); });
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
void solveIslands(const State& state, Scratch& scratch) {
  const auto& islands = scratch.islands;
  provideMemory(scratch);
  scratch.island_changes.assign(islands.size(), {});
  const bool shares = sharesColours(state, scratch);
  const auto isInTurn = [&](const Island& i) {
    return i.first_joint != i.last_joint || (shares && isLargeIsland(i));
  };
  const auto solve = [&](std::size_t i, const SweepTools& tools) {
    scratch.island_changes[i] = solveIsland(state, scratch, islands[i], tools);
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

/// Hands the impulses back to the contacts, with the velocities that they leave.
void storeImpulses(State& state, const Scratch& scratch) {
  constexpr std::size_t kGrain = 128;  // blocks
  forEachIndex(scratch.tasks, scratch.blocks.size(), kGrain, [&](std::size_t i, int) {
    const ContactBlock& k = scratch.blocks[i];
    const RowSource& source = scratch.row_sources[scratch.block_order[i].source()];
    if (source.isInner()) {
      state.collections[source.slot()].blocks[source.block()].lambda = k.lambda;
      return;
    }
    for (int p = 0; p < k.count; ++p) {
      ContactPoint& point = state.contacts.point(source.points[static_cast<std::size_t>(p)]);
      const ContactVelocity w = contactVelocity(k, p, k.nx, k.ny, scratch.u[k.a], scratch.u[k.b]);
      point.lambda_n = k.lambda_n(p);
      point.lambda_t = k.lambda_t(p);
      point.w_n = static_cast<float>(w.n);
      point.w_t = static_cast<float>(w.t);
    }
    if (k.rolls()) state.contacts.secondOf(source.points[0]).lambda_t = k.lambda_r();
  });
}

}  // namespace

void solveContacts(State& state, Scratch& scratch) {
  const bool post = state.settings.solver.stabilisation == Stabilisation::Post;
  if (std::exchange(scratch.solved, false) && !post) return;
  buildRows(state, scratch);
  scratch.stats.contacts = 0;
  for (std::size_t i = 0; i < scratch.blocks.size(); ++i) {
    const bool inner = scratch.row_sources[scratch.block_order[i].source()].isInner();
    if (!inner) scratch.stats.contacts += scratch.blocks[i].count;
  }
  scratch.hit_ways.clear();
  SweepChange all;
  solveIslands(state, scratch);
  for (std::size_t i = 0; i < scratch.islands.size(); ++i) {
    if (scratch.islands[i].hits) resolveHits(state, scratch, scratch.islands[i]);
    all.squared += scratch.island_changes[i].squared;
    all.total += scratch.island_changes[i].total;
  }
  storeImpulses(state, scratch);
  storeJointImpulses(state, scratch);
  scratch.stats.residual = all.total > 0.0 ? std::sqrt(all.squared / all.total) : 0.0;
}

}  // namespace merge2d
