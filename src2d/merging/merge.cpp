#include "src2d/merging/merge.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "src2d/contact/broadphase.h"
#include "src2d/contact/detection.h"
#include "src2d/core/memory.h"
#include "src2d/merging/collection.h"
#include "src2d/merging/cycles.h"
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

/// Eq. (15); the box of what is fixed to the world or to a script is not looked at.
double relativeMotion(const Rigid& a, const Rigid& b) {
  double fastest = 0.0;
  if (a.floating()) fastest = fastestCorner(worldBox(a), fieldOf(a), fieldOf(b));
  if (b.floating()) fastest = std::max(fastest, fastestCorner(worldBox(b), fieldOf(a), fieldOf(b)));
  return fastest;
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
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    const Contact& contact = state.contacts[state.contacts.order[i]];
    for (int k = 0; k < contact.count; ++k) {
      const ContactPoint& p = contact.points[static_cast<std::size_t>(k)];
      if (p.lambda_n <= 0.0) continue;
      ++seen.active;
      seen.fastest_slip = std::max<double>(seen.fastest_slip, std::abs(p.w_t));
      seen.largest_breath = std::max<double>(seen.largest_breath, std::abs(p.breath));
      seen.on_edge += std::abs(p.lambda_t) >= kOnEdge * contact.mu * p.lambda_n;
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
  PairTest(const State& state, Scratch& scratch, const BodyPair& pair)
      : state_(state), scratch_(scratch), pair_(pair) {}

  bool ready(int count) {
    const MergingSettings& m = state_.settings.merging;
    const PairContacts seen = lookAt(state_, pair_);
    count_ = count;
    bool ok = seen.active > 0;
    if (!ok) return false;
    if (m.rule == Rule::Default) {
      const bool slides = seen.on_edge == seen.active && aboutToSlide(state_, pair_);
      ok &= holds("edge", "(20)", slides ? 1.0 : 0.0, 0.5);
    }
    if (!ok && !scratch_.decisions) return false;
    ok &= holds("sliding", "(18)", seen.fastest_slip, m.sliding);
    ok &= holds("breathing", "Section 5.3", seen.largest_breath, m.breathing);
    if (!ok && !scratch_.decisions) return false;
    const double motion = relativeMotion(state_.rigid(pair_.a), state_.rigid(pair_.b));
    return holds("relative-motion", "(17)", motion, m.velocity) && ok;
  }

 private:
  bool holds(const char* criterion, const char* equation, double value, double threshold) {
    const bool ok = value < threshold;
    if (scratch_.decisions) {
      scratch_.decisions->push_back({pair_.a, pair_.b, "AccumulateRelativeMotion", criterion,
                                     equation, value, threshold, ok ? count_ + 1 : 0,
                                     state_.settings.merging.steps, ok ? "below" : "apart"});
    }
    return ok;
  }

  const State& state_;
  Scratch& scratch_;
  const BodyPair& pair_;
  int count_ = 0;
};

void countQuietPairs(State& state, Scratch& scratch) {
  for (const BodyPair& pair : scratch.pairs) {
    const Rigid &a = state.rigid(pair.a), &b = state.rigid(pair.b);
    if (a.asleep || b.asleep || !(a.floating() || b.floating() || a.anchor == b.anchor)) continue;
    Contact& first = state.contacts[state.contacts.order[pair.first]];
    const int count = first.quiet_steps;
    const int now = PairTest(state, scratch, pair).ready(count) ? count + 1 : 0;
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      state.contacts[state.contacts.order[i]].quiet_steps = now;
    }
  }
}

/// Section 7: each rigid thing against the inertial frame.
void countQuietRigids(State& state) {
  const VelocityField still;
  for (Rigid& r : state.rigids) {
    if (!r.present() || r.asleep) continue;
    const double motion = fastestCorner(worldBox(r), fieldOf(r), still);
    r.quiet_steps = motion < state.settings.sleeping.velocity ? r.quiet_steps + 1 : 0;
  }
}

int activePoints(const State& state, const BodyPair& pair) { return lookAt(state, pair).active; }

/// Rigid things as nodes; everything fixed to one frame is one node.
class MergeGraph {
 public:
  explicit MergeGraph(const State& state) : state_(state) {}

  std::uint32_t node(BodyId b) const {
    const Rigid& r = state_.rigid(b);
    const auto rigids = static_cast<std::uint32_t>(state_.rigids.size());
    return r.floating() ? static_cast<std::uint32_t>(state_[b].rigid)
                        : rigids + static_cast<std::uint32_t>(r.anchor);
  }
  std::uint32_t nodes() const {
    return static_cast<std::uint32_t>(state_.rigids.size() + state_.bodies.size() + 1);
  }

 private:
  const State& state_;
};

/// The pairs to weld: ready, and rigid in the group that they would form.
std::vector<BodyPair> pairsToWeld(const State& state, const Scratch& scratch) {
  const MergingSettings& m = state.settings.merging;
  const MergeGraph graph(state);
  std::vector<BodyPair> ready;
  std::vector<ContactEdge> edges;
  for (const BodyPair& pair : scratch.pairs) {
    const Contact& first = state.contacts[state.contacts.order[pair.first]];
    if (first.quiet_steps < m.steps) continue;
    ready.push_back(pair);
    edges.push_back({graph.node(pair.a), graph.node(pair.b), activePoints(state, pair)});
  }
  if (ready.empty()) return ready;
  const auto group =
      rigidGroups(graph.nodes(), edges, m.rule == Rule::Paper ? CycleCriterion::Off : m.cycles);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < ready.size(); ++i) {
    if (group[edges[i].a] == group[edges[i].b]) ready[kept++] = ready[i];
  }
  ready.resize(kept);
  return ready;
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
void releaseRows(Scratch& scratch) {
  scratch.blocks.clear();
  scratch.row_sources.clear();
  trim(scratch.blocks);
  trim(scratch.row_sources);
  for (auto* v : {&scratch.nncg.before, &scratch.nncg.direction}) {
    v->clear();
    v->shrink_to_fit();
  }
}

}  // namespace

void accumulateRelativeMotion(State& state, Scratch& scratch) {
  if (merges(state.mode)) countQuietPairs(state, scratch);
  if (sleeps(state.mode)) countQuietRigids(state);
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
  releaseRows(scratch);
}

}  // namespace merge2d
