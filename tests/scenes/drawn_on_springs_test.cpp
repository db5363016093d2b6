/// Drawn scenes that hang on springs, or turn on a pivot.

#include "tests/scenes/drawn_scenes.h"

namespace merge2d {
namespace {

/// A hull on three springs; the load comes down on it after two seconds.
TEST(Drawn, ABoatOnSpringsTakesItsLoad) {
  const Scene scene = drawn("boat", rowsOf(R"(
............eeeeeeeeee..................
............eeeeeeeeee..................
........................................
..............###.......####............
..............###.......####............
........................................
..............###.......####............
......##......###.......####......##....
......##..........................##....
......##############################....
.......####r###################r####....
........############################....
.........##########r##############......
..........#######################.......
)"));
  ASSERT_EQ(scene.springs.size(), 3U);
  expectNoBlowUp(scene);
  expectMergesWhatRests(scene);
  SceneRun merged(scene, Mode::Merge), reference(scene, Mode::Reference);
  for (SceneRun* run : {&merged, &reference}) run->steps(200);
  EXPECT_EQ(merged.now().stats.active_bodies, 1) << "hull and crates swing as one";
  for (SceneRun* run : {&merged, &reference}) run->steps(1800);
  EXPECT_EQ(merged.now().stats.active_bodies, 1) << "with the load too";
  for (std::size_t i = 0; i < merged.now().bodies.size(); ++i) {
    EXPECT_LT((merged.now().bodies[i].x - reference.now().bodies[i].x).norm(), 0.1) << i;
  }
}

/// Where all bodies are in the frame of another one.
std::map<std::string, Vec2> placesIn(const SceneRun& run, const std::string& frame) {
  std::map<std::string, Vec2> places;
  for (const BodyState& body : run.now().bodies) {
    places[run.nameOf(body.id)] = run.seenFrom(frame, run.nameOf(body.id));
  }
  return places;
}

/// A box of four compartments on a pivot, with a loose thing in each. Without gravity it goes on
/// turning, and each thing comes to rest at an outer wall.
TEST(Drawn, ASpinnerMergesWithWhatIsInIt) {
  Scene scene = drawn("spinner", rowsOf(R"(
#########################
#...........#...........#
#...........#...........#
#....####...#....##.....#
#....####...#...####....#
#....####...#...####....#
#....####...#....##.....#
#...........#...........#
#...........#...........#
#...........#...........#
#...........#...........#
#...........#...........#
############r############
#...........#...........#
#...........#...........#
#...........#...........#
#...........#...........#
#...........#...........#
#...........#...........#
#.....##....#....####...#
#....####...#....####...#
#....####...#....####...#
#.....##....#....####...#
#...........#...........#
#########################
)"));
  scene.gravity.setZero();
  scene.bodies[scene.springs.front().body].spin = 1.0;
  const std::string tray = scene.bodies[scene.springs.front().body].name;
  expectNoBlowUp(scene);
  const std::map<std::string, Vec2> reference = placesIn(runDrawn(scene, Mode::Reference), tray);
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    SCOPED_TRACE(name(mode));
    SceneRun run(scene, mode);
    const std::map<std::string, Vec2> start = placesIn(run, tray);
    ASSERT_EQ(start.size(), 5u);
    while (run.world().steps() < kDrawnSteps) {
      run.steps(100);
      for (const auto& [who, place] : placesIn(run, tray)) {
        if (who == tray) continue;
        EXPECT_LT(place.cwiseAbs().maxCoeff(), 1.1) << who << " is in the box";
        EXPECT_GT(place.cwiseProduct(start.at(who)).minCoeff(), 0.0)
            << who << " has changed places";
      }
    }
    for (const auto& [who, place] : placesIn(run, tray)) {
      EXPECT_LT((place - reference.at(who)).norm(), 0.1) << who;
      if (who == tray) continue;
      EXPECT_GT(place.cwiseAbs().maxCoeff(), 0.9) << who << " is at an outer wall";
    }
    EXPECT_NEAR(run.body(tray).omega, 0.75, 0.01) << "it has set all in motion";
    EXPECT_EQ(run.now().stats.asleep, 0);
    EXPECT_EQ(run.now().stats.active_bodies, merges(mode) ? 1 : 5);
    EXPECT_EQ(run.eventsAfter(800), 0);
  }
}

/// A hull that hangs on springs, with containers between its walls; one more falls on them.
TEST(Drawn, ACargoShipKeepsItsCargo) {
  const Scene scene = drawn("ship", rowsOf(R"(
.........................eeee.....................
.........................eeee.....................
..................................................
..................................................
............####.####.####.####.####..............
............####.####.####.####.####...#####......
.......................................#...#......
............####.####.####.####.####...#...#......
#...........####.####.####.####.####...#####....##
##.....................................#...#...###
###.........####.####.####.####.####...#...#..####
####........####.####.####.####.####...##########.
##################################################
.################################################.
..####r###################r##################r##..
...#############################################..
....###########################################...
......######################r################.....
)"));
  ASSERT_EQ(scene.springs.size(), 4u);
  expectNoBlowUp(scene);
  expectMergesWhatRests(scene);
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    SCOPED_TRACE(name(mode));
    SceneRun run(scene, mode);
    const std::string hull = scene.bodies[scene.springs.front().body].name;
    const std::map<std::string, Vec2> start = placesIn(run, hull);
    ASSERT_EQ(start.size(), 12u);
    while (run.world().steps() < kDrawnSteps) {
      run.steps(100);
      for (const auto& [who, place] : placesIn(run, hull)) {
        const Vec2 way = place - start.at(who);
        EXPECT_LT(std::abs(way.x()), 0.1) << who << " stays in its stack";
        EXPECT_GT(way.y(), -0.5) << who << " comes down by the gaps below it, and no farther";
      }
      if (!merges(mode)) continue;
      EXPECT_LE(run.now().stats.active_bodies, 1) << "at " << run.world().time() << " s";
    }
    EXPECT_LT(std::abs(run.body(hull).angle), 0.02) << "it is on an even keel";
    EXPECT_EQ(run.now().stats.asleep, sleeps(mode) ? 12 : 0);
    EXPECT_EQ(run.now().collections.size(), merges(mode) ? 1u : 0u);
    EXPECT_EQ(run.eventsAfter(300), 0);
  }
}

/// The heavier side is a crate more: it goes down as it does in the reference.
TEST(Drawn, ASeeSawTipsToItsHeavierSide) {
  const Scene scene = drawn("seesaw", rowsOf(R"(
....##..................................
....##..................................
........................................
....##.............................##...
....##.............................##...
........................................
..####################################..
........................................
...................bb...................
..................bbbb..................
.................bbbbbb.................
bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb
)"));
  expectNoBlowUp(scene);
  expectMergesWhatRests(scene);
  SceneRun merged(scene, Mode::MergeSleep), reference(scene, Mode::Reference);
  for (SceneRun* run : {&merged, &reference}) run->steps(kDrawnSteps);
  for (const BodyState& body : reference.now().bodies) {
    if (!reference.dynamic(body.id)) continue;
    const std::string& who = reference.nameOf(body.id);
    EXPECT_GT(body.angle, 0.1) << who << " tips to the left";
    EXPECT_NEAR(merged.body(who).angle, body.angle, 0.01) << who;
    EXPECT_TRUE(merged.body(who).asleep) << who;
  }
}

}  // namespace
}  // namespace merge2d
