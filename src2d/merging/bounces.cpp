#include "src2d/merging/bounces.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "src2d/collections/collection.h"
#include "src2d/collections/cuts.h"
#include "src2d/core/index_runs.h"
#include "src2d/dynamics/hit_rows.h"
#include "src2d/merging/rule.h"

namespace merge2d {
namespace {

/// No hit of two bodies of which one is as fast as this is followed (dynamics/hits.h) [m/s]: no
/// bounce, nor a later hit in its chain that is too slow to bounce.
Criterion bouncesNot(const State& state, BodyId a, BodyId b, double speed) {
  const double bounce = restitutionOf(state, a, b) > 0.0 ? speed : 0.0;
  const double most = state.settings.unmerging.velocity;
  return {"bounce", kOwnHits, bounce, most, bounce <= most};
}

/// The speed that a body at rest gets from one that hits it, by Newton's law, as in a row of balls
/// [m/s].
double passedOn(const State& state, BodyId from, BodyId to, double speed) {
  if (!state.responds(to) || bouncesNot(state, from, to, speed).holds) return 0.0;
  const ContactKey key{from, to, state[from].first_shape, state[to].first_shape};
  const double e = speed > leastBounce(state, key) ? restitutionOf(state, from, to) : 0.0;
  return (1.0 + e) * speed * state[from].mass / (state[from].mass + state[to].mass);
}

/// The speed that a body gets from one that a joint holds to it [m/s].
double passedByJoint(const State& state, BodyId from, BodyId to, double speed) {
  if (!state.responds(to) || speed <= state.settings.unmerging.velocity) return 0.0;
  return speed * state[from].mass / (state[from].mass + state[to].mass);
}

/// Passes speeds on from body to body until none gets more.
class BounceSpread {
 public:
  /// Of speeds per body, which it changes.
  BounceSpread(const State& state, const Scratch& scratch, std::vector<double>& arrives)
      : state_(state), arrives_(arrives) {
    for (const BodyPair& pair : scratch.pairs) touching_.emplace_back(pair.a, pair.b);
    for (const Collection& c : state.collections) {
      for (const Weld& weld : c.welds) touching_.emplace_back(weld.a, weld.b);
    }
    first_joint_ = touching_.size();
    for (const std::uint32_t i : state.joint_lists.present) {
      const Joint& joint = state.joints[i];
      if (!joint.to_world && holds(state, joint)) touching_.emplace_back(joint.a, joint.b);
    }
    touching_of_.build(state.bodies.size(), [&](auto&& visit) {
      for (std::uint32_t i = 0; i < touching_.size(); ++i) {
        visit(index(touching_[i].first), i);
        visit(index(touching_[i].second), i);
      }
    });
  }

  void spread() {
    for (std::uint32_t i = 0; i < arrives_.size(); ++i) {
      if (arrives_[i] > 0.0) queue_.push_back(BodyId{i});
    }
    for (std::size_t next = 0; next < queue_.size(); ++next) passFrom(queue_[next]);
  }

 private:
  void passFrom(BodyId from) {
    constexpr double kMore = 1.0 + 1e-9;  // or equal balls would pass on rounding errors for ever
    for (const std::uint32_t i : touching_of_[index(from)]) {
      const auto [a, b] = touching_[i];
      const BodyId to = a == from ? b : a;
      const double speed =
          (i < first_joint_ ? passedOn : passedByJoint)(state_, from, to, arrives_[index(from)]);
      if (speed <= kMore * arrives_[index(to)]) continue;
      arrives_[index(to)] = speed;
      queue_.push_back(to);
    }
  }

