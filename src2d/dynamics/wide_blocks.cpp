#include "src2d/dynamics/wide_blocks.h"

#include <algorithm>
#include <array>
#include <utility>

#include "src2d/core/memory.h"
#include "src2d/dynamics/scratch.h"
#include "src2d/dynamics/task_pool.h"

namespace merge2d {

namespace {

/// Fewer blocks than this of a colour are solved one by one.
constexpr std::uint32_t kLeastLanes = 2;

constexpr std::size_t kGrain = 16;  ///< groups that a thread solves in a row

void setLane(WideBlock& w, std::size_t lane, const ContactBlock& k) {
  w.nx[lane] = k.nx;
  w.ny[lane] = k.ny;
  for (std::size_t i = 0; i < 2; ++i) {
    w.arm_an[i][lane] = k.arm_an[i];
    w.arm_bn[i][lane] = k.arm_bn[i];
    w.arm_at[i][lane] = k.arm_at[i];
    w.arm_bt[i][lane] = k.arm_bt[i];
    w.inv_kt[i][lane] = k.inv_kt[i];
    w.bias[i][lane] = k.bias[i];
  }
  w.k11[lane] = k.k11;
  w.k12[lane] = k.k12;
  w.k22[lane] = k.k22;
  w.inv_det[lane] = k.inv_det;
  w.softness[lane] = k.softness;
  w.mu[lane] = k.mu;
  w.a[lane] = k.a;
  w.b[lane] = k.b;
}

/// The block of a lane again, but for its impulses.
void takeLane(const WideBlock& w, std::size_t lane, ContactBlock& k) {
  k = {.a = w.a[lane], .b = w.b[lane], .count = w.points, .nx = w.nx[lane], .ny = w.ny[lane]};
  for (std::size_t i = 0; i < static_cast<std::size_t>(w.points); ++i) {
    k.arm_an[i] = w.arm_an[i][lane];
    k.arm_bn[i] = w.arm_bn[i][lane];
    k.arm_at[i] = w.arm_at[i][lane];
    k.arm_bt[i] = w.arm_bt[i][lane];
    k.inv_kt[i] = w.inv_kt[i][lane];
    k.bias[i] = w.bias[i][lane];
  }
  k.k11 = w.k11[lane];
  if (w.points == 2) {
    k.k12 = w.k12[lane];
    k.k22 = w.k22[lane];
    k.inv_det = w.inv_det[lane];
  }
  k.softness = w.softness[lane];
  k.mu = w.mu[lane];
}

}  // namespace

void WideBlocks::begin(std::size_t blocks, std::size_t chosen, std::uint32_t idle) {
  groups_ = 0;
  alone_.clear();
  colours_.clear();
  idle_ = idle;
  reserveTightly(wide_, chosen / 4 + 1);
  blocks_ = static_cast<std::uint32_t>(blocks);
  resizeTightly(impulses_, blocks);
}

void WideBlocks::pack(std::span<const ContactBlock> blocks, std::span<const PackedAs> kinds,
                      std::span<const BlockOrder> order, std::uint32_t idle) {
  const auto size = static_cast<std::uint32_t>(blocks.size());
  begin(size, size, idle);
  for (std::uint32_t i = 0; i < size; ++i) {
    if (!isPlain(kinds[i])) impulses_[i] = blocks[i].lambda;
  }
  for (std::uint32_t first = 0, last = 0; first < size; first = last) {
    while (last < size && order[last].colour() == order[first].colour()) ++last;
    const bool mixed = order[first].colour() == BlockOrder::kMixed;
    const auto at = [&](std::size_t i) { return first + static_cast<std::uint32_t>(i); };
    const auto kind_at = [&](std::size_t i) { return mixed ? PackedAs::Alone : kinds[first + i]; };
    packColour(last - first, at, kind_at, blocks);
  }
}

void WideBlocks::packChosen(std::span<const ContactBlock> blocks,
                            std::span<const std::uint32_t> chosen,
                            const std::vector<SolverVelocity>& u, std::uint32_t idle) {
  begin(blocks.size(), chosen.size(), idle);
  for (const std::uint32_t i : chosen) impulses_[i] = blocks[i].lambda;
  if (taken_.size() < u.size()) resizeTightly(taken_, u.size());
  const auto moves = [&](std::uint32_t body) {
    return u[body].inv_mass != 0.0 || u[body].inv_inertia != 0.0;
  };
  const auto isTaken = [&](std::uint32_t body) {
    return taken_[body] == colours_so_far_ && moves(body);
  };
  colour_.clear();
  ++colours_so_far_;
  for (const std::uint32_t i : chosen) {
    const ContactBlock& k = blocks[i];
    if (isTaken(k.a) || isTaken(k.b)) {
      packChosenColour(blocks);
      colour_.clear();
      ++colours_so_far_;
    }
    taken_[k.a] = taken_[k.b] = colours_so_far_;
    colour_.push_back(i);
  }
  packChosenColour(blocks);
}

void WideBlocks::packChosenColour(std::span<const ContactBlock> blocks) {
  const auto at = [&](std::size_t i) { return colour_[i]; };
  const auto kind_at = [&](std::size_t i) { return packedAs(blocks[colour_[i]]); };
  packColour(colour_.size(), at, kind_at, blocks);
}

/// Four of a kind are a group, and so are the last ones of a kind.
template <class At, class KindAt>
void WideBlocks::packColour(std::size_t size, At&& at, KindAt&& kind_at,
                            std::span<const ContactBlock> blocks) {
  const auto packKind = [&](PackedAs kind) {
    std::array<std::uint32_t, 4> chosen{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < size; ++i) {
      if (kind_at(i) != kind) continue;
      chosen[count++] = at(i);
      if (count == 4) packGroup({chosen.data(), std::exchange(count, 0)}, kind, blocks);
    }
    if (count > 0) packGroup({chosen.data(), count}, kind, blocks);
  };
  Colour colour;
  packKind(PackedAs::PlainPair);
  packKind(PackedAs::Pair);
  colour.last_pair = groups_;
  packKind(PackedAs::PlainSingle);
  packKind(PackedAs::Single);
  colour.last_single = groups_;
  for (std::size_t i = 0; i < size; ++i) {
    if (kind_at(i) == PackedAs::Alone) alone_.push_back(at(i));
  }
  colour.last_alone = static_cast<std::uint32_t>(alone_.size());
  colours_.push_back(colour);
}

void WideBlocks::packGroup(std::span<const std::uint32_t> chosen, PackedAs kind,
                           std::span<const ContactBlock> blocks) {
  const bool plain = isPlain(kind);
  const bool pairs = kind == PackedAs::PlainPair || kind == PackedAs::Pair;
  if (chosen.size() < kLeastLanes) {
    alone_.insert(alone_.end(), chosen.begin(), chosen.end());
    return;
  }
  if (groups_ == wide_.size()) appendTightly(wide_);
  WideBlock& w = wide_[groups_++];
  w.points = pairs ? 2 : 1;
  w.plain = plain;
  w.too_close = 0;
  const std::uint32_t unused = chosen.size() < 4 ? addUnused() : 0;
  for (std::size_t lane = 0; lane < 4; ++lane) {
    w.block[lane] = lane < chosen.size() ? chosen[lane] : unused;
  }
  for (std::size_t lane = 0; !plain && lane < chosen.size(); ++lane) {
    setLane(w, lane, blocks[chosen[lane]]);
  }
  if (!isFull(w)) clearUnused(w);
}

/// Impulses of the lanes of a group that have no block: none of another group, which another thread
/// may solve.
std::uint32_t WideBlocks::addUnused() {
  appendTightly(impulses_);
  return static_cast<std::uint32_t>(impulses_.size() - 1);
}

void WideBlocks::clearUnused(WideBlock& group) const {
  const ContactBlock none{.a = idle_, .b = idle_};
  for (std::size_t lane = 0; lane < 4; ++lane) {
    if (!isUsed(group, lane)) setLane(group, lane, none);
  }
}

void WideBlocks::takeOut(std::size_t group, std::size_t lane, const ContactBlock& block) {
  WideBlock& w = wide_[group];
  auto colour =
      std::ranges::find_if(colours_, [&](const Colour& c) { return group < c.last_single; });
  const std::uint32_t i = std::exchange(w.block[lane], addUnused());
  clearUnused(w);
  impulses_[i] = block.lambda;
  alone_.insert(alone_.begin() + static_cast<std::ptrdiff_t>(colour->last_alone), i);
  for (; colour != colours_.end(); ++colour) ++colour->last_alone;
}

void WideBlocks::warmStart(std::span<const ContactBlock> blocks, std::vector<SolverVelocity>& u,
                           SweepPath path, TaskPool* tasks) {
  const auto warm_start = wideKernels(path).warm_start;
  forEachColour(warm_start, u, tasks,
                [&](std::uint32_t i) { applyImpulses(blocks[i], u[blocks[i].a], u[blocks[i].b]); });
}

void WideBlocks::sweep(std::span<ContactBlock> blocks, std::vector<SolverVelocity>& u,
                       SweepPath path, TaskPool* tasks) {
  forEachColour(wideKernels(path).sweep, u, tasks, [&](std::uint32_t i) {
    ContactBlock& k = blocks[i];
    k.lambda = impulses_[i];
    solveBlock(k, k.nx, k.ny, u[k.a], u[k.b]);
    impulses_[i] = k.lambda;
  });
}

/// Colour by colour: `wide` for the groups, `one` for blocks that are solved alone.
template <class One>
void WideBlocks::forEachColour(WideKernels::OnImpulses wide, std::vector<SolverVelocity>& u,
                               TaskPool* tasks, One&& one) {
  const WideBlock* const all = wide_.data();
  std::uint32_t group = 0, alone = 0;
  for (const Colour& colour : colours_) {
    forEachRun(tasks, colour.last_single - group, kGrain, [&](std::size_t i, std::size_t n, int) {
      const std::size_t first = group + i, last = first + n;
      const std::size_t pairs = std::clamp<std::size_t>(colour.last_pair, first, last);
      wide(all + first, all + pairs, all + last, impulses_.data(), u.data());
    });
    group = colour.last_single;
    for (; alone < colour.last_alone; ++alone) one(alone_[alone]);
  }
}

void WideBlocks::unpack(std::span<ContactBlock> blocks) const {
  for (const WideBlock& w : groups()) {
    for (std::size_t lane = 0; w.plain && lane < 4; ++lane) {
      if (isUsed(w, lane)) takeLane(w, lane, blocks[w.block[lane]]);
    }
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].lambda = impulses_[i];
}

void WideBlocks::storeImpulses(std::span<ContactBlock> blocks,
                               std::span<const std::uint32_t> chosen) const {
  for (const std::uint32_t i : chosen) blocks[i].lambda = impulses_[i];
}

std::size_t WideBlocks::memoryBytes() const {
  return bytesOf(wide_, alone_, colours_, impulses_, colour_, taken_);
}

}  // namespace merge2d
