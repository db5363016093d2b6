#include "src2d/time_step.h"

#include <algorithm>
#include <utility>

#include "src2d/collections/collection.h"
#include "src2d/edit.h"
#include "src2d/proofs/proof_impulses.h"

namespace merge2d {
namespace {

void scaleImpulses(State& state, double ratio) {
  for (Contact& contact : state.contacts.slots) {
    for (ContactPoint& point : contact.points) {
      point.lambda_n *= ratio;
      point.lambda_t *= ratio;  // of a second point that is none, the impulse against rolling
    }
  }
  for (Joint& joint : state.joints) {
    for (double& lambda : joint.lambda) lambda *= ratio;
  }
}

/// Hands the impulses of all rows over to contacts and joints, and has the rows made anew.
void dropRows(State& state, Collection& c, double ratio) {
  writeImpulses(c);
  for (const JointBlock& k : c.joints) state.joints[k.joint].lambda = k.lambda;
  for (InternalContact& inner : c.contacts) {
    dropBlock(c, inner);
    for (InternalPoint& point : inner.points) {
      point.lambda_n *= ratio;
      point.lambda_t *= ratio;
    }
  }
  c.stale = true;
  c.certificate.clear();
}

}  // namespace

double timeOf(const State& state) {
  return state.paced_time + static_cast<double>(state.step - state.paced_step) * state.h;
}

void setTimeStep(Setup& setup, double h) {
  State& state = setup.state;
  if (h == state.h) return;
  const double ratio = h / std::exchange(state.h, h);
  state.paced_step = state.step;
  state.paced_time = state.time;
  setup.actions.timetable = {};  // the last step would have begun earlier or later
  for (Collection& c : state.collections) {
    if (c.id == kNoCollection) continue;
    dropRows(state, c, ratio);
    c.hits.endRun();  // it counts steps
  }
  scaleImpulses(state, ratio);
  layOutCollections(state);
  constexpr double kMost = 1e9;  // steps
  for (Rigid& r : state.rigids) {
    r.slow_steps = static_cast<int>(std::min(kMost, r.slow_steps / ratio));
    r.quiet_steps = static_cast<int>(std::min(kMost, r.quiet_steps / ratio));
  }
  wakeAll(setup);
}

}  // namespace merge2d