  const State& state_;
  std::vector<double>& arrives_;
  std::vector<std::pair<BodyId, BodyId>> touching_;  ///< then those that joints hold
  std::size_t first_joint_ = 0;
  IndexRuns touching_of_;      ///< per body
  std::vector<BodyId> queue_;  ///< bodies at which more has arrived
};

/// No bounce arrives at the bodies of a weld: bodies that bounce are followed hit by hit, each on
/// its own (dynamics/hits.h).
Criterion noBounceArrives(const State& state, const Weld& weld,
                          const std::vector<double>& arrives) {
  return bouncesNot(state, weld.a, weld.b,
                    std::max(arrives[index(weld.a)], arrives[index(weld.b)]));
}

/// Cuts the welds of a collection at which bounces arrive.
bool cutBouncing(const State& state, const Scratch& scratch, Collection& c,
                 const std::vector<double>& arrives) {
  bool any = false;
  for (Weld& weld : c.welds) {
    if (weld.joints > 0) continue;
    const Criterion stays = noBounceArrives(state, weld, arrives);
    if (stays.holds) continue;
    weld.cut = any = true;
    weld.reason = EventReason::RelativeMotion;
    if (!scratch.notes) continue;
    scratch.notes->decisions.push_back(
        record(stays, "Unmerge", weld.a, weld.b, "unmerge", {.count = 1}));
  }
  return any;
}

/// The speed that an impulse gives the fastest corner of a body on its own [m/s].
double speedBy(const State& state, const Kick& kick) {
  const Body& body = state[kick.body];
  const Vec2 center = state.pose(kick.body).position;
  const double turn = std::abs(cross(kick.at - center, kick.impulse)) / body.inertia;
  return kick.impulse.norm() / body.mass + turn * state.extent(rigidOf(kick.body)).box.half.norm();
}

/// Whether something bounces off one of the bodies at which a speed arrives.
bool anyBounces(const State& state, const Scratch& scratch, const std::vector<double>& arrives) {
  if (arrives.empty()) return false;
  const auto bounces = [&](const auto& pair) {
    const bool arrived = arrives[index(pair.a)] > 0.0 || arrives[index(pair.b)] > 0.0;
    return arrived && restitutionOf(state, pair.a, pair.b) > 0.0;
  };
  return std::ranges::any_of(scratch.pairs, bounces) ||
         std::ranges::any_of(state.collections, [&](const Collection& c) {
           return std::ranges::any_of(c.welds, bounces);
         });
}

}  // namespace

std::vector<double> arrivingSpeeds(const State& state, const Scratch& scratch) {
  std::vector<double> arrives;
  if (state.collections.empty()) return arrives;
  const auto arrive = [&](BodyId b, double speed) {
    if (!state.responds(b)) return;
    if (arrives.empty()) arrives.assign(state.bodies.size(), 0.0);
    arrives[index(b)] = std::max(arrives[index(b)], speed);
  };
  for (const Meeting& meeting : scratch.meetings) {
    const BodyPair& pair = scratch.pairs[meeting.pair];
    arrive(pair.a, meeting.speed);
    arrive(pair.b, meeting.speed);
  }
  for (const Kick& kick : scratch.kicks) arrive(kick.body, speedBy(state, kick));
  if (!anyBounces(state, scratch, arrives)) return {};
  BounceSpread(state, scratch, arrives).spread();
  return arrives;
}

bool bounceAtWelds(const State& state, const std::vector<double>& arrives) {
  if (arrives.empty()) return false;
  return std::ranges::any_of(state.collections, [&](const Collection& c) {
    return std::ranges::any_of(c.welds, [&](const Weld& weld) {
      return weld.joints == 0 && !noBounceArrives(state, weld, arrives).holds;
    });
  });
}

void releaseBouncing(State& state, Scratch& scratch, const std::vector<double>& arrives) {
  if (arrives.empty()) return;
  layOutCollections(state);  // the parts of one that was split in this step follow from its layout
  const std::vector<std::uint32_t> slots = state.collections.active();  // splits make more
  for (const std::uint32_t slot : slots) {
    Collection& c = state.collections[slot];
    Noted noted(scratch.notes);
    if (!cutBouncing(state, scratch, c, arrives)) continue;
    noted.close();
    splitAtCuts(state, scratch, c.rigid, collectionMethod(state).parts(state, c));
    restate(state, noted, "cut");
  }
}

}  // namespace merge2d
