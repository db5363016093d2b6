/// Hits without restitution are followed in small islands, and are solved with all others in large
/// ones.

#include "src2d/contact/followed_hits.h"

#include <gtest/gtest.h>

#include "tests/support/modes_and_steps.h"

namespace merge2d {
namespace {

/// A box flies obliquely onto a plank that bears `load` others, so that it slides by a hand's
/// breadth along the plank within the step in which they meet.
World onto(int load, double spin, double h, Mode mode) {
  Scene scene = noGravity();
  scene.step = h;
  BodyDesc hitter = named("hitter", moving(box(1, 1, {-3.0, -1.9}), {20, 10}));
  hitter.spin = spin;
  add(scene, hitter);
  add(scene, named("plank", box(30, 0.5, {0, 0})));
  for (int i = 0; i < load; ++i) add(scene, box(1, 1, {1.0 * i - 10.0, 0.75}));
  return World(scene, inMode(mode));
}

/// The normal of a hit turns with the bodies; a body that turns by nothing to speak of has another
/// normal than one that does not turn, and yet is to be hit alike.
TEST(FollowedHits, AHairOfSpinChangesNothing) {
  for (const int load : {0, 5, 20}) {
    for (const double h : kStepSizes) {
      for (const Mode mode : kAllModes) {
        SCOPED_TRACE(load);
        World straight = onto(load, 0.0, h, mode), turning = onto(load, 1e-7, h, mode);
        for (int i = 0; i < 30; ++i) {
          straight.step();
          turning.step();
          for (const char* name : {"hitter", "plank"}) {
            const BodyState a = see(straight, name), b = see(turning, name);
            ASSERT_NEAR((a.x - b.x).norm(), 0.0, 1e-4) << name << " in step " << i;
            ASSERT_NEAR((a.v - b.v).norm(), 0.0, 1e-3) << name << " in step " << i;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace merge2d
