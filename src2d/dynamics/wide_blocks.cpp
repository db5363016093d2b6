#include "src2d/dynamics/wide_blocks.h"

#include <algorithm>
#include <numeric>

#include "src2d/core/memory.h"
#include "src2d/dynamics/scratch.h"
#include "src2d/dynamics/task_pool.h"

namespace merge2d {

// Vectors are passed by reference, and within this file: no interface depends on how.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace portable {
#include "src2d/dynamics/wide_kernel.h"
}  // namespace portable

#if defined(__x86_64__) && !defined(__AVX2__)
#define MERGE2D_HAS_AVX2
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
namespace avx2 {
#include "src2d/dynamics/wide_kernel.h"
}  // namespace avx2
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

#pragma GCC diagnostic pop

namespace {

using SweepWide = decltype(&portable::sweepWide);

SweepWide sweepBy([[maybe_unused]] SweepPath path) {
#ifdef MERGE2D_HAS_AVX2
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (path == SweepPath::Avx2 && has_avx2) return avx2::sweepWide;
#endif
  return portable::sweepWide;
}

/// Fewer blocks than this of a colour are solved one by one.
constexpr std::uint32_t kLeastLanes = 2;

/// Blocks that the kernel knows: no magnets, no rolling discs.
bool isPlain(const ContactBlock& k) { return !k.bilateral && !k.rolls(); }

constexpr std::size_t kGrain = 16;  ///< groups that a thread solves in a row

/// The last colour holds what found no other; its blocks may share bodies.
constexpr std::uint32_t kMixedColour = 63;

void setLane(WideBlock& w, std::size_t lane, const ContactBlock& k, const SolverVelocity& a,
             const SolverVelocity& b) {
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
  w.inv_inertia_a[lane] = a.inv_inertia;
  w.inv_inertia_b[lane] = b.inv_inertia;
  w.surface_a[lane] = a.surface;
  w.surface_b[lane] = b.surface;
  w.a[lane] = k.a;
  w.b[lane] = k.b;
}

}  // namespace

void WideBlocks::begin(std::size_t blocks, std::size_t chosen) {
  wide_.clear();
  alone_.clear();
  colours_.clear();
  reserveTightly(wide_, chosen / 4 + 1);
  resizeTightly(impulses_, blocks + 2);
  impulses_[blocks] = impulses_[blocks + 1] = {};
}

void WideBlocks::pack(std::span<const ContactBlock> blocks, std::span<const BlockOrder> order,
                      const std::vector<SolverVelocity>& u, std::uint32_t idle) {
  const auto size = static_cast<std::uint32_t>(blocks.size());
  begin(size, size);
  for (std::uint32_t i = 0; i < size; ++i) impulses_[i] = blocks[i].lambda;
  for (std::uint32_t first = 0, last = 0; first < size; first = last) {
    while (last < size && order[last].colour() == order[first].colour()) ++last;
    if (order[first].colour() == kMixedColour) {
      for (std::uint32_t i = first; i < last; ++i) alone_.push_back(i);
      const auto wide = static_cast<std::uint32_t>(wide_.size());
      colours_.push_back({wide, wide, static_cast<std::uint32_t>(alone_.size())});
    } else {
      colour_.resize(last - first);
      std::iota(colour_.begin(), colour_.end(), first);
      packColour(blocks, u, idle);
    }
  }
}

void WideBlocks::packChosen(std::span<const ContactBlock> blocks,
                            std::span<const std::uint32_t> chosen,
                            const std::vector<SolverVelocity>& u, std::uint32_t idle) {
  begin(blocks.size(), chosen.size());
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
      packColour(blocks, u, idle);
      colour_.clear();
      ++colours_so_far_;
    }
    taken_[k.a] = taken_[k.b] = colours_so_far_;
    colour_.push_back(i);
  }
  packColour(blocks, u, idle);
}

void WideBlocks::packColour(std::span<const ContactBlock> blocks,
                            const std::vector<SolverVelocity>& u, std::uint32_t idle) {
  pairs_.clear();
  singles_.clear();
  for (const std::uint32_t i : colour_) {
    auto& list = !isPlain(blocks[i]) ? alone_ : blocks[i].count == 2 ? pairs_ : singles_;
    list.push_back(i);
  }
  Colour colour;
  packGroups(blocks, u, pairs_, idle, blocks.size());
  colour.last_pair = static_cast<std::uint32_t>(wide_.size());
  packGroups(blocks, u, singles_, idle, blocks.size() + 1);
  colour.last_single = static_cast<std::uint32_t>(wide_.size());
  colour.last_alone = static_cast<std::uint32_t>(alone_.size());
  colours_.push_back(colour);
}

void WideBlocks::packGroups(std::span<const ContactBlock> blocks,
                            const std::vector<SolverVelocity>& u,
                            const std::vector<std::uint32_t>& chosen, std::uint32_t idle,
                            std::size_t idle_impulses) {
  const ContactBlock none{.a = idle, .b = idle};
  for (std::size_t first = 0; first < chosen.size(); first += 4) {
    const std::size_t last = std::min(first + 4, chosen.size());
    if (last - first < kLeastLanes) {
      alone_.insert(alone_.end(), chosen.begin() + static_cast<std::ptrdiff_t>(first),
                    chosen.end());
      return;
    }
    appendTightly(wide_);
    WideBlock& w = wide_.back();
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const bool used = first + lane < last;
      const ContactBlock& k = used ? blocks[chosen[first + lane]] : none;
      setLane(w, lane, k, u[k.a], u[k.b]);
      w.block[lane] = used ? chosen[first + lane] : static_cast<std::uint32_t>(idle_impulses);
    }
  }
}

void WideBlocks::sweep(std::span<ContactBlock> blocks, std::vector<SolverVelocity>& u,
                       SweepPath path, TaskPool* tasks) {
  const SweepWide sweep_wide = sweepBy(path);
  const WideBlock* const all = wide_.data();
  std::uint32_t wide = 0, alone = 0;
  for (const Colour& colour : colours_) {
    forEachRun(tasks, colour.last_single - wide, kGrain, [&](std::size_t i, std::size_t n, int) {
      const std::size_t first = wide + i, last = first + n;
      const std::size_t pairs = std::clamp<std::size_t>(colour.last_pair, first, last);
      sweep_wide(all + first, all + pairs, all + last, impulses_.data(), u.data());
    });
    wide = colour.last_single;
    for (; alone < colour.last_alone; ++alone) {
      ContactBlock& k = blocks[alone_[alone]];
      Impulses& impulses = impulses_[alone_[alone]];
      k.lambda = impulses;
      solveBlock(k, k.nx, k.ny, u[k.a], u[k.b]);
      impulses = k.lambda;
    }
  }
}

void WideBlocks::storeImpulses(std::span<ContactBlock> blocks) const {
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].lambda = impulses_[i];
}

void WideBlocks::storeImpulses(std::span<ContactBlock> blocks,
                               std::span<const std::uint32_t> chosen) const {
  for (const std::uint32_t i : chosen) blocks[i].lambda = impulses_[i];
}

std::size_t WideBlocks::memoryBytes() const {
  return bytesOf(wide_, alone_, colours_, impulses_, colour_, pairs_, singles_, taken_);
}

}  // namespace merge2d
