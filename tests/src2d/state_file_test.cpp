/// A run that continues from saved bytes is the run that never stopped, bit for bit.

#include "src2d/state_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "src2d/core/error.h"
#include "tests/support/fingerprint.h"
#include "tests/support/scenes.h"

namespace merge2d {
namespace {

using testing::HasSubstr;

/// Something of everything: compounds, joints, magnets, emitters, springs, scripts and launches.
const std::string kMixed = R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [40, 1]
[[body]]
name = "brick"
at = [0.3, 0.5]
box = [1, 1]
repeat = { count = [3, 4], spacing = [1.01, 1.0], stagger = 0.5 }
[[body]]
name = "ball"
at = [-9, 2]
circle = 0.4
velocity = [9, 1]
pinned_until = 0.7
[[body]]
name = "tee"
at = [-4, 0.7]
shapes = [{ box = [0.2, 1] }, { box = [1, 0.2], at = [0, 0.6] }]
[[body]]
name = "arm"
at = [-6, 2.7]
box = [0.2, 1]
[[body]]
name = "lift"
motion = "scripted"
at = [8, 2]
box = [2, 0.2]
script = { axis = [0, 1], amplitude = 0.5, period = 2 }
[[body]]
name = "load"
at = [8, 1.4]
box = [0.8, 1]
[[spring]]
body = "tee"
anchor = [0, 0.6]
to = [-4, 3]
stiffness = 20
damping = 1
[[joint]]
kind = "revolute"
bodies = ["arm"]
at = [-6, 3.2]
motor = { speed = 90, torque = 5 }
[[joint]]
kind = "weld"
bodies = ["brick[0,3]", "brick[1,3]"]
at = [2.4, 3.5]
break_force = 300
[[magnet]]
body = "lift"
on = [[0, 1.2]]
[[impulse]]
body = "brick[1,3]"
at = [2, 3.5]
impulse = [5, 0]
time = 1.0
[[emitter]]
name = "rain"
at = [4, 5]
spread = [1, 0]
shapes = [{ circle = 0.2 }, { box = [0.6, 0.1] }]
every = 0.3
count = 6
)";

World start(const Scene& scene, Mode mode) {
  return World(scene, {.mode = mode, .timings = false});
}

/// The fingerprints of `steps` steps.
std::vector<Fingerprint> follow(World& world, int steps) {
  std::vector<Fingerprint> seen;
  for (int i = 0; i < steps; ++i) {
    world.step();
    seen.emplace_back(world.capture());
  }
  return seen;
}

/// Stops after `at` steps, continues in a new world, and compares every bit for `more` steps.
void expectTheSame(const Scene& scene, Mode mode, int at, int more) {
  World whole = start(scene, mode);
  follow(whole, at);
  const std::string bytes = whole.save();
  World resumed = start(scene, mode);
  resumed.restore(bytes, "test");
  EXPECT_EQ(resumed.steps(), at);
  EXPECT_EQ(resumed.save(), bytes);
  EXPECT_TRUE(follow(whole, more) == follow(resumed, more))
      << scene.name << ", " << name(mode) << " from step " << at;
  EXPECT_EQ(resumed.save(), whole.save());
}

TEST(StateFile, AResumedRunIsTheRunThatNeverStoppedWhereWeldsAreDecided) {
  const Scene scene = parseScene(kMixed, "mixed.toml");
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    for (const int at : {40, 100, 150}) expectTheSame(scene, mode, at, 100);
  }
}

TEST(StateFile, AResumedRunIsTheRunThatNeverStopped) {
  const Scene scene = parseScene(kMixed, "mixed.toml");
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    for (const int at : {0, 1, 40, 99, 100, 150}) expectTheSame(scene, mode, at, 100);
  }
}

TEST(StateFile, SoItIsWithTheBuiltinScenes) {
  for (const char* name : {"dominoes", "spinner", "books"}) {
    expectTheSame(loadScene(name), Mode::MergeSleep, 120, 60);
  }
}

/// A wall that counts as large, hit below its top: bricks leave it, and some come back.
TEST(StateFile, AWallThatLosesBricksIsTakenOverInAnyStep) {
  Scene scene = wall(12, 12);
  scene.settings.solver.iterations = 30;
  BodyDesc shot = box(1, 1, {-30.6, 10.5 + 0.5 * kGravity * 4});
  shot.velocity = {12, 0};
  add(scene, shot);
  World world = start(scene, Mode::Merge);
  int left = 0;
  for (int step = 1; step <= 260; ++step) {
    world.step();
    for (const Event& event : world.events()) left += event.type == EventType::Unmerge ? 1 : 0;
    if (step < 190) continue;
    const std::string bytes = world.save();
    World resumed = start(scene, Mode::Merge);
    ASSERT_NO_THROW(resumed.restore(bytes, "test")) << step;
    ASSERT_TRUE(resumed.save() == bytes) << step;
  }
  EXPECT_GT(left, 20);
}

