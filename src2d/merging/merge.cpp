#include "src2d/merging/merge.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <tuple>

#include "src2d/contact/broadphase.h"
#include "src2d/contact/detection.h"
#include "src2d/core/memory.h"
#include "src2d/merging/collection.h"
#include "src2d/merging/cycles.h"
#include "src2d/merging/joint_welds.h"
#include "src2d/merging/metric.h"

namespace merge2d {
namespace {

constexpr double kOnEdge = 1.0 - 1e-6;

VelocityField fieldOf(const Rigid& r) { return {r.x, r.v, r.omega}; }

OrientedBox worldBox(const Rigid& r) {
  OrientedBox box = r.box;
  box.frame = r.frame() * box.frame;
  return box;
}

/// The corners of a box and how the two move against each other there, for who asks.
void noteCorners(Notes* notes, const BodyPair& pair, const OrientedBox& box, const Rigid& a,
                 const Rigid& b) {
  if (!notes) return;
  NotedCorners seen{.a = pair.a, .b = pair.b, .at = box.corners()};
  for (std::size_t i = 0; i < seen.at.size(); ++i) {
    seen.velocity[i] = fieldOf(a).at(seen.at[i]) - fieldOf(b).at(seen.at[i]);
  }
  notes->corners.push_back(seen);
}

/// What the contacts of one pair say.
struct PairContacts {
  int active = 0;
  double fastest_slip = 0.0;    ///< of active contacts [m/s]
  double largest_breath = 0.0;  ///< change of the overlap since the last step [m]
  int on_edge = 0;              ///< active contacts at the limit of their cone
};

PairContacts lookAt(const State& state, const BodyPair& pair) {
  PairContacts seen;
  const bool bilateral = isBilateral(state, pair.a, pair.b);
  const double mu = frictionOf(state, pair.a, pair.b);
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const Contact& contact = state.contacts[state.contacts.order[i]];
    for (int k = 0; k < contact.count; ++k) {
      const ContactPoint& p = contact.points[static_cast<std::size_t>(k)];
      if (p.lambda_n <= 0.0 && !bilateral) continue;
      ++seen.active;
      seen.fastest_slip = std::max<double>(seen.fastest_slip, std::abs(p.w_t));
      seen.largest_breath = std::max<double>(seen.largest_breath, std::abs(p.breath));
      const bool at_rest = std::abs(p.w_t) < state.settings.sleeping.velocity;
      seen.on_edge += !bilateral && !at_rest && std::abs(p.lambda_t) >= kOnEdge * mu * p.lambda_n;
    }
  }
  return seen;
}

/// All active contacts are on the edge of their cones: is there a motion of b against a, keeping
/// all of them closed, in which every one slips against its friction? A body wedged into a corner
/// is on the edge too, but goes nowhere.
bool aboutToSlide(const State& state, const BodyPair& pair) {
  const Pose pose = state.pose(pair.b);
  const double size = state[rigidOf(pair.b)].box.half.norm();
  std::vector<Eigen::Vector3d> tangents;  // rows: slip by a motion (v, size · omega) of b
  Eigen::Matrix3d closed = Eigen::Matrix3d::Zero();  // sum of the normals' rows, squared
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const Contact& contact = state.contacts[state.contacts.order[i]];
    const Pose a = state.pose(pair.a);
    const Vec2 n = a.rotation * contact.normal, t = perpendicular(n);
    for (int k = 0; k < contact.count; ++k) {
      const ContactPoint& p = contact.points[static_cast<std::size_t>(k)];
      if (p.lambda_n <= 0.0) continue;
      const Vec2 arm = (a * p.position - pose.position) / size;
      const Eigen::Vector3d normal(n.x(), n.y(), cross(arm, n));
      closed += normal * normal.transpose();
      tangents.push_back(Eigen::Vector3d(t.x(), t.y(), cross(arm, t)) *
                         (p.lambda_t > 0.0 ? 1.0 : -1.0));
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(closed);
  constexpr double kRankTolerance = 1e-6;
  const auto free = (modes.eigenvalues().array() < kRankTolerance).count();
  if (free != 1) return free > 1;
  const Eigen::Vector3d motion = modes.eigenvectors().col(0);
  const auto along = [&](const Eigen::Vector3d& row) { return row.dot(motion); };
  return std::all_of(tangents.begin(), tangents.end(),
                     [&](const auto& r) { return along(r) > 0; }) ||
         std::all_of(tangents.begin(), tangents.end(), [&](const auto& r) { return along(r) < 0; });
}

/// Tests the merge criteria of one pair, and writes them down when somebody asks.
class PairTest {
 public:
  PairTest(const State& state, const BodyPair& pair, Notes* notes)
      : state_(state), pair_(pair), notes_(notes), first_(notes ? notes->decisions.size() : 0) {}

  bool ready() {
    const MergingSettings& m = state_.settings.merging;
    const PairContacts seen = lookAt(state_, pair_);
    bool ok = seen.active > 0;
    if (!ok) return note("pressed", "Section 5.3", seen.active, 1.0, false);
    if (m.rule == Rule::Default) {
      const bool slides = seen.on_edge == seen.active && aboutToSlide(state_, pair_);
      ok &= note("edge", "(20)", seen.on_edge, seen.active, !slides);
    }
    if (!ok && !notes_) return false;
    ok &= below("sliding", "(18)", seen.fastest_slip, m.sliding);
    ok &= below("breathing", "Section 5.3", seen.largest_breath, m.breathing);
    if (!ok && !notes_) return false;
    return below("relative-motion", "(17)", relativeMotion(state_, pair_, notes_), m.velocity) &&
           ok;
  }

  /// What all criteria together make of the count.
  void noteCount(int before, int now) const {
    if (!notes_) return;
    for (std::size_t i = first_; i < notes_->decisions.size(); ++i) {
      notes_->decisions[i].before = before;
      notes_->decisions[i].count = now;
    }
  }

 private:
  bool below(std::string_view criterion, std::string_view equation, double value,
             double threshold) {
    return note(criterion, equation, value, threshold, value < threshold);
  }

  bool note(std::string_view criterion, std::string_view equation, double value, double threshold,
            bool ok) {
    if (notes_) {
      notes_->decisions.push_back({.a = pair_.a,
                                   .b = pair_.b,
                                   .stage = "AccumulateRelativeMotion",
                                   .criterion = criterion,
                                   .equation = equation,
                                   .value = value,
                                   .threshold = threshold,
                                   .needed = state_.settings.merging.steps,
                                   .verdict = ok ? "below" : "apart"});
    }
    return ok;
  }

  const State& state_;
  const BodyPair& pair_;
  Notes* notes_;
  std::size_t first_;  ///< of this pair's decisions
};

void countQuietPairs(State& state, Scratch& scratch) {
  for (const BodyPair& pair : scratch.pairs) {
    const Rigid &a = state.rigid(pair.a), &b = state.rigid(pair.b);
    if (a.asleep || b.asleep || !(a.floating() || b.floating() || a.anchor == b.anchor)) continue;
    Contact& first = state.contacts[state.contacts.order[pair.first]];
    const int count = first.quiet_steps;
    PairTest test(state, pair, scratch.notes);
    const int now = test.ready() ? count + 1 : 0;
    test.noteCount(count, now);
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      state.contacts[state.contacts.order[i]].quiet_steps = now;
    }
  }
}

/// Section 7: each rigid thing against the inertial frame.
void countQuietRigids(State& state, Notes* notes) {
  const SleepingSettings& sleeping = state.settings.sleeping;
  const VelocityField still;
  for (std::size_t i = 0; i < state.rigids.size(); ++i) {
    Rigid& r = state.rigids[i];
    if (!r.present() || r.asleep) continue;
    const double motion = fastestCorner(worldBox(r), fieldOf(r), still);
    const int before = r.quiet_steps;
    const bool quiet = motion < sleeping.velocity;
    r.quiet_steps = quiet ? r.quiet_steps + 1 : 0;
    const bool collection = i >= state.bodies.size();
    if (!notes || !(r.floating() || collection)) continue;
    const BodyId body = collection ? state.collections[i - state.bodies.size()].members.front()
                                   : BodyId{static_cast<std::uint32_t>(i)};
    notes->decisions.push_back({.a = body,
                                .b = body,
                                .stage = "AccumulateRelativeMotion",
                                .criterion = "rest",
                                .equation = "Section 7",
                                .value = motion,
                                .threshold = sleeping.velocity,
                                .count = r.quiet_steps,
                                .needed = sleeping.steps,
                                .verdict = quiet ? "below" : "awake",
                                .before = before});
  }
}

int activePoints(const State& state, const BodyPair& pair) { return lookAt(state, pair).active; }

/// Rigid things as nodes; everything fixed to one frame is one node.
class MergeGraph {
 public:
  explicit MergeGraph(const State& state) : state_(state) {}

