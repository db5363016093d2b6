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

BodyDesc weightless(BodyDesc body) {
  body.mass = 1e-12;
  return body;
}

/// Takes hold of a body that weighs nothing with a force at the end of the numbers.
void pull(World& world, std::uint32_t body) {
  world.applyForce(BodyId{body}, Vec2::Zero(), {1e300, 0});
}

/// A box on the ground, and a lid to pull at.
Scene lidded() {
  Scene scene = onGround();
  add(scene, named("box", box(1, 1, {0, 0.5})));
  add(scene, named("lid", weightless(box(1, 1, {0, 1.5}))));
  return scene;
}

TEST(Finite, WhatTheFullSolveSpoilsIsNoticedThere) {
  World world = reference(lidded());
  runSteps(world, 50);
  pull(world, 2);
  EXPECT_THAT(endOf(world, 1), AllOf(HasSubstr("'"), HasSubstr("SolveLCP"), HasSubstr("step 51")));
}

TEST(Finite, WhatTheSweepSpoilsIsNoticedThere) {
  World world(lidded(), inMode(Mode::Merge));
  runSteps(world, 200);
  pull(world, 2);
  EXPECT_THAT(endOf(world, 1), AllOf(HasSubstr("SingleIterationPGS"), HasSubstr("step 201")));
}

TEST(Finite, ABodyThatLeavesTheFiniteNumbersEndsTheRunAndIsNamed) {
  Scene scene = onGround();
  add(scene, named("kite", weightless(box(1, 1, {0, 5}))));
  World world = reference(scene);
  runSteps(world, 4);
  pull(world, 1);
  EXPECT_THAT(endOf(world, 1),
              AllOf(HasSubstr("'kite'"), HasSubstr("AdvanceVelocities"), HasSubstr("step 5")));
}

/// No scene that is accepted has a spring whose force is too much for the numbers.
TEST(Finite, TheStiffestSpringOnTheLightestBodyStaysFinite) {
  Scene scene = noGravity();
  add(scene, box(1, 1, {-5, 0}));
  add(scene, named("bob", weightless(box(1, 1, {0, 0}))));
  scene.springs.push_back({.body = 1, .to = {100, 0}, .to_body = {}, .stiffness = 1e12});
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    World world(scene, inMode(mode));
    EXPECT_EQ(endOf(world, 100), "") << name(mode);
  }
}

}  // namespace
}  // namespace merge2d