/// One that counts as large swings, and boxes fall on it, also while impulses are sought inside.
TEST(StateFile, AWallOnWhichBoxesFallGoesOnTheSameFromAnyStep) {
  Scene scene = wallOnSwingingPlatform(8, 10, 0.08, 5.0);
  scene.settings.solver.iterations = 100;
  for (int i = 0; i < 24; ++i) {
    BodyDesc drop = box(0.3, 0.2, {-3.0 + 1.3 * (i % 5) + 0.01 * i, 9.5});
    drop.pinned_until = 0.35 * i;
    add(scene, drop);
  }
  World world = start(scene, Mode::Merge);
  World resumed = start(scene, Mode::Merge);
  for (int step = 1; step <= 800; ++step) {
    const std::string bytes = world.save();
    world.step();
    if (step % 2 == 0) resumed = start(scene, Mode::Merge);
    resumed.restore(bytes, "test");
    resumed.step();
    ASSERT_TRUE(resumed.save() == world.save()) << step;
  }
}

/// The ends of the ground, as seen from a pair that turns, move faster than anything else.
TEST(StateFile, APairThatTurnsAboveALongGroundGoesOnTheSameFromAnyStep) {
  const Scene scene = parseScene(R"(
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [4000, 1]
[[body]]
name = "a"
at = [0, 0.55]
box = [1, 1]
spin = 2
[[body]]
name = "b"
at = [1, 0.55]
box = [1, 1]
[[joint]]
kind = "weld"
bodies = ["a", "b"]
at = [0.5, 0.55]
)",
                                 "pair.toml");
  World world = start(scene, Mode::Merge);
  World resumed = start(scene, Mode::Merge);
  for (int step = 1; step <= 60; ++step) {
    const std::string bytes = world.save();
    world.step();
    resumed.restore(bytes, "test");
    resumed.step();
    ASSERT_TRUE(resumed.save() == world.save()) << step;
  }
  EXPECT_FALSE(world.capture().collections.empty());
}

/// A pair that is listed twice was refused as damage.
TEST(StateFile, TwoBodiesMayHaveTwoJoints) {
  const Scene scene = parseScene(R"(
format = 1
[[body]]
name = "a"
at = [0, 0]
box = [1, 1]
[[body]]
name = "b"
at = [2, 0]
box = [1, 1]
[[joint]]
kind = "distance"
bodies = ["a", "b"]
at = [0, 0.4]
to = [2, 0.4]
[[joint]]
kind = "distance"
bodies = ["a", "b"]
at = [0, -0.4]
to = [2, -0.4]
break_force = 1
)",
                                 "test");
  World world(scene, {});
  runSteps(world, 3);
  World other(scene, {});
  other.restore(world.save(), "memory");
  for (World* w : {&world, &other}) w->removeJoint(0);
  runSteps(world, 3);
  runSteps(other, 3);
  EXPECT_TRUE(world.save() == other.save());
}

TEST(StateFile, GoingBackLeavesNothingOfTheStepsAfter) {
  const Scene scene = parseScene(kMixed, "mixed.toml");
  World world = start(scene, Mode::MergeSleep);
  follow(world, 100);
  const std::string bytes = world.save();
  const auto once = follow(world, 100);
  std::vector<std::size_t> memory;
  for (int time = 0; time < 20; ++time) {
    world.restore(bytes, "test");
    EXPECT_TRUE(follow(world, 100) == once) << "time " << time;
    memory.push_back(world.memoryBytes());
  }
  EXPECT_EQ(memory.back(), memory[3]) << "as much as after some times";
}