  std::uint32_t node(BodyId b) const {
    const Rigid& r = state_.rigid(b);
    return r.floating() ? static_cast<std::uint32_t>(state_[b].rigid)
                        : rigids() + static_cast<std::uint32_t>(r.anchor);
  }
  bool isFrame(std::uint32_t node) const { return node >= rigids(); }
  std::uint32_t nodes() const {
    return rigids() + static_cast<std::uint32_t>(state_.bodies.size() + 1);
  }

  /// The active contacts of pairs, about one of them: far from the origin nothing is lost.
  std::vector<Pin> pinsOf(const std::vector<ReadyPair>& ready) const {
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

 private:
  std::uint32_t rigids() const { return static_cast<std::uint32_t>(state_.rigids.size()); }

  const State& state_;
};

/// Writes down whether a pair is welded, as far as one test knows.
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

/// The contacts of a pair come before its joints.
auto keyOf(const ReadyPair& r) { return std::tuple(r.pair.a, r.pair.b, r.pair.count == 0); }

/// Collects the pairs that were ready for long enough.
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
    if (!counted) continue;
    scratch.ready.push_back({.pair = pair,
                             .node_a = graph.node(pair.a),
                             .node_b = graph.node(pair.b),
                             .contacts = activePoints(state, pair)});
  }
  for (const JointEdge& joint : readyJoints(state)) {
    scratch.ready.push_back({.pair = {joint.a, joint.b, 0, 0},
                             .node_a = graph.node(joint.a),
                             .node_b = graph.node(joint.b),
                             .contacts = joint.contacts,
                             .joint_at = joint.at});
  }
  std::stable_sort(scratch.ready.begin(), scratch.ready.end(),
                   [](const ReadyPair& x, const ReadyPair& y) { return keyOf(x) < keyOf(y); });
}

