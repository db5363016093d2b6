#include "src2d/merging/open_region.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "src2d/merging/collection.h"
#include "src2d/merging/collection_load.h"
#include "src2d/merging/decided_settings.h"

namespace merge2d {
namespace {

ContactBlock inWorld(const State& state, const Collection& c, const ContactBlock& inner) {
  ContactBlock k = inner;
  const Vec2 n = state[c.rigid].rotation * Vec2(k.nx, k.ny);
  k.nx = n.x();
  k.ny = n.y();
  return k;
}

/// A search has found motion, which may be that of any member.
bool wasSearched(const Collection& c) { return !c.certificate.front().search.movers.empty(); }

/// Slower than this no weld parts [m/s].
double slowestCut(const State& state, const Collection& c) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const Weld& weld : c.welds) slowest = std::min(slowest, cutSpeed(state, c, weld));
  return slowest;
}

}  // namespace

SolverVelocity solvedVelocity(const State& state, const Scratch& scratch, BodyId b) {
  const RigidId mover = moverOf(state, scratch, b);
  SolverVelocity u = scratch.u[index(mover)];
  if (mover == rigidOf(b)) return u;
  const Vec2 arm = state.pose(b).position - state[mover].x;
  u.vx -= u.omega * arm.y();
  u.vy += u.omega * arm.x();
  return u;
}

OpenRegion::OpenRegion(const State& state, const Scratch& scratch, Collection& c)
    : c_(&c), inside_(c.members.size() + 1, 1) {
  if (!opensInPart(state, c) || wasSearched(c)) return;
  std::fill(inside_.begin(), inside_.end() - 1, std::uint8_t{0});
  noise_ = slowestCut(state, c);
  findNeighbours();
  addTouched(state, scratch);
  addUnbalanced(state, scratch);
}

void OpenRegion::addTouched(const State& state, const Scratch& scratch) {
  const auto add = [&](BodyId b) {
    if (state[b].rigid == c_->rigid) inside_[state[rigidOf(b)].member] = 1;
  };
  for (const BodyPair& pair : scratch.pairs) {
    add(pair.a);
    add(pair.b);
  }
  for (const Kick& kick : scratch.kicks) add(kick.body);
  for (const Load& load : scratch.loads) add(load.body);
}

void OpenRegion::addUnbalanced(const State& state, const Scratch& scratch) {
  loadMembers(state, *c_, loadOn(state, scratch, *c_), left_);
  layOutPush(state, *c_);
  for (std::uint32_t m = 0; m < left_.size(); ++m) {
    Twist& left = left_[m];
    const Twist& push = c_->push[m];
    left = {left.vx + push.vx, left.vy + push.vy, left.omega + push.omega};
    const double reach = state.extent(rigidOf(c_->members[m])).box.half.norm();
    const double speed = Vec2(left.vx, left.vy).norm() + reach * std::abs(left.omega);
    if (speed <= noise_) continue;
    inside_[m] = 1;
    left = {};
  }
}

void OpenRegion::findNeighbours() {
  const auto frame = static_cast<std::uint32_t>(c_->members.size());
  first_.assign(frame + 2, 0);
  const auto forEachLink = [&](auto&& visit) {
    for (const Weld& weld : c_->welds) {
      if (weld.node_a == frame || weld.node_b == frame) continue;
      visit(weld.node_a, weld.node_b);
      visit(weld.node_b, weld.node_a);
    }
  };
  forEachLink([&](std::uint32_t from, std::uint32_t) { ++first_[from + 2]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  next_.resize(first_.back());
  forEachLink([&](std::uint32_t from, std::uint32_t to) { next_[first_[from + 1]++] = to; });
}

void OpenRegion::addAround(std::vector<std::uint32_t> members) {
  std::vector<std::uint32_t> ring;
  for (int i = 0; i < rings_; ++i) {
    ring.clear();
    for (const std::uint32_t m : members) {
      for (std::uint32_t n = first_[m]; n < first_[m + 1]; ++n) {
        if (inside_[next_[n]]) continue;
        inside_[next_[n]] = 1;
        ring.push_back(next_[n]);
      }
    }
    std::swap(members, ring);
  }
  rings_ *= 2;
}

template <class Visit>
void OpenRegion::forEachBlock(const Weld& weld, Visit&& visit) const {
  for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
    visit(c_->contacts[i].block);
  }
}

/// The blocks between a member inside and one outside.
template <class Visit>
void OpenRegion::forEachHeld(Visit&& visit) const {
  const auto frame = static_cast<std::uint32_t>(c_->members.size());
  for (const Weld& weld : c_->welds) {
    if (inside_[weld.node_a] == inside_[weld.node_b]) continue;
    const std::uint32_t in = inside_[weld.node_a] ? weld.node_a : weld.node_b;
    const std::uint32_t out = inside_[weld.node_a] ? weld.node_b : weld.node_a;
    if (in == frame) continue;
    forEachBlock(weld, [&](std::uint32_t block) { visit(c_->blocks[block], in, out); });
  }
}

void OpenRegion::list(State& state, Scratch& scratch) const {
  for (std::uint32_t m = 0; m < c_->members.size(); ++m) {
    if (!inside_[m]) continue;
    const BodyId b = c_->members[m];
    const Twist& start = scratch.open_start[index(b)];
    const Twist left = isWhole() ? Twist{} : left_[m];
    const Vec2 v = state[c_->rigid].rotation * Vec2(left.vx, left.vy);
    state[rigidOf(b)].v = Vec2(start.vx, start.vy) - v;
    state[rigidOf(b)].omega = start.omega - left.omega;
    scratch.open[index(b)] = 1;
    scratch.open_members.push_back(b);
  }
  forEachHeld([&](const ContactBlock& inner, std::uint32_t in, std::uint32_t) {
    const BodyId b = c_->members[in];
    Rigid& r = state[rigidOf(b)];
    SolverVelocity u{r.v.x(), r.v.y(), r.omega, 1.0 / state[b].mass, 1.0 / state[b].inertia}, rest;
    const bool is_a = inner.a == index(b);
    applyImpulses(inWorld(state, *c_, inner), is_a ? u : rest, is_a ? rest : u);
    r.v = {u.vx, u.vy};
    r.omega = u.omega;
  });
  const std::size_t first = scratch.open_rows.size();
  const auto slot = static_cast<std::uint32_t>(state.collections.slotOf(*c_));
  for (const Weld& weld : c_->welds) {
    if (!inside_[weld.node_a] || !inside_[weld.node_b]) continue;
    forEachBlock(weld, [&](std::uint32_t block) {
      scratch.open_rows.push_back(RowSource::inside(slot, block));
    });
  }
  std::sort(scratch.open_rows.begin() + static_cast<std::ptrdiff_t>(first), scratch.open_rows.end(),
            [](const RowSource& x, const RowSource& y) { return x.block() < y.block(); });
}

bool OpenRegion::widen(const State& state, const Scratch& scratch) {
  if (isWhole()) return false;
  std::vector<std::uint32_t> behind;
  forEachHeld([&](const ContactBlock& inner, std::uint32_t, std::uint32_t out) {
    const ContactBlock k = inWorld(state, *c_, inner);
    const double residual = residualOf(k, k.nx, k.ny, solvedVelocity(state, scratch, BodyId{k.a}),
                                       solvedVelocity(state, scratch, BodyId{k.b}));
    if (residual > noise_) behind.push_back(out);
  });
  if (behind.empty()) return false;
  for (const std::uint32_t m : behind) inside_[m] = 1;
  addAround(std::move(behind));
  return true;
}

}  // namespace merge2d