/// The message of the error that restoring gives.
std::string refusal(const std::string& bytes, const Scene& scene, Mode mode = Mode::MergeSleep) {
  World world = start(scene, mode);
  try {
    world.restore(bytes, "saved.state");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

class StateFileErrors : public testing::Test {
 protected:
  Scene scene_ = parseScene(kMixed, "mixed.toml");
  std::string bytes_ = [this] {
    World world = start(scene_, Mode::MergeSleep);
    follow(world, 20);
    return world.save();
  }();
};

TEST_F(StateFileErrors, WhatIsNoSnapshotIsRefused) {
  EXPECT_EQ(refusal("format = 1", scene_), "saved.state: this is no snapshot of merge2d");
  EXPECT_EQ(refusal("", scene_), "saved.state: this is no snapshot of merge2d");
}

TEST_F(StateFileErrors, WhatIsCutOffIsRefused) {
  for (const std::size_t size : {std::size_t{13}, bytes_.size() / 2, bytes_.size() - 1}) {
    EXPECT_THAT(refusal(bytes_.substr(0, size), scene_), HasSubstr("the snapshot is incomplete"));
  }
}

TEST_F(StateFileErrors, AnyFlippedBitIsFound) {
  for (std::size_t at = 13; at < bytes_.size(); at += bytes_.size() / 50) {
    std::string damaged = bytes_;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    EXPECT_THAT(refusal(damaged, scene_), HasSubstr("damaged")) << at;
  }
}

/// The bytes with the checksum that belongs to them (FNV-1a, 64 bits).
std::string sealed(std::string bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const std::size_t size = bytes.size() - sizeof hash;
  for (std::size_t i = 0; i < size; ++i) {
    hash = (hash ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3u;
  }
  std::memcpy(bytes.data() + size, &hash, sizeof hash);
  return bytes;
}

/// The same with one byte at `place` changed.
std::string forged(std::string bytes, std::size_t place, int change = 4) {
  bytes[place] = static_cast<char>(bytes[place] ^ change);
  return sealed(std::move(bytes));
}

TEST_F(StateFileErrors, WhatHasOtherFieldsIsOfAnotherVersion) {
  const std::size_t version = kStateStart.size(), fields = version + sizeof(std::uint32_t);
  for (const std::size_t place : {version, fields, fields + 7}) {
    EXPECT_EQ(refusal(forged(bytes_, place), scene_),
              "saved.state: the snapshot was written by another version of merge2d; run the scene "
              "again")
        << place;
  }
}

TEST_F(StateFileErrors, AnotherSceneIsRefused) {
  Scene other = scene_;
  other.settings.solver.iterations = 20;
  EXPECT_EQ(refusal(bytes_, other),
            "saved.state: the snapshot is of another scene than 'mixed', or of other parameters");
  other = scene_;
  other.duration = 100.0;
  EXPECT_EQ(refusal(bytes_, other), "no error") << "how long it goes on does not matter";
}

TEST_F(StateFileErrors, AnotherModeIsRefused) {
  EXPECT_EQ(refusal(bytes_, scene_, Mode::Reference),
            "saved.state: the snapshot was made with --mode merge+sleep, not reference");
}

/// Bytes made so on purpose give an error or a strange run, but never an access to memory that is
/// not a world's.
TEST_F(StateFileErrors, NoForgedFieldIsFollowedOutOfTheTables) {
  std::mt19937_64 random(5);
  int refused = 0, taken = 0;
  for (std::size_t at = kStateStart.size(); at < bytes_.size() - 8; at += 1 + random() % 40) {
    World world = start(scene_, Mode::MergeSleep);
    try {
      world.restore(forged(bytes_, at, 1 + static_cast<int>(random() % 255)), "saved.state");
      ++taken;
      for (int i = 0; i < 4; ++i) world.step();
      world.capture();
    } catch (const InputError&) {
      ++refused;
    } catch (const SimulationError&) {
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(taken, 100);
}

TEST_F(StateFileErrors, AListThatClaimsToBeLongIsRefusedBeforeThereIsMemoryForIt) {
  const std::uint64_t many = 1u << 30;
  std::string bytes = bytes_;
  const std::size_t added = kStateStart.size() + 4 + 8 + 8 + 8 + sizeof(Mode);  // behind the header
  std::memcpy(bytes.data() + added, &many, sizeof many);
  EXPECT_EQ(refusal(sealed(bytes), scene_),
            "saved.state: the snapshot is damaged: it ends within a list");
}

TEST_F(StateFileErrors, AfterARefusalTheWorldStandsAtItsStart) {
  World world = start(scene_, Mode::MergeSleep);
  follow(world, 7);
  EXPECT_THROW(world.restore(forged(bytes_, bytes_.size() - 9, 255), "saved.state"), InputError);
  World fresh = start(scene_, Mode::MergeSleep);
  EXPECT_EQ(world.save(), fresh.save());
}

TEST_F(StateFileErrors, BodiesThatWereAddedAreCheckedAsThoseOfAScene) {
  World world = start(scene_, Mode::MergeSleep);
  world.addBody(named("extra", box(1, 1, {20, 20})));
  std::string bytes = world.save();
  const double half = -0.5, flat = 0.5;  // the first corner's x moves to that of the second
  const std::string corner(reinterpret_cast<const char*>(&half), sizeof half);
  const std::size_t at = bytes.find(corner);
  ASSERT_NE(at, std::string::npos);
  std::memcpy(bytes.data() + at, &flat, sizeof flat);
  EXPECT_NE(refusal(sealed(bytes), scene_), "no error");
}

}  // namespace
}  // namespace merge2d
