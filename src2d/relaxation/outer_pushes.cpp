#include "src2d/relaxation/outer_pushes.h"

#include <algorithm>
#include <utility>

#include "src2d/relaxation/cone_impulses.h"

namespace merge2d {
namespace {

/// A contact of a free body with a member.
struct Push {
  BodyId from{}, to{};
  ContactTable::Slot slot{};
};

/// In the order of the bodies that push.
std::vector<Push> pushesOn(const State& state, const Scratch& scratch, const Collection& c) {
  std::vector<Push> pushes;
  const auto isFree = [&](BodyId b) {
    return state[b].rigid == rigidOf(b) && state.rigid(b).floating() && !state.rigid(b).asleep;
  };
  for (const BodyPair& pair : scratch.pairs) {
    const bool to_a = state[pair.a].rigid == c.rigid, to_b = state[pair.b].rigid == c.rigid;
    if (to_a == to_b || !isFree(to_a ? pair.b : pair.a)) continue;
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      const Push push{to_a ? pair.b : pair.a, to_a ? pair.a : pair.b, state.contacts.order[i]};
      if (state.contacts[push.slot].count > 0) pushes.push_back(push);
    }
  }
  std::ranges::stable_sort(pushes, {}, &Push::from);
  return pushes;
}

/// The edges of the cones of its points; moments on the member in newton metre seconds.
void listEdges(const State& state, const Push& push, std::vector<ConeEdge>& edges) {
  const double size = state.extent(rigidOf(push.from)).box.half.norm();
  const Contact& contact = state.contacts[push.slot];
  const Pose pose_a = state.pose(contact.key.a);
  const Vec2 n = pose_a.rotation * contact.normal, t = perpendicular(n);
  for (int i = 0; i < contact.count; ++i) {
    const ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
    if (point.lambda_n <= 0.0) continue;  // it may be apart
    const Vec2 p = pose_a * point.position;
    const Vec2 arm_a = p - pose_a.position, arm_b = p - state.pose(contact.key.b).position;
    const ConePoint of{.nx = n.x(),
                       .ny = n.y(),
                       .arm_an = cross(arm_a, n),
                       .arm_at = cross(arm_a, t),
                       .arm_bn = cross(arm_b, n),
                       .arm_bt = cross(arm_b, t),
                       .mu = frictionOf(state, contact.key.a, contact.key.b),
                       .lambda_n = point.lambda_n,
                       .lambda_t = point.lambda_t};
    addEdges(of, push.from == contact.key.b, size, 1.0,
             {.other = static_cast<std::uint32_t>(push.to)}, edges);
  }
}

/// The smallest impulses with the same sum on the body that pushes. False where the sum is none of
/// these edges alone.
bool relieve(std::vector<ConeEdge>& edges) {
  Wrench sum;
  std::vector<ConeEdge> least = edges;
  for (ConeEdge& edge : least) sum += std::exchange(edge.held, 0.0) * edge.on;
  constexpr double kExact = 1e-6;
  const Wrench left = balance(least, -1.0 * sum);
  if (left.dot(left) > kExact * kExact * sum.dot(sum)) return false;
  for (std::size_t i = 0; i < edges.size(); ++i) edges[i].change = least[i].change - edges[i].held;
  return true;
}

void addChanges(const State& state, const std::vector<ConeEdge>& edges,
                std::vector<OuterLoad>& loads) {
  for (const ConeEdge& edge : edges) {
    const std::uint32_t member = state[rigidOf(BodyId{edge.other})].member;
    const auto at = std::ranges::lower_bound(loads, member, {}, &OuterLoad::member);
    if (at == loads.end() || at->member != member) continue;
    at->impulse += edge.change * Vec2(edge.on_other.x, edge.on_other.y);
    at->moment += edge.change * edge.on_other.spin;
  }
}

}  // namespace

std::vector<OuterLoad> relievedLoads(const State& state, const Scratch& scratch,
                                     const Collection& c, const CollectionLoad& load) {
  std::vector<OuterLoad> loads(load.outer.begin(), load.outer.end());
  const std::vector<Push> pushes = pushesOn(state, scratch, c);
  std::vector<ConeEdge> edges;
  for (auto first = pushes.begin(); first != pushes.end();) {
    const auto isOther = [&](const Push& push) { return push.from != first->from; };
    const auto last = std::find_if(first, pushes.end(), isOther);
    edges.clear();
    for (auto push = first; push != last; ++push) listEdges(state, *push, edges);
    if (last - first > 1 && relieve(edges)) addChanges(state, edges, loads);
    first = last;
  }
  return loads;
}

}  // namespace merge2d
