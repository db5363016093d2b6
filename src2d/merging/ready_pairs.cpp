#include "src2d/merging/ready_pairs.h"

#include <algorithm>
#include <tuple>

#include "src2d/collections/joint_welds.h"
#include "src2d/merging/pair_readiness.h"
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

/// A pair that joints alone make ready; they hold it when they count as contacts.
void noteJoint(const State& state, Notes* notes, const JointEdge& joint) {
  noteMerge(state, notes, {joint.a, joint.b, 0, 0},
            {.criterion = "freedoms",
             .equation = kOwnMerging,
             .value = static_cast<double>(joint.freedoms),
             .threshold = kFreedoms,
             .verdict = joint.contacts > 0 ? "merge" : "wait"});
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

void noteMerge(const State& state, Notes* notes, const BodyPair& pair, Decision test) {
  if (!notes) return;
  test.a = pair.a;
  test.b = pair.b;
  test.stage = "Merge";
  test.needed = state.settings.merging.steps;
  const bool touches = pair.count > 0;  // or is held by joints alone
  test.count = touches ? state.contacts[state.contacts.order[pair.first]].quiet_steps : test.needed;
  test.before = test.count;
  notes->decisions.push_back(test);
}

void listReadyPairs(const State& state, Scratch& scratch, const MergeGraph& graph) {
  const int needed = state.settings.merging.steps;
  scratch.ready.clear();
  for (const BodyPair& pair : scratch.pairs) {
    const Contact& first = state.contacts[state.contacts.order[pair.first]];
    const bool counted = first.quiet_steps >= needed;
    if (first.quiet_steps > 0) {
      noteMerge(state, scratch.notes, pair,
                {.criterion = "count",
                 .equation = "Section 5.1",
                 .value = static_cast<double>(first.quiet_steps),
                 .threshold = static_cast<double>(needed),
                 .verdict = counted ? "merge" : "wait"});
    }
    if (!counted || areOnTwoFrames(state.rigid(pair.a), state.rigid(pair.b))) continue;
    scratch.ready.push_back({.pair = pair,
                             .node_a = graph.node(pair.a),
                             .node_b = graph.node(pair.b),
                             .contacts = activePoints(state, pair)});
  }
  for (const JointEdge& joint : readyJoints(state)) {
    noteJoint(state, scratch.notes, joint);
    if (joint.contacts == 0 || areOnTwoFrames(state.rigid(joint.a), state.rigid(joint.b))) continue;
    scratch.ready.push_back({.pair = {joint.a, joint.b, 0, 0},
                             .node_a = graph.node(joint.a),
                             .node_b = graph.node(joint.b),
                             .contacts = joint.contacts,
                             .joint_at = joint.at});
  }
  std::stable_sort(scratch.ready.begin(), scratch.ready.end(),
                   [](const ReadyPair& x, const ReadyPair& y) { return keyOf(x) < keyOf(y); });
}

void noteTwoFrames(const State& state, Scratch& scratch) {
  if (!scratch.notes) return;
  const auto note = [&](BodyId one, BodyId other) {
    if (!areOnTwoFrames(state.rigid(one), state.rigid(other))) return;
    scratch.notes->decisions.push_back({.a = one,
                                        .b = other,
                                        .stage = "Merge",
                                        .criterion = "frames",
                                        .equation = kOwnMerging,
                                        .value = 2.0,
                                        .threshold = 1.0,
                                        .needed = state.settings.merging.steps,
                                        .verdict = "apart"});
  };
  for (const BodyPair& pair : scratch.pairs) note(pair.a, pair.b);
  for (const JointEdge& joint : readyJoints(state)) note(joint.a, joint.b);
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
