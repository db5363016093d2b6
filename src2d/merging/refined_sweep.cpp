#include "src2d/merging/refined_sweep.h"

#include <algorithm>

#include "src2d/core/memory.h"
#include "src2d/merging/disturbance.h"
#include "src2d/merging/joint_sweep.h"
#include "src2d/merging/joint_system.h"
#include "src2d/merging/momentum.h"
#include "src2d/merging/ordering.h"
#include "src2d/merging/refine.h"
#include "src2d/merging/sleep.h"
#include "src2d/merging/slow_sweep.h"
#include "src2d/merging/sweep.h"

namespace merge2d {
namespace {

/// Contacts outside collections, and joints, of a disturbed step: those at disturbed collections,
/// and the fresh ones between free bodies.
std::vector<SweepItem> looseItems(State& state, Scratch& scratch) {
  std::vector<SweepItem> items;
  items.reserve(scratch.sweep_contacts.size() + scratch.sweep_joints.size());
  const auto concerned = [&](std::uint32_t b) {
    if (b >= state.bodies.size()) return true;  // the world
    const RigidId id = state.bodies[b].rigid;
    return !state.isCollection(id) || scratch.disturbed[index(id) - state.bodies.size()];
  };
  for (SweepContact& outer : scratch.sweep_contacts) {
    const ContactBlock& k = outer.block;
    if (concerned(k.a) && concerned(k.b)) items.emplace_back(outer.block);
  }
  for (JointBlock& k : scratch.sweep_joints) {
    if (concerned(k.a) && concerned(k.b)) items.emplace_back(k);
  }
  for (std::size_t slot = 0; slot < state.collections.size(); ++slot) {
    Collection& c = state.collections[slot];
    if (!scratch.disturbed[slot]) continue;
    for (JointBlock& k : c.joints) items.emplace_back(k, state[c.rigid].rotation);
  }
  return items;
}

/// All that a disturbed step may sweep.
std::vector<SweepItem> disturbedItems(State& state, Scratch& scratch) {
  std::vector<SweepItem> items = looseItems(state, scratch);
  for (std::size_t slot = 0; slot < state.collections.size(); ++slot) {
    Collection& c = state.collections[slot];
    if (!scratch.disturbed[slot]) continue;
    for (ContactBlock& k : c.blocks) items.emplace_back(k, state[c.rigid].rotation);
  }
  return items;
}

/// Notes the whole order of a disturbed step. Deviation: the walk does not pass bodies that do not
/// respond to forces, or a floor would pass everything on to everything at once. Guarded by
/// Sweep.TheWalkDoesNotPassTheFloor.
void noteOrder(State& state, Scratch& scratch) {
  if (!scratch.notes) return;
  std::vector<std::uint8_t> passable(scratch.sweep_u.size());
  for (std::size_t i = 0; i < passable.size(); ++i) {
    passable[i] = scratch.sweep_u[i].inv_mass > 0.0;
  }
  orderedFromSeeds(disturbedItems(state, scratch), scratch, passable);
}

/// The change of a velocity below which sweeps end that began with one of `blow`: a hundredth of it
/// [m/s].
double enoughAfter(const State& state, double blow) {
  constexpr double kPart = 0.01;
  return std::max(residualVelocity(state), std::min(kPart * blow, refinedVelocity(state)));
}

/// Marks the members that the last sweep changed too much, where `largest` is its largest change
/// [m/s]. While the collection waits long, only those that it jolted: no others can come free.
void markRestless(State& state, const Collection& c, Scratch& scratch, double largest) {
  const bool waits = c.waitsLong() && !isJolted(state, c);
  const double enough = waits ? joltVelocity(state) : enoughAfter(state, largest);
  if (largest <= enough) return;
  for (std::size_t i = 0; i < c.members.size(); ++i) {
    const auto b = static_cast<std::uint32_t>(c.members[i]);
    scratch.restless_bodies[b] = scratch.u[i].vx > enough * enough ? 1 : 0;
    noteJolt(state, b, scratch.u[i].vx);
  }
}

/// Whether more sweeps follow where something is new.
bool refines(const UnmergingSettings& settings) { return settings.ordering; }

/// Whether a collection is disturbed: something new entered, the sweep changed much, or a
/// disturbance of the last steps still changes something. That lasts for some steps only: a load
/// that changes for ever, as on a swing, is followed well by single sweeps. Nor is a collection
/// disturbed by a change that more sweeps have just failed to remove; this is forgotten little by
/// little.
void follow(const State& state, Collection& c, Scratch& scratch, double change) {
  constexpr float kForgets = 0.95F;  // in each step
  std::uint8_t& disturbed = scratch.disturbed[index(c.rigid) - state.bodies.size()];
  const double lingering = c.lingering *= kForgets;
  const bool anew = disturbed != 0 || change > std::max(refinedVelocity(state), lingering);
  if (anew) {
    c.follow_up = kFollowed;
  } else if (c.follow_up > 0) {
    --c.follow_up;
  }
  const bool followed = c.follow_up > 0 && change > std::max(residualVelocity(state), lingering);
  disturbed = anew || followed ? 1 : 0;
}

/// Deviation: where sweeps have come to change nothing for long, and the impulses of the last step
/// hold the members together under the loads of this one too, three sweeps in four are left out;
/// the paper wishes for less than one a step as well (Section 8.2). A collection that is soon
/// struck again needs its forces right. Guarded by Sweep.RestsWhereTheLastImpulsesStillHold.
bool rests(const State& state, const Scratch& scratch, Collection& c) {
  constexpr std::int8_t kCalm = 60, kMost = 3;  // steps before the first rest, and then in a row
  constexpr double kNothing = 1e-6;             // of residualVelocity()
  constexpr double kInVain = 0.01;              // of the residual: a sweep hardly makes it less
  const bool disturbed = scratch.disturbed[index(c.rigid) - state.bodies.size()] != 0;
  const bool calm = c.settled && !disturbed && c.follow_up == 0;
  c.calm = !calm ? 0 : c.calm < kCalm + kMost ? c.calm + 1 : kCalm;
  if (c.calm <= kCalm) return false;
  const double left = sway(state, scratch, c), most = residualVelocity(state);
  return left <= kNothing * most || (left <= most && c.residual <= kInVain * left);
}

/// Sweeps one collection once; a few times more one that could sleep but for its inner forces, so
/// that it soon can, and one on which a load has set in: a collection that cannot bear it, however
/// faint it is, is not to wait, nor to fall asleep. Returns the largest change [m/s].
double sweepOnce(State& state, Collection& c, Scratch& scratch) {
  constexpr double kSettled = 0.02;  // of residualVelocity()
  const UnmergingSettings& settings = state.settings.unmerging;
  if (refines(settings) && rests(state, scratch, c)) {
    follow(state, c, scratch, 0.0);
    return 0.0;
  }
  const bool stirred = refines(settings) && c.stirred > 0;
  if (stirred || awaitsInnerForces(state, scratch, c.rigid)) {
    sweepInside(state, c, scratch, settings.disturbed_sweeps);
  }
  double change = sweepInside(state, c, scratch, settings.sweeps);
  if (refines(settings) && hastenSweeps(state, c, scratch)) {
    change = sweepInside(state, c, scratch, settings.sweeps);
    scratch.push_stale[index(c.rigid) - state.bodies.size()] = 1;
  }
  markRestless(state, c, scratch, change);
  c.residual = static_cast<float>(change);
  c.settled = !stirred && change <= kSettled * residualVelocity(state);
  if (refines(settings)) follow(state, c, scratch, change);
  return change;
}

/// Gives back the memory that a refinement of many contacts needed, and the full solve does not.
void releaseBuffers(Scratch& scratch) {
  NncgBuffers& m = scratch.nncg;
  if (m.before.size() <= 2 * scratch.blocks.size()) return;
  m.before.clear();
  m.direction.clear();
  m.u_direction.clear();
  trim(m.before, m.direction, m.u_direction);
}

bool anyDisturbed(const Scratch& scratch) {
  return std::any_of(scratch.disturbed.begin(), scratch.disturbed.end(),
                     [](std::uint8_t d) { return d != 0; });
}

/// As many sweeps as the full solve may take: where something new enters, and before anything
/// parts. The steps after a blow need fewer, as each goes on from the last.
int fullEffort(const State& state) {
  return std::max(state.settings.unmerging.disturbed_sweeps, state.settings.solver.iterations);
}

/// Refines breadth first from the seeds, and from bodies that the sweep changed: by `blow` at most.
void refineDisturbed(State& state, Scratch& scratch, double blow) {
  constexpr float kOwn = 3.0F;  // times its own change: a larger residual is another's
  if (!anyDisturbed(scratch)) return releaseBuffers(scratch);
  spreadDisturbance(state, scratch);
  noteOrder(state, scratch);
  const double enough = enoughAfter(state, blow);
  const int effort =
      scratch.seeds.empty() ? state.settings.unmerging.disturbed_sweeps : fullEffort(state);
  const SweepScope scope{looseItems(state, scratch), scratch.disturbed, effort};
  const double change = sweepUntilQuiet(state, scratch, scope, scratch.seeds, enough);
  for (std::size_t slot = 0; slot < state.collections.size(); ++slot) {
    Collection& c = state.collections[slot];
    if (!scratch.disturbed[slot]) continue;
    settleJoints(c, state[c.rigid].rotation, scratch.sweep_u, residualVelocity(state));
    scratch.push_stale[slot] = 1;
    c.settled = false;
    const float left = static_cast<float>(change);
    c.lingering = change <= enough ? 0.0F : std::min(left, kOwn * c.residual);
    c.residual = left;
    if (change <= enough) c.follow_up = 0;
  }
}

}  // namespace

void sweepRefined(State& state, Scratch& scratch) {
  for (JointBlock& k : scratch.sweep_joints) {
    solveJoint(k, {}, scratch.sweep_u[k.a], scratch.sweep_u[k.b]);
  }
  for (SweepContact& outer : scratch.sweep_contacts) {
    sweepBlock(outer.block, Rotation{}, scratch.sweep_u, state.settings.solver.method);
  }
  double blow = 0.0;
  for (Collection& c : state.collections) {
    if (!isSwept(state, c)) continue;
    blow = std::max(blow, sweepOnce(state, c, scratch));
  }
  if (refines(state.settings.unmerging)) refineDisturbed(state, scratch, blow);
}

void sweepAgain(State& state, Scratch& scratch, Collection& c) {
  SweepScope scope;
  for (SweepContact& outer : scratch.sweep_contacts) {
    const ContactBlock& k = outer.block;
    const bool at = state.bodies[k.a].rigid == c.rigid || state.bodies[k.b].rigid == c.rigid;
    if (at) scope.loose.emplace_back(outer.block);
  }
  for (JointBlock& k : scratch.sweep_joints) scope.loose.emplace_back(k);
  for (JointBlock& k : c.joints) scope.loose.emplace_back(k, state[c.rigid].rotation);
  std::vector<std::uint8_t> only(state.collections.size(), 0);
  only[index(c.rigid) - state.bodies.size()] = 1;
  scope.inside = only;
  scope.most = fullEffort(state);
  const double change =
      sweepUntilQuiet(state, scratch, scope, scratch.doubted, residualVelocity(state));
  c.residual = static_cast<float>(change);
  settleJoints(c, state[c.rigid].rotation, scratch.sweep_u, residualVelocity(state));
  if (!state.joints.empty()) keepJointForces(state, scratch);
  scratch.push_stale[index(c.rigid) - state.bodies.size()] = 1;
}

}  // namespace merge2d
