/// Numbers that are not finite end the run, where they arise.

#include "src2d/dynamics/finite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src2d/core/error.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// What a run of some steps ends with, or nothing.
std::string endOf(World& world, int steps) {
  try {
    runSteps(world, steps);
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

/// A box on the ground that a force without end takes hold of after `time` [s].
Scene pulled(double time) {
  Scene scene = onGround();
  add(scene, named("box", box(1, 1, {0, 0.5})));
  add(scene, named("lid", box(1, 1, {0, 1.5})));
  scene.forces.push_back(
      {.body = 2, .force = {std::numeric_limits<double>::infinity(), 0}, .from = time});
  return scene;
}

TEST(Finite, WhatTheFullSolveSpoilsIsNoticedThere) {
  World world = reference(pulled(0.5));
  EXPECT_THAT(endOf(world, 100), AllOf(HasSubstr("'"), HasSubstr("SolveLCP"), HasSubstr("step 5")));
}

TEST(Finite, WhatTheSweepSpoilsIsNoticedThere) {
  World world(pulled(2.0), inMode(Mode::Merge));
  EXPECT_THAT(endOf(world, 300), AllOf(HasSubstr("SingleIterationPGS"), HasSubstr("step 20")));
}

TEST(Finite, ABodyThatLeavesTheFiniteNumbersEndsTheRunAndIsNamed) {
  Scene scene = onGround();
  add(scene, named("kite", box(1, 1, {0, 5})));
  scene.forces.push_back(
      {.body = 1, .force = {std::numeric_limits<double>::infinity(), 0}, .from = 0.045});
  World world = reference(scene);
  runSteps(world, 4);
  try {
    runSteps(world, 2);
    FAIL() << "the run went on";
  } catch (const SimulationError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("'kite'"), HasSubstr("AdvanceVelocities"), HasSubstr("step 5")));
  }
}

TEST(Finite, ASpringWhoseForceOverflowsEndsTheRunAndIsNamed) {
  Scene scene = noGravity();
  add(scene, box(1, 1, {-5, 0}));
  add(scene, named("bob", box(1, 1, {0, 0})));
  scene.springs.push_back({.body = 1, .to = {100, 0}, .to_body = {}, .stiffness = 1e308});
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    World world(scene, inMode(mode));
    try {
      runSteps(world, 3);
      FAIL() << "the run went on in mode " << name(mode);
    } catch (const SimulationError& error) {
      EXPECT_THAT(error.what(),
                  AllOf(HasSubstr("'bob'"), HasSubstr("Advance"), HasSubstr("step 1")));
    }
  }
}

}  // namespace
}  // namespace merge2d
