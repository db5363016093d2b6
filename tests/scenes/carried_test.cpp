/// Scenes of things that ride on what moves.

#include <numbers>
#include <optional>
#include <set>

#include "tests/scenes/scene_testing.h"

namespace merge2d {
namespace {

/// How the car moves against the ferry, from two seconds on; from ten it is looked at once in each
/// wave, which takes eight.
struct Excursion {
  double end = 0.0, farthest = 0.0;  ///< from where it was at first [m]
  double by_waves = 0.0;             ///< after a whole number of waves, at most [m]
};

Excursion drift(double seconds, SceneRun& run) {
  run.until(2.0);
  const Vec2 start = run.seenFrom("ferry", "car");
  Vec2 wave = start;
  Excursion out;
  for (int t = 3; t <= seconds; ++t) {
    run.until(t);
    const Vec2 now = run.seenFrom("ferry", "car");
    out.end = (now - start).norm();
    out.farthest = std::max(out.farthest, out.end);
    if (t == 10) wave = now;
    if (t % 8 == 2) out.by_waves = std::max(out.by_waves, (now - wave).norm());
  }
  return out;
}

TEST(Ferry, TheMergedCarStaysWhereItIs) {
  SceneRun run("ferry");
  EXPECT_LT(drift(30.0, run).farthest, 1e-9);
  EXPECT_TRUE(run.anchored("car"));
  EXPECT_EQ(run.count(EventType::Merge), 1);
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
}

TEST(Ferry, InTenMinutesTheMergedCarStaysAndTheReferenceMovesWithEachWave) {
  SceneRun run("ferry"), reference("ferry", Mode::Reference);
  const Excursion merged = drift(600.0, run), free = drift(600.0, reference);
  EXPECT_LT(merged.farthest, 1e-12);
  EXPECT_NEAR(free.end, 1.8e-6, 0.2e-6);
  EXPECT_NEAR(free.farthest, 2.4e-6, 0.2e-6);
  EXPECT_LT(free.by_waves, 1e-9) << "to and fro: it does not add up";
  EXPECT_EQ(run.eventsAfter(200), 0);
}

TEST(Ferry, TheMergedCarKeepsTheOverlapThatTheReferenceStillResolves) {
  SceneRun run("ferry"), reference("ferry", Mode::Reference);
  const auto apart = [&](double time) {
    run.until(time), reference.until(time);
    return (run.seenFrom("ferry", "car") - reference.seenFrom("ferry", "car")).norm();
  };
  EXPECT_LT(apart(0.18), 1e-12) << "up to the merge";
  EXPECT_GT(apart(1.0), 1.2e-4);
  EXPECT_NEAR(apart(2.0), apart(60.0), 1e-5);
  EXPECT_GT(run.now().stats.max_penetration, reference.now().stats.max_penetration + 1e-4);
}

TEST(Books, SlideAsOneBody) {
  SceneRun run("books");
  run.until(0.9);
  const char* others[] = {"dictionary", "mechanics", "geometry", "novel",   "sequel",
                          "poems",      "cookbook",  "diary",    "notebook"};
  run.until(3.0);
  EXPECT_GT(run.body("atlas").v.x(), 0.2);
  for (const char* book : others) EXPECT_TRUE(run.together("atlas", book)) << book;
  EXPECT_FALSE(run.anchored("atlas"));
  EXPECT_EQ(run.now().stats.active_bodies, 1);
  run.until(8.0);
  EXPECT_EQ(run.now().stats.asleep, 10);
}

TEST(Swing, EverythingMergesWithTheSeatAndStaysThere) {
  SceneRun run("swing");
  run.until(1.0);
  const char* things[] = {"box-1", "box-2", "box-3", "plate", "pyramid", "top", "block"};
  std::vector<Vec2> places;
  for (const char* thing : things) {
    EXPECT_TRUE(run.together("seat", thing)) << thing;
    places.push_back(run.seenFrom("seat", thing));
  }
  EXPECT_EQ(run.now().stats.active_bodies, 1);
  EXPECT_EQ(run.now().stats.contacts, 0);
  double left = 0.0, right = 0.0;
  for (double t = 2.0; t <= 30.0; t += 0.25) {
    run.until(t);
    left = std::min(left, run.body("seat").angle);
    right = std::max(right, run.body("seat").angle);
  }
  EXPECT_GT(right, 0.5);
  EXPECT_LT(left, -0.5);
  EXPECT_EQ(run.eventsAfter(100), 0) << "nothing happens any more";
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_LT((run.seenFrom("seat", things[i]) - places[i]).norm(), 1e-9) << things[i];
  }
}

/// The eight stacks of the station, from their floors.
const std::vector<std::vector<std::string>> kStacks = {
    {"tank-1", "tank-2", "tank-3"},
    {"crate-1", "crate-2", "crate-3", "crate-4"},
    {"rack-1", "rack-2", "rack-3", "rack-4"},
    {"battery-1", "battery-2", "battery-3", "battery-4", "battery-5"},
    {"locker-1", "locker-2"},
    {"sofa", "cushion-1", "cushion-2"},
    {"bed", "mattress", "trunk"},
    {"plinth", "column", "plate", "globe-box"}};

void expectStationAtRest(SceneRun& run) {
  for (const auto& stack : kStacks) {
    EXPECT_TRUE(run.anchored(stack.front())) << stack.front();
    for (const std::string& name : stack) EXPECT_TRUE(run.together(stack.front(), name)) << name;
  }
  EXPECT_EQ(run.now().stats.contacts, 0);
  EXPECT_EQ(run.now().stats.asleep, 0) << "it turns";
}

TEST(SpaceStation, EachStackMergesWithTheTurningFloor) {
  SceneRun run("space-station");
  run.until(2.0);
  expectStationAtRest(run);
  EXPECT_NEAR(run.body("tank-3").v.norm(), 1.0472 * run.body("tank-3").x.norm(), 1e-3);
  run.until(8.0);
  EXPECT_EQ(run.eventsAfter(800), 0);
}

class LongSpaceStation : public testing::TestWithParam<Mode> {};

TEST_P(LongSpaceStation, NothingHappensInAHundredThousandSteps) {
  SceneRun run("space-station", GetParam());
  run.until(2.0);
  const Vec2 place = run.seenFrom("station", "globe-box");
  const std::size_t memory = run.world().memoryBytes();
  run.steps(100'000 - run.world().steps());
  expectStationAtRest(run);
  EXPECT_EQ(run.eventsAfter(800), 0);
  EXPECT_LT((run.seenFrom("station", "globe-box") - place).norm(), 1e-9);
  EXPECT_LE(run.world().memoryBytes(), memory);
}
INSTANTIATE_TEST_SUITE_P(Long, LongSpaceStation, testing::Values(Mode::Merge, Mode::MergeSleep));

/// The tilt [degrees] at which the block has slid by a millimetre, for which it needs a third of a
/// second; 36 when it never does.
double slidingAngle(Mode mode, const Overrides& overrides = {}) {
  SceneRun run("slope", mode, overrides);
  run.until(5.0);
  EXPECT_EQ(run.anchored("block"), merges(mode));
  const double start = run.seenFrom("slope", "block").x();
  while (run.world().time() < 36.0) {
    run.steps(1);
    if (std::abs(run.seenFrom("slope", "block").x() - start) > 0.001) break;
  }
  return run.body("slope").angle * 180.0 / std::numbers::pi;
}

/// From θ₀ = atan μ = 30.964° on it accelerates with g ω t / cos θ₀.
TEST(Slope, TheMergedBlockSlidesWhereFrictionGivesWay) {
  const double degree = std::numbers::pi / 180.0, angle = std::atan(0.6);
  const double exact =
      angle / degree + std::cbrt(6.0 * 0.001 * std::cos(angle) / (9.81 * degree));  // 31.275°
  const double reference = slidingAngle(Mode::Reference);
  EXPECT_NEAR(reference, exact, 0.05);
  for (const Mode mode : {Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    EXPECT_NEAR(slidingAngle(mode), reference, 0.05) << name(mode);
    EXPECT_NEAR(slidingAngle(mode), exact, 0.05) << name(mode);
  }
}

TEST(Slope, UnderThePapersRuleTheBlockSticksForDegreesMore) {
  const Overrides paper = {{"merging.rule", "paper"}, {"unmerging.rule", "paper"}};
  EXPECT_GT(slidingAngle(Mode::Merge, paper), slidingAngle(Mode::Reference) + 3.0);
}

TEST(Spinner, MergesAtOrdinarySpeedAndNotAtHighSpeed) {
  const char* things[] = {"square-1", "square-2", "disc-1", "disc-2"};
  const auto merged = [&](const Overrides& overrides) {
    SceneRun run("spinner", Mode::MergeSleep, overrides);
    run.until(10.0);
    return std::ranges::count_if(things, [&](const char* name) { return run.anchored(name); });
  };
  EXPECT_EQ(merged({}), 4);
  EXPECT_EQ(merged({{"body.tray.script.spin", "120"}}), 0);
  EXPECT_EQ(merged({{"body.tray.script.spin", "120"}, {"step", "0.001"}}), 4);
  for (const char* spin : {"120", "180", "240"}) {
    EXPECT_EQ(merged({{"body.tray.script.spin", spin}}), 0) << spin;
    EXPECT_EQ(merged({{"body.tray.script.spin", spin}, {"solver.stabilisation", "post"}}), 4)
        << spin;
  }
}

TEST(Wagon, ToysAndBooksAreMergedUntilTheBlow) {
  SceneRun run("wagon");
  for (double t = 0.5; t < 3.06; t += 0.05) {
    run.until(t);
    for (const BodyState& body : run.now().bodies) {
      const std::string& name = run.nameOf(body.id);
      if (name.starts_with("block[")) {
        EXPECT_TRUE(run.together("wagon", name)) << name << " at " << t;
      } else if (name.starts_with("book[")) {
        EXPECT_TRUE(run.together("bookcase", name)) << name << " at " << t;
        EXPECT_TRUE(run.anchored(name)) << name << " at " << t;
      }
    }
  }
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
  run.until(3.25);
  EXPECT_FALSE(run.merged("book[2,4]"));
  EXPECT_FALSE(run.together("wagon", "block[0,4]"));
}

TEST(Wagon, HitsTheBookcaseAndAllMergesWithTheMovingTruck) {
  SceneRun run("wagon");
  run.until(2.5);
  for (int column = 0; column < 8; ++column) {
    EXPECT_TRUE(run.together("wagon", cell("block", column, 4))) << "toys ride: " << column;
  }
  EXPECT_FALSE(run.merged("rear-wheel")) << "it rolls";
  EXPECT_TRUE(run.anchored("bookcase"));
  EXPECT_TRUE(run.anchored("book[2,4]"));
  EXPECT_EQ(run.count(EventType::Unmerge), 0);
  EXPECT_EQ(run.now().stats.active_bodies, 4);
  run.until(3.3);
  EXPECT_NEAR(static_cast<double>(run.first(EventType::Unmerge, "bookcase")), 300, 20);
  EXPECT_GT(run.count(EventType::Unmerge), 17) << "the blow frees what it moves";
  int books = 0, toys = 0;
  for (const auto& event : run.log()) {
    if (event.type != EventType::Unmerge) continue;
    books += event.a.starts_with("book[") || event.b.starts_with("book[");
    toys += event.a.starts_with("block[") || event.b.starts_with("block[");
  }
  EXPECT_GT(books, 0);
  EXPECT_GT(toys, 0);
  run.until(10.0);
  EXPECT_EQ(run.now().stats.active_bodies, 1);
  EXPECT_EQ(run.now().stats.asleep, 0) << "the truck drives on";
  for (const char* name : {"wagon", "rear-wheel", "bookcase", "book[0,0]", "block[0,0]"}) {
    EXPECT_TRUE(run.anchored(name)) << name;
    EXPECT_NEAR(run.body(name).v.x(), 1.0, 1e-6) << name;
  }
}

TEST(ShipCrane, EachGrabFreesTheContainerThatIsLifted) {
  SceneRun run("ship-crane");
  run.until(4.0);
  for (int column = 0; column < 9; ++column) {
    for (int row = 0; row < 8; ++row) {
      EXPECT_TRUE(run.together("ship", cell("cargo", column, row))) << column << ", " << row;
    }
  }
  EXPECT_TRUE(run.anchored("freight[5,6]")) << "merged with the moving train";
  EXPECT_EQ(run.now().stats.contacts, 0);
  const char* lifted[] = {"cargo[8,7]", "cargo[7,7]", "cargo[6,7]", "cargo[5,7]"};
  for (int n = 0; n < 4; ++n) {
    const double start = 7.0 + 20.5 * n;
    run.until(start + 3.5);
    EXPECT_GT(run.body(lifted[n]).x.y(), 12.0) << lifted[n] << " hangs on the magnet";
    EXPECT_FALSE(run.together("ship", lifted[n])) << lifted[n];
    int left = 0;
    for (int column = 0; column < 9; ++column) {
      for (int row = 0; row < 8; ++row) left += run.together("ship", cell("cargo", column, row));
    }
    EXPECT_EQ(left, 72 - (n + 1)) << "everything else is merged with the ship, or again";
    run.until(start + 15.0);
    EXPECT_TRUE(run.anchored(lifted[n]) || run.body(lifted[n]).asleep) << "set down: " << lifted[n];
    EXPECT_NEAR(run.body(lifted[n]).x.y(), 8.8, 0.02) << "on the stack";
  }
}

TEST(ShipCrane, EachGrabFreesItsColumnAlone) {
  SceneRun run("ship-crane");
  run.until(88.0);
  for (int n = 0; n < 4; ++n) {
    const double grab = 7.0 + 20.5 * n;  // within this second the magnet comes down
    const std::string column = "cargo[" + std::to_string(8 - n) + ",";
    std::set<std::string> parted;
    for (const SceneRun::Logged& e : run.log()) {
      const double time = 0.01 * static_cast<double>(e.step);
      if (e.type != EventType::Unmerge || time < grab - 1.0 || time > grab + 3.0) continue;
      parted.insert(e.b);
      if (n == 0) continue;  // the first jerk makes others slip on the deck, too
      EXPECT_TRUE(e.a == "ship" || e.a.starts_with(column)) << e.a << " at " << time;
      EXPECT_TRUE(e.b.starts_with(column)) << e.b << " at " << time;
    }
    EXPECT_TRUE(parted.contains(cell("cargo", 8 - n, 7)));
    EXPECT_LE(parted.size(), n == 0 ? 7u : 2u) << "it and the lowest of its column";
  }
  EXPECT_LE(run.count(EventType::Unmerge), 17) << "and four times the magnet lets go";
}

/// Neither the grab nor the neighbours on the quay make a container tip.
void expectUprightAndInPlace(SceneRun& run) {
  double overlap = 0.0, tilt = 0.0;
  while (run.world().time() < 88.0 - 1e-9) {
    run.steps(1);
    overlap = std::max(overlap, run.now().stats.max_penetration);
    for (int n = 0; n < 4; ++n) {
      tilt = std::max(tilt, std::abs(run.body(cell("cargo", 8 - n, 7)).angle));
    }
  }
  EXPECT_LT(overlap, 0.01);
  EXPECT_LT(tilt, 0.01);
  for (int n = 0; n < 4; ++n) {
    const Vec2 place = run.body(cell("cargo", 8 - n, 7)).x;
    EXPECT_NEAR(place.x(), 4.3 + 2.7 * n, 0.045) << n;
    EXPECT_NEAR(place.y(), 8.8, 0.01) << n;
  }
}

class ShipCraneIn : public testing::TestWithParam<Mode> {};

TEST_P(ShipCraneIn, EachContainerStaysUprightAndIsPutDownInItsPlace) {
  SceneRun run("ship-crane", GetParam());
  expectUprightAndInPlace(run);
}
INSTANTIATE_TEST_SUITE_P(EachMode, ShipCraneIn,
                         testing::Values(Mode::Reference, Mode::Sleep, Mode::Merge,
                                         Mode::MergeSleep));

/// Hard contacts leave the ship's tilt to a container that is grabbed: the magnet touches one of
/// its corners 7 mm before the other.
TEST(LongShipCrane, EachContainerStaysUprightAndIsPutDownInItsPlaceWithHardContacts) {
  SceneRun run("ship-crane", Mode::Reference,
               {{"solver.iterations", "200"}, {"solver.compliance", "2e-6"}});
  expectUprightAndInPlace(run);
}

}  // namespace
}  // namespace merge2d
