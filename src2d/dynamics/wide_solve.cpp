#include "src2d/dynamics/wide_solve.h"

#include "src2d/core/memory.h"
#include "src2d/dynamics/nncg.h"
#include "src2d/dynamics/solver.h"
#include "src2d/dynamics/task_pool.h"

namespace merge2d {
namespace {

constexpr std::size_t kBlocksAtOnce = 64;  // blocks that a thread makes in a row
constexpr std::size_t kGroupsAtOnce = 16;  // groups

/// One island, its blocks, and where they are packed.
class WideIsland {
 public:
  WideIsland(Scratch& scratch, Island& island, const SweepTools& tools, ContactRows& rows)
      : scratch_(scratch),
        island_(island),
        tools_(tools),
        rows_(rows),
        wide_(tools.memory.wide),
        blocks_(scratch.blocks.data() + island.first, island.last - island.first) {}

  /// Makes the rows of all blocks: of most of them four at a time.
  void pack() {
    makeOthers();
    const std::span order(scratch_.block_order.data() + island_.first, blocks_.size());
    const auto idle = static_cast<std::uint32_t>(scratch_.u.size() - 1);
    wide_.pack(blocks_, tools_.memory.kinds, order, idle);
    const auto groups = wide_.groups();
    forEachIndex(tools_.tasks, groups.size(), kGroupsAtOnce, [&](std::size_t i, int) {
      if (groups[i].plain) rows_.makeGroup(wide_, groups[i], island_.first, tools_.path);
    });
    makeRest();
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (groups[i].too_close != 0) takeOut(i);
    }
  }

  SweepChange sweep(const SolverSettings& settings) {
    auto& u = scratch_.u;
    wide_.warmStart(blocks_, u, tools_.path, tools_.tasks);
    const std::span bodies(scratch_.island_bodies.data() + island_.first_body,
                           island_.last_body - island_.first_body);
    Nncg iteration(
        blocks_.size(), ImpulsesInARow{wide_.impulses().data(), &wideKernels(tools_.path)},
        bodies.size(), [&](std::size_t i) -> SolverVelocity& { return u[bodies[i]]; },
        [&] { wide_.sweep(blocks_, u, tools_.path, tools_.tasks); }, tools_.memory.nncg);
    return iteration.run(settings.iterations, isAccelerated(settings.method));
  }

  void store() {
    if (island_.hits) return wide_.unpack(blocks_);
    const auto groups = wide_.groups();
    forEachIndex(tools_.tasks, groups.size(), kGroupsAtOnce, [&](std::size_t i, int) {
      rows_.storeGroup(wide_, groups[i], island_.first, tools_.path);
    });
    for (const std::uint32_t i : wide_.alone()) {
      blocks_[i].lambda = wide_.impulses()[i];
      rows_.store(island_.first + i);
    }
  }

 private:
  /// The rows of blocks that are not plain.
  void makeOthers() {
    auto& kinds = tools_.memory.kinds;
    resizeTightly(kinds, blocks_.size());
    forEachIndex(tools_.tasks, blocks_.size(), kBlocksAtOnce, [&](std::size_t i, int) {
      kinds[i] = rows_.makeUnlessPlain(island_.first + static_cast<std::uint32_t>(i));
    });
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      island_.hits |= !isPlain(kinds[i]) && blocks_[i].hits != 0;
    }
  }

  /// Plain blocks that are the only ones of their colour.
  void makeRest() {
    for (const std::uint32_t i : wide_.alone()) {
      if (!isPlain(tools_.memory.kinds[i])) continue;
      rows_.make(island_.first + i);
      wide_.impulses()[i] = blocks_[i].lambda;
    }
  }

  /// Blocks whose two points are so close to each other that only one counts.
  void takeOut(std::size_t group) {
    const WideBlock w = wide_.groups()[group];
    for (std::size_t lane = 0; lane < 4; ++lane) {
      if ((w.too_close >> lane & 1) == 0 || !wide_.isUsed(w, lane)) continue;
      rows_.make(island_.first + w.block[lane]);
      wide_.takeOut(group, lane, blocks_[w.block[lane]]);
    }
  }

  Scratch& scratch_;
  Island& island_;
  const SweepTools& tools_;
  ContactRows& rows_;
  WideBlocks& wide_;
  std::span<ContactBlock> blocks_;
};

}  // namespace

bool isWide(const Island& island) {
  constexpr std::size_t kLeastWide = 24;  // blocks
  return island.first_joint == island.last_joint && island.last - island.first >= kLeastWide;
}

SweepChange solveWide(const SolverSettings& settings, Scratch& scratch, Island& island,
                      const SweepTools& tools, ContactRows& rows) {
  WideIsland wide(scratch, island, tools, rows);
  wide.pack();
  const SweepChange change = wide.sweep(settings);
  wide.store();
  return change;
}

}  // namespace merge2d