/// True for a pair that was refused in the last step, being then what it is now.
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

/// The ready pairs about which there is something new. One contact more can only make a group more
/// rigid, one less only less: pairs that were refused are looked at again when they hang together
/// with one that is new, other than through a frame.
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

/// Writes down for each ready pair which group holds it, if any does. `group` is empty when nothing
/// was judged.
void noteGroups(const State& state, Scratch& scratch, const Groups& group) {
  if (!scratch.notes) return;
  const auto held = [&](const ReadyPair& edge) {
    return !group.empty() && group[edge.node_a] == group[edge.node_b];
  };
  std::vector<std::int32_t> first_body(group.size(), -1);
  for (const ReadyPair& edge : scratch.ready) {  // ascending
    if (!held(edge)) continue;
    std::int32_t& first = first_body[group[edge.node_a]];
    if (first < 0) first = static_cast<std::int32_t>(edge.pair.a);
  }
  for (const ReadyPair& edge : scratch.ready) {
    noteMerge(state, scratch.notes, edge.pair,
              {.criterion = "cycle",
               .equation = "Section 8.2",
               .value = static_cast<double>(edge.contacts),
               .threshold = 2.0,
               .verdict = held(edge) ? "merge" : "wait",
               .group = held(edge) ? first_body[group[edge.node_a]] : -1});
  }
}

