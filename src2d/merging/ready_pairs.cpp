#include "src2d/merging/ready_pairs.h"

#include <algorithm>
#include <tuple>

#include "src2d/collections/joint_welds.h"
#include "src2d/merging/merge_criteria.h"
#include "src2d/merging/ready_joints.h"

namespace merge2d {
namespace {

/// The contacts of a pair come before its joints.
auto keyOf(const ReadyPair& r) { return std::tuple(r.pair.a, r.pair.b, r.pair.count == 0); }

/// True for a pair that was refused in the last step with the same nodes and no fewer contacts.
class Refused {
 public:
  explicit Refused(const std::vector<ReadyPair>& before) : before_(before) {}

  /// To be asked in ascending order.
  bool operator()(const ReadyPair& now) {
    while (next_ < before_.size() && keyOf(before_[next_]) < keyOf(now)) ++next_;
    if (next_ == before_.size() || keyOf(before_[next_]) != keyOf(now)) return false;
    const ReadyPair& then = before_[next_++];
    return then.node_a == now.node_a && then.node_b == now.node_b && now.contacts <= then.contacts;
  }

 private:
  const std::vector<ReadyPair>& before_;
  std::size_t next_ = 0;
};

/// Section 5.1.
Criterion wasQuietForLong(const State& state, int steps) {
  const int needed = state.settings.merging.steps;
  return {"count", "Section 5.1", static_cast<double>(steps), static_cast<double>(needed),
          steps >= needed};
}

/// A pair that joints alone make ready; they hold it when they count as contacts.
Criterion isHeldByJoints(const JointEdge& joint) {
  return {"freedoms", kOwnMerging, static_cast<double>(joint.freedoms), kFreedoms,
          joint.contacts > 0};
}

/// Two bodies that are fixed, if at all, to one frame.
Criterion haveOneFrame(const State& state, BodyId a, BodyId b) {
  const bool two = areOnTwoFrames(state.rigid(a), state.rigid(b));
  return {"frames", kOwnMerging, two ? 2.0 : 1.0, 1.0, !two};
}

}  // namespace

std::vector<Pin> MergeGraph::pinsOf(const std::vector<ReadyPair>& ready) const {
  std::vector<Pin> pins;
  Vec2 origin = Vec2::Zero();
  const auto add = [&](const ReadyPair& edge, const Vec2& at) {
    if (pins.empty()) origin = at;
    pins.push_back({.a = edge.node_a, .b = edge.node_b, .at = at - origin, .placed = true});
  };
  for (const ReadyPair& edge : ready) {
    const Pose pose = state_.pose(edge.pair.a);
    for (std::uint32_t i = edge.pair.first; i < edge.pair.first + edge.pair.count; ++i) {
      const Contact& contact = state_.contacts[state_.contacts.order[i]];
      for (int k = 0; k < contact.count; ++k) {
        const ContactPoint& p = contact.points[static_cast<std::size_t>(k)];
        if (p.lambda_n <= 0.0 && !isBilateral(state_, edge.pair.a, edge.pair.b)) continue;
        add(edge, pose * p.position);
      }
    }
    if (edge.pair.count > 0) continue;
    for (int k = 0; k < edge.contacts; ++k) add(edge, edge.joint_at + k * Vec2::UnitX());
  }
  return pins;
}

Decision* recordMerge(const State& state, Notes* notes, const BodyPair& pair,
                      const Criterion& test) {
  if (!notes) return nullptr;
  const int needed = state.settings.merging.steps;
  const bool touches = pair.count > 0;  // or is held by joints alone
  const int steps = touches ? state.contacts[state.contacts.order[pair.first]].quiet_steps : needed;
  return &notes->decisions.emplace_back(
      record(test, "Merge", pair.a, pair.b, test.holds ? "merge" : "wait", {steps, steps, needed}));
}

namespace {

/// Asleep a pair waits: its things are not looked at, and may be parked.
bool isAsleep(const State& state, const BodyPair& pair) {
  return state.rigid(pair.a).asleep || state.rigid(pair.b).asleep;
}

void listReadyContacts(const State& state, Scratch& scratch, const MergeGraph& graph) {
  for (const BodyPair& pair : scratch.pairs) {
    const int steps = state.contacts[state.contacts.order[pair.first]].quiet_steps;
    const Criterion counted = wasQuietForLong(state, steps);
    if (steps > 0) recordMerge(state, scratch.notes, pair, counted);
    if (!counted.holds || isAsleep(state, pair)) continue;
    if (!haveOneFrame(state, pair.a, pair.b).holds) continue;
    scratch.ready.push_back({.pair = pair,
                             .node_a = graph.node(pair.a),
                             .node_b = graph.node(pair.b),
                             .contacts = lookAt(state, pair).active});
  }
}

void listReadyJoints(const State& state, Scratch& scratch, const MergeGraph& graph) {
  for (const JointEdge& joint : pairsOfQuietJoints(state)) {
    const BodyPair pair{joint.a, joint.b, 0, 0};
    const Criterion held = isHeldByJoints(joint);
    recordMerge(state, scratch.notes, pair, held);
    if (!held.holds || isAsleep(state, pair)) continue;
    if (!haveOneFrame(state, joint.a, joint.b).holds) continue;
    scratch.ready.push_back({.pair = pair,
                             .node_a = graph.node(joint.a),
                             .node_b = graph.node(joint.b),
                             .contacts = joint.contacts,
                             .joint_at = joint.at});
  }
}

}  // namespace

void listReadyPairs(const State& state, Scratch& scratch, const MergeGraph& graph) {
  scratch.ready.clear();
  listReadyContacts(state, scratch, graph);
  listReadyJoints(state, scratch, graph);
  std::stable_sort(scratch.ready.begin(), scratch.ready.end(),
                   [](const ReadyPair& x, const ReadyPair& y) { return keyOf(x) < keyOf(y); });
}

void recordTwoFrames(const State& state, Scratch& scratch) {
  if (!scratch.notes) return;
  const auto ask = [&](BodyId a, BodyId b) {
    const Criterion one = haveOneFrame(state, a, b);
    if (one.holds) return;
    scratch.notes->decisions.push_back(
        record(one, "Merge", a, b, "apart", {.needed = state.settings.merging.steps}));
  };
  for (const BodyPair& pair : scratch.pairs) ask(pair.a, pair.b);
  for (const JointEdge& joint : pairsOfQuietJoints(state)) ask(joint.a, joint.b);
}

std::vector<ReadyPair> pairsToJudge(const State& state, const Scratch& scratch,
                                    const MergeGraph& graph) {
  std::vector<std::uint8_t> fresh;
  Refused refused(state.ready_before);
  for (const ReadyPair& edge : scratch.ready) fresh.push_back(!refused(edge));
  std::vector<ReadyPair> pairs;
  if (std::find(fresh.begin(), fresh.end(), 1) == fresh.end()) return pairs;

  DisjointSets parts;
  parts.reset(graph.nodes());
  for (const ReadyPair& edge : scratch.ready) {
    if (!graph.isFrame(edge.node_a) && !graph.isFrame(edge.node_b)) {
      parts.unite(edge.node_a, edge.node_b);
    }
  }
  const auto part = [&](const ReadyPair& edge) {
    return parts.find(graph.isFrame(edge.node_a) ? edge.node_b : edge.node_a);
  };
  std::vector<std::uint8_t> renewed(graph.nodes(), 0);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    if (fresh[i] != 0) renewed[part(scratch.ready[i])] = 1;
  }
  for (const ReadyPair& edge : scratch.ready) {
    if (renewed[part(edge)] != 0) pairs.push_back(edge);
  }
  return pairs;
}

}  // namespace merge2d
