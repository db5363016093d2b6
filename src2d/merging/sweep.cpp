#include "src2d/merging/sweep.h"

#include "src2d/collections/joint_sweep.h"
#include "src2d/merging/rule.h"

namespace merge2d {
namespace {

/// Keeps the impulses between two anchored collections, where the full solve has no row: only the
/// sweep knows them.
void keepFixedContacts(State& state, const Scratch& scratch) {
  for (const SweepContact& outer : scratch.sweep_contacts) {
    const ContactBlock& k = outer.block;
    if (state.rigid(BodyId{k.a}).floating() || state.rigid(BodyId{k.b}).floating()) continue;
    Contact& contact = state.contacts.slots[outer.slot];
    for (int i = 0; i < k.count; ++i) {
      ContactPoint& point = contact.points[static_cast<std::size_t>(i)];
      point.lambda_n = k.lambda_n(i);
      point.lambda_t = k.lambda_t(i);
      const ContactVelocity w =
          contactVelocity(k, i, k.nx, k.ny, scratch.sweep_u[k.a], scratch.sweep_u[k.b]);
      point.w_n = static_cast<float>(w.n);
      point.w_t = static_cast<float>(w.t);
    }
    if (k.rolls()) contact.points[1].lambda_t = k.lambda_r();
  }
}

}  // namespace

void sweepCollections(State& state, Scratch& scratch) {
  if (scratch.sweeping) unmergingMethod(state).sweep(state, scratch);
}

void sweepAround(State& state, Scratch& scratch, void (*inside)(State& state, Scratch& scratch)) {
  inside(state, scratch);
  keepFixedContacts(state, scratch);
  if (!state.joints.empty()) keepJointForces(state, scratch);
}

}  // namespace merge2d
