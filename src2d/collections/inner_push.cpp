#include "src2d/collections/inner_push.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "src2d/collections/joint_sweep.h"
#include "src2d/core/memory.h"

namespace merge2d {
namespace {

/// One side of a block.
struct End {
  Twist* push = nullptr;  ///< null: no member, or one that is not asked for
  double mass = 1.0, inertia = 1.0;

  void add(double sign, const Vec2& impulse, double moment) const {
    if (!push) return;
    push->vx += sign * impulse.x() / mass;
    push->vy += sign * impulse.y() / mass;
    push->omega += sign * moment / inertia;
  }
};

End endOf(const State& state, Collection& c, std::uint32_t member) {
  const Body& body = state[c.members[member]];
  return {&c.push.of[member], body.mass, body.inertia};
}

void addPush(const ContactBlock& k, const End& a, const End& b) {
  const Vec2 n(k.nx, k.ny), t = perpendicular(n);
  for (int i = 0; i < k.count; ++i) {
    const Vec2 impulse = k.lambda_n(i) * n + k.lambda_t(i) * t;
    a.add(-1.0, impulse, k.arm_an[i] * k.lambda_n(i) + k.arm_at[i] * k.lambda_t(i));
    b.add(1.0, impulse, k.arm_bn[i] * k.lambda_n(i) + k.arm_bt[i] * k.lambda_t(i));
  }
  if (!k.rolls()) return;
  a.add(-1.0, Vec2::Zero(), k.lambda_r());
  b.add(1.0, Vec2::Zero(), k.lambda_r());
}

}  // namespace

void layOutPush(const State& state, Collection& c) {
  if (!c.push.of.empty()) return;
  c.push.of.resize(c.members.size());
  // In one piece, as bodies lie far apart in memory, and blocks in the order of a sweep.
  std::vector<End> ends;
  ends.reserve(c.members.size() + 1);
  for (std::uint32_t m = 0; m < c.members.size(); ++m) ends.push_back(endOf(state, c, m));
  ends.emplace_back();  // the frame
  for (std::uint32_t i = 0; i < c.blocks.size(); ++i) {
    const Weld& weld = c.weldOf(i);
    addPush(c.blocks[i], ends[weld.node_a], ends[weld.node_b]);
  }
  const auto at = [&](std::uint32_t b) -> const End& {
    const bool member = b < state.bodies.size() && state.bodies[b].rigid == c.rigid;
    return member ? ends[state[rigidOf(BodyId{b})].member] : ends.back();
  };
  addJointPush(c, [&](std::uint32_t b, double sign, const Vec2& impulse, double moment) {
    at(b).add(sign, impulse, moment);
  });
}

void renewPush(const State& state, Collection& c, std::span<const std::uint32_t> members) {
  std::vector<std::uint32_t> blocks;
  for (const std::uint32_t m : members) {
    blocks.clear();
    for (const std::uint32_t w : c.welds_of[m]) {
      const Weld& weld = c.welds[w];
      for (std::uint32_t i = 0; i < weld.count; ++i) {
        blocks.push_back(c.contacts[weld.first + i].block);
      }
    }
    std::ranges::sort(blocks);  // the order of a whole pass: the same sums
    const auto body = static_cast<std::uint32_t>(index(c.members[m]));
    c.push.of[m] = {};
    const End own = endOf(state, c, m);
    for (const std::uint32_t i : blocks) {
      const ContactBlock& k = c.blocks[i];
      addPush(k, k.a == body ? own : End(), k.b == body ? own : End());
    }
  }
  std::vector<std::uint32_t> unbalanced;
  std::set_union(c.push.unbalanced.begin(), c.push.unbalanced.end(), members.begin(), members.end(),
                 std::back_inserter(unbalanced));
  c.push.unbalanced = std::move(unbalanced);
}

void extendPush(const State& state, Collection& c, std::uint32_t first) {
  if (c.push.of.empty()) return;
  const auto members = static_cast<std::uint32_t>(c.members.size());
  resizeTightly(c.push.of, members);
  const auto end = [&](std::uint32_t node) {
    return node < members ? endOf(state, c, node) : End();
  };
  for (std::uint32_t i = first; i < c.blocks.size(); ++i) {
    const Weld& weld = c.weldOf(i);
    addPush(c.blocks[i], end(weld.node_a), end(weld.node_b));
  }
  c.push.forgetUnbalanced();
}

}  // namespace merge2d