/// The pairs to weld: ready, and held in the group that they would form.
std::vector<BodyPair> pairsToWeld(State& state, Scratch& scratch) {
  const MergingSettings& m = state.settings.merging;
  const CycleCriterion criterion = m.rule == Rule::Paper ? CycleCriterion::Off : m.cycles;
  const MergeGraph graph(state);
  listReadyPairs(state, scratch, graph);
  const std::vector<ReadyPair> pairs = pairsToJudge(state, scratch, graph);
  Groups group;
  std::vector<BodyPair> held;
  if (!pairs.empty()) group = heldGroups(graph.nodes(), graph.pinsOf(pairs), criterion);
  for (const ReadyPair& edge : pairs) {
    if (group[edge.node_a] == group[edge.node_b]) held.push_back(edge.pair);
  }
  if (criterion != CycleCriterion::Off) noteGroups(state, scratch, group);
  std::swap(state.ready_before, scratch.ready);
  return held;
}

/// Welds one pair, unless what they are fixed to moves differently.
bool weld(State& state, const BodyPair& pair) {
  const RigidId ra = state[pair.a].rigid, rb = state[pair.b].rigid;
  const Rigid &a = state[ra], &b = state[rb];
  if (ra == rb) return false;
  if (!a.floating() && !b.floating() && a.anchor != b.anchor) return false;
  const bool a_frame = !a.floating() && !state.isCollection(ra);
  const bool b_frame = !b.floating() && !state.isCollection(rb);
  if (a_frame) {
    anchorRigid(state, rb, pair.a);
  } else if (b_frame) {
    anchorRigid(state, ra, pair.b);
  } else {
    mergeRigids(state, ra, rb);
  }
  return true;
}

/// The full solve has become smaller: its memory goes back.
void releaseRows(State& state, Scratch& scratch) {
  trim(state.broadphase.near);
  scratch.blocks.clear();
  scratch.row_sources.clear();
  scratch.block_order.clear();
  scratch.sweep_contacts.clear();
  scratch.candidates.clear();
  scratch.near_candidates.clear();
  scratch.nncg.before.clear();
  scratch.nncg.direction.clear();
  trim(scratch.blocks, scratch.row_sources, scratch.block_order, scratch.sweep_contacts,
       scratch.candidates, scratch.near_candidates, scratch.nncg.before, scratch.nncg.direction,
       scratch.pairs, scratch.ready, scratch.u, scratch.sweep_before);
}

}  // namespace

double relativeMotion(const State& state, const BodyPair& pair, Notes* notes) {
  const Rigid &a = state.rigid(pair.a), &b = state.rigid(pair.b);
  double fastest = 0.0;
  for (const Rigid* r : {&a, &b}) {
    if (!r->floating()) continue;
    const OrientedBox box = worldBox(*r);
    fastest = std::max(fastest, fastestCorner(box, fieldOf(a), fieldOf(b)));
    noteCorners(notes, pair, box, a, b);
  }
  return fastest;
}

void accumulateRelativeMotion(State& state, Scratch& scratch) {
  if (merges(state.mode)) countQuietPairs(state, scratch);
  if (merges(state.mode) && !state.joints.empty()) countQuietJoints(state, scratch);
  if (sleeps(state.mode)) countQuietRigids(state, scratch.notes);
}

void merge(State& state, Scratch& scratch) {
  if (!merges(state.mode)) return;
  const auto pairs = pairsToWeld(state, scratch);
  if (pairs.empty()) return;
  for (const BodyPair& pair : pairs) {
    if (!weld(state, pair)) continue;
    const RigidId id =
        state.isCollection(state[pair.a].rigid) ? state[pair.a].rigid : state[pair.b].rigid;
    scratch.events.push_back(
        {EventType::Merge, pair.a, pair.b, state.collection(id).id, EventReason::None});
  }
  absorbContacts(state);
  layOutCollections(state);
  compactContacts(state);
  collectPairs(state, scratch);
  releaseRows(state, scratch);
}

}  // namespace merge2d
