#include "src2d/relaxation/load_path.h"

#include <algorithm>
#include <cmath>

#include "src2d/relaxation/region_members.h"

namespace merge2d {
namespace {

Vec2 directionOf(double x, double y) {
  const Vec2 v(x, y);
  const double length = v.norm();
  return length > 0.0 ? Vec2(v / length) : Vec2(Vec2::UnitX());
}

}  // namespace

LoadPath::LoadPath(const State& state, const Scratch& scratch, const Collection& c)
    : state_(state), scratch_(scratch), c_(c), place_(c.members.size(), 0) {}

bool LoadPath::find(const MemberLoad& load, double tolerance) {
  tolerance_ = tolerance;
  const Vec2 along = directionOf(load.gain.vx, load.gain.vy);
  const std::span<const MemberLoad> alone(&load, 1);
  return find(alone, along) || find(alone, -along);
}

bool LoadPath::find(std::span<const MemberLoad> loads, const FrameLoad& frame, double tolerance) {
  tolerance_ = tolerance;
  return find(loads, directionOf(frame[0], frame[1]));
}

bool LoadPath::find(std::span<const MemberLoad> loads, const Vec2& along) {
  forgetNodes();
  along_ = along;
  front_.clear();
  changes_.clear();
  for (const MemberLoad& load : loads) {
    const Body& body = state_[c_.members[load.member]];
    const double moment = body.inertia * load.gain.omega;
    add(load.member,
        {body.mass * load.gain.vx, body.mass * load.gain.vy, moment / nodeOf(load.member).size});
  }
  while (!front_.empty()) {
    if (!passOn(takeFirst())) return false;
  }
  return true;
}

void LoadPath::forgetNodes() {
  for (const Node& node : nodes_) place_[node.member] = 0;
  nodes_.clear();
}

void LoadPath::apply(Collection& c) {
  for (const Change& change : changes_) {
    ContactBlock& k = c.blocks[change.block];
    before_.emplace_back(change.block, k.lambda);
    k.lambda_n(change.point) += change.n;
    k.lambda_t(change.point) += change.t;
  }
}

std::vector<std::uint32_t> LoadPath::members() const {
  std::vector<std::uint32_t> members;
  for (const Node& node : nodes_) members.push_back(node.member);
  std::ranges::sort(members);
  return members;
}

void LoadPath::restore(Collection& c) {
  for (; !before_.empty(); before_.pop_back()) {
    c.blocks[before_.back().first].lambda = before_.back().second;
  }
}

/// To the bodies behind its contacts. False where these cannot take it.
bool LoadPath::passOn(std::uint32_t member) {
  const Node node = known(member);
  const auto isSlow = [&](const Wrench& w) {
    return node.inv_mass * std::sqrt(w.x * w.x + w.y * w.y) + node.turn * std::abs(w.spin) <=
           tolerance_;
  };
  if (isSlow(node.load)) return true;
  listEdges(member);
  if (!isSlow(balance(edges_, node.load))) return false;
  for (const ConeEdge& edge : edges_) {
    if (edge.change == 0.0) continue;
    changes_.push_back({edge.block, edge.point, edge.change, edge.slope * edge.change});
    if (!isFrame(c_, edge.other)) add(edge.other, edge.change * edge.on_other);
  }
  return true;
}

void LoadPath::add(std::uint32_t member, const Wrench& load) {
  Node& node = nodeOf(member);
  node.load += load;
  if (std::exchange(node.waits, true)) return;
  front_.push_back(member);
  std::push_heap(front_.begin(), front_.end(), [&](auto a, auto b) { return isBefore(b, a); });
}

std::uint32_t LoadPath::takeFirst() {
  std::pop_heap(front_.begin(), front_.end(), [&](auto a, auto b) { return isBefore(b, a); });
  const std::uint32_t member = front_.back();
  front_.pop_back();
  return member;
}

void LoadPath::listEdges(std::uint32_t member) {
  edges_.clear();
  for (const std::uint32_t w : c_.welds_of[member]) {
    const Weld& weld = c_.welds[w];
    const std::uint32_t other = otherEnd(weld, member);
    if (weld.expected) continue;
    if (!isFrame(c_, other)) {
      nodeOf(other);
      if (!isBefore(member, other) || isOpen(other)) continue;
    }
    for (std::uint32_t i = weld.first; i < weld.first + weld.count; ++i) {
      listEdges(c_.contacts[i].block, member, other);
    }
  }
}

/// Points that may not have met yet take nothing.
void LoadPath::listEdges(std::uint32_t block, std::uint32_t member, std::uint32_t other) {
  const ContactBlock& k = c_.blocks[block];
  if (k.bilateral) return;
  const bool is_b = k.b == index(c_.members[member]);
  const double size = known(member).size, other_size = isFrame(c_, other) ? 1.0 : known(other).size;
  for (int i = 0; i < k.count; ++i) {
    if (k.bias[i] != 0.0) continue;
    const ConePoint point{.nx = k.nx,
                          .ny = k.ny,
                          .arm_an = k.arm_an[i],
                          .arm_at = k.arm_at[i],
                          .arm_bn = k.arm_bn[i],
                          .arm_bt = k.arm_bt[i],
                          .mu = k.mu,
                          .lambda_n = k.lambda_n(i),
                          .lambda_t = k.lambda_t(i)};
    addEdges(point, is_b, size, other_size, {.other = other, .block = block, .point = i}, edges_);
  }
}

LoadPath::Node& LoadPath::nodeOf(std::uint32_t member) {
  std::uint32_t& place = place_[member];
  if (place != 0) return nodes_[place - 1];
  Node& node = nodes_.emplace_back();
  place = static_cast<std::uint32_t>(nodes_.size());
  node.member = member;
  const Body& body = state_[c_.members[member]];
  node.depth = along_.dot(body.local);
  node.size = state_.extent(rigidOf(c_.members[member])).box.half.norm();
  node.inv_mass = 1.0 / body.mass;
  node.turn = node.size * node.size / body.inertia;
  return node;
}

}  // namespace merge2d
