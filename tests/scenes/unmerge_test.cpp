#include <fmt/format.h>

#include "tests/scenes/scene_testing.h"

namespace merge2d {
namespace {

TEST(UnmergeBroken, OneBodyIsFreedAndOneCollectionParts) {
  SceneRun run("unmerge-broken", Mode::Merge);
  run.until(0.99);
  EXPECT_TRUE(run.together("left[0,0]", "left[0,2]"));
  EXPECT_TRUE(run.together("right[0,0]", "right[0,3]"));
  run.until(1.3);
  EXPECT_FALSE(run.merged("left[0,2]"));
  EXPECT_TRUE(run.together("left[0,0]", "left[0,1]"));
  EXPECT_TRUE(run.together("right[0,2]", "right[0,3]"));
  EXPECT_TRUE(run.together("right[0,0]", "right[0,1]"));
  EXPECT_FALSE(run.together("right[0,1]", "right[0,2]"));
  EXPECT_EQ(run.count(EventType::Unmerge), 2);
  for (const auto& event : run.log()) {
    if (event.type != EventType::Unmerge) continue;
    EXPECT_EQ(event.reason, EventReason::Broken);
  }
  run.until(5.0);
  EXPECT_TRUE(run.together("left[0,0]", "left[0,2]")) << "merged again";
  EXPECT_TRUE(run.together("right[0,0]", "right[0,3]"));
}

TEST(UnmergeBroken, TheWeldsBreakAtOnce) {
  SceneRun run("unmerge-broken", Mode::Merge);
  run.until(1.5);
  EXPECT_LE(run.first(EventType::Unmerge, "left[0,2]"), 102);
  EXPECT_LE(run.first(EventType::Unmerge, "right[0,2]"), 102);
}

TEST(UnmergePivot, TheBoxTurnsAboutOneContact) {
  SceneRun run("unmerge-pivot", Mode::Merge);
  run.until(0.9);
  EXPECT_TRUE(run.together("cart", "box"));
  run.until(2.5);
  const std::int64_t step = run.first(EventType::Unmerge, "box");
  EXPECT_GT(step, 100);
  EXPECT_LT(step, 125) << "soon after the push began";
  EXPECT_TRUE(run.together("cart", "ballast"));
  run.until(5.0);
  EXPECT_LT(run.body("box").angle, -1.0) << "it fell";
}

/// The full solve tells in the step of the push that the box turns about a contact; the paper's
/// rule sees the other one break.
TEST(UnmergePivot, IsFoundByItsMotionInTheStepOfThePush) {
  const auto parted = [](const Overrides& overrides) {
    SceneRun run("unmerge-pivot", Mode::Merge, overrides);
    run.until(2.5);
    for (const SceneRun::Logged& e : run.log()) {
      if (e.type == EventType::Unmerge) return std::pair(e.step, e.reason);
    }
    return std::pair(std::int64_t{-1}, EventReason::None);
  };
  using enum EventReason;
  EXPECT_EQ(parted({}), std::pair(std::int64_t{101}, RelativeMotion));
  EXPECT_EQ(parted({{"merging.cycles", "off"}}), std::pair(std::int64_t{101}, RelativeMotion));
  EXPECT_EQ(parted({{"merging.rule", "paper"}, {"unmerging.rule", "paper"}}),
            std::pair(std::int64_t{114}, Broken));
}

TEST(UnmergePivot, TurnsAsInTheReference) {
  SceneRun run("unmerge-pivot", Mode::Merge), reference("unmerge-pivot", Mode::Reference);
  run.until(2.2), reference.until(2.2);
  EXPECT_NEAR(run.body("box").angle, reference.body("box").angle, 0.02);
}

TEST(UnmergePivot, APushThatTipsItWakesIt) {
  SceneRun run("unmerge-pivot");
  run.until(5.0);
  EXPECT_LT(run.body("box").angle, -1.0) << "it fell";
}

TEST(Seesaw, MergesWithItsLoadAndNotWithItsPivot) {
  SceneRun run("seesaw", Mode::Merge), reference("seesaw", Mode::Reference);
  for (double t = 0.5; t <= 5.0; t += 0.5) {
    run.until(t), reference.until(t);
    EXPECT_TRUE(run.together("beam", "left-child")) << t;
    EXPECT_TRUE(run.together("beam", "right-child")) << t;
    EXPECT_FALSE(run.anchored("beam")) << t;
    EXPECT_NEAR(run.body("beam").angle, reference.body("beam").angle, 0.01) << t;
  }
  EXPECT_GT(run.body("beam").angle, 0.1) << "it turns";
  run.until(12.0);
  EXPECT_TRUE(run.anchored("beam")) << "on the ground it has two contacts";
  EXPECT_NEAR(run.body("beam").angle, std::asin(0.2), 0.005) << "1 m high, 5 m long";
}

/// Under the paper's rule a single contact may hold: the metric alone decides.
TEST(Seesaw, TheNaiveMetricFreezesItAndTheCornersDoNot) {
  const Overrides paper = {{"merging.rule", "\"paper\""}, {"unmerging.rule", "\"paper\""}};
  Overrides naive = paper;
  naive.emplace_back("merging.metric", "\"naive\"");
  SceneRun right("seesaw", Mode::Merge, paper), wrong("seesaw", Mode::Merge, naive);
  right.until(5.0), wrong.until(5.0);
  EXPECT_FALSE(right.anchored("beam"));
  EXPECT_GT(right.body("beam").angle, 0.1) << "it turns on";
  EXPECT_TRUE(wrong.anchored("beam")) << "still at its pivot";
  EXPECT_LT(wrong.body("beam").angle, 0.01) << "it was stopped in mid-turn";
  wrong.until(12.0);
  EXPECT_LT(wrong.body("beam").angle, 0.01) << "for ever";
}

/// Its centre of mass is 7 mm beyond the pivot's edge: in the reference it tips within two seconds.
TEST(Seesaw, BarelyOutOfBalanceTipsAsInTheReference) {
  const Scene scene = parseScene(R"(
format = 1
[[body]]
name = "pivot"
motion = "pinned"
at = [0, -0.5]
box = [0.1, 1]
[[body]]
name = "beam"
at = [0.057, 0.1]
box = [9.2, 0.2]
)",
                                 "narrow.toml");
  SceneRun run(scene, Mode::Merge), reference(scene, Mode::Reference);
  run.until(2.0), reference.until(2.0);
  EXPECT_LT(reference.body("beam").angle, -0.02);
  EXPECT_NEAR(run.body("beam").angle, reference.body("beam").angle, 0.02);
}

/// A beam with a box on each end, on a pivot of two contacts `2 * half` apart; the centre of mass
/// is `beyond` [m] outside them, and all is set down from `drop` [m].
std::string loadedSeesaw(double half, double beyond, double drop) {
  const double shift = (half + beyond) * (0.7 + 2 * 0.36) / 0.36;  // of one box, from the balance
  return fmt::format(R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [20, 1]
[[body]]
name = "wedge"
motion = "pinned"
polygon = [[-0.6, 0], [0.6, 0], [{0}, 0.6], [-{0}, 0.6]]
[[body]]
name = "beam"
at = [0, {1}]
box = [3.5, 0.2]
mass = 0.7
[[body]]
name = "left"
at = [-1.4, {2}]
box = [0.6, 0.6]
mass = 0.36
[[body]]
name = "right"
at = [{3}, {2}]
box = [0.6, 0.6]
mass = 0.36
)",
                     half, 0.7 + drop, 1.1 + drop, 1.4 - shift);
}

double tipsAt(const std::string& toml, Mode mode) {
  SceneRun run(parseScene(toml, "seesaw.toml"), mode);
  for (double t = 0.1; t < 8.0; t += 0.01) {
    run.until(t);
    if (run.body("beam").angle > 0.05) return t;
  }
  return 8.0;
}

TEST(Seesaw, LoadedOnABluntPivotTipsAsInTheReference) {
  struct Case {
    double half, beyond, drop;
  };
  for (const auto& [half, beyond, drop] :
       {Case{0.02, 7e-4, 0.0}, Case{0.02, 2e-3, 0.1}, Case{0.02, 5e-3, 0.1}, Case{0.05, 7e-4, 0.1},
        Case{0.05, 2e-3, 0.1}, Case{1e-4, 2e-3, 0.1}}) {
    const std::string toml = loadedSeesaw(half, beyond, drop);
    const double reference = tipsAt(toml, Mode::Reference);
    ASSERT_LT(reference, 3.0);
    for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
      EXPECT_NEAR(tipsAt(toml, mode), reference, 0.4)
          << half << " " << beyond << " " << drop << " " << name(mode);
    }
  }
}

/// In balance on a blunt wedge that stands loose on the ground, and beside it three boxes that have
/// no part in what happens. It begins to move at 2 s.
constexpr double kTips = 2.0;  // s
std::string looseSeesaw(double half, double beyond) {
  std::string toml = loadedSeesaw(half, beyond, 0.0) + R"(
[[body]]
name = "post"
at = [3, 0.3]
box = [0.6, 0.6]
repeat = { count = [1, 3], spacing = [1, 0.6] }
)";
  const std::string pinned = "motion = \"pinned\"\npolygon";
  return toml.replace(toml.find(pinned), pinned.size(), "mass = 5\npolygon");
}

/// Held until then.
std::string letGo(double half, double beyond) {
  std::string toml = looseSeesaw(half, beyond);
  const std::string beam = "name = \"beam\"\n";
  return toml.insert(toml.find(beam) + beam.size(), fmt::format("pinned_until = {}\n", kTips));
}

/// Its left end is pushed down with so much more than rigid contacts bear [N].
std::string pushed(double half, double force) {
  constexpr double kWeight = 9.81 * (0.7 + 2 * 0.36), kArm = 1.7;  // N, m
  return looseSeesaw(half, -half) +
         fmt::format("[[force]]\nbody = \"beam\"\nat = [{}, 0]\nforce = [0, {}]\nfrom = {}\n",
                     -kArm, -(kWeight * half / (kArm - half) + force), kTips);
}

/// What a body does when the see-saw begins to tip, in its sizes.
struct Tipping {
  double way = 0.0;    ///< the farthest that an end gets in the reference within half a second
  bool freed = false;  ///< left what is pinned in that time
  double off = 0.0;    ///< how far it is from where it is in the reference, after two seconds
};

std::map<std::string, Tipping> tippingOf(const std::string& toml, Mode mode) {
  const Scene scene = parseScene(toml, "seesaw.toml");
  SceneRun reference(scene, Mode::Reference), merged(scene, mode);
  reference.until(kTips), merged.until(kTips);
  for (const char* name : {"wedge", "left", "right"}) EXPECT_TRUE(merged.anchored(name)) << name;
  const Snapshot start = reference.now();
  const auto sizeOf = [&](const BodyState& b) {
    const std::string& name = reference.nameOf(b.id);
    return name == "beam" ? 3.5 : name == "wedge" ? 1.2 : 0.6;
  };
  std::map<std::string, Tipping> seen;
  for (int step = 0; step < 50; ++step) {
    reference.steps(1), merged.steps(1);
    for (const BodyState& b : reference.now().bodies) {
      if (!reference.dynamic(b.id)) continue;
      const BodyState& first = start.bodies[index(b.id)];
      const double turned = 0.5 * sizeOf(b) * std::abs(b.angle - first.angle);
      Tipping& body = seen[reference.nameOf(b.id)];
      body.way = std::max(body.way, ((b.x - first.x).norm() + turned) / sizeOf(b));
      body.freed |= !merged.anchored(reference.nameOf(b.id));
    }
  }
  reference.until(kTips + 2.0), merged.until(kTips + 2.0);
  for (auto& [name, body] : seen) {
    const BodyState& b = reference.body(name);
    body.off = (merged.body(name).x - b.x).norm() / sizeOf(b);
  }
  return seen;
}

/// The beam and its load come free, wedge and post do not.
void expectFreesWhatTips(const std::map<std::string, Tipping>& seen, double off) {
  int moved = 0, stood = 0;
  for (const auto& [name, body] : seen) {
    moved += body.way > 0.01;
    stood += body.way < 0.001;
    EXPECT_TRUE(body.freed || body.way <= 0.01) << name << " moves by " << body.way;
    EXPECT_TRUE(!body.freed || body.way >= 0.001) << name << " stands";
    EXPECT_LT(body.off, off) << name;
  }
  EXPECT_GE(moved, 2);
  EXPECT_EQ(stood, 4);
}

TEST(Seesaw, BarelyOutOfBalanceAndLetGoMovesAsInTheReference) {
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    for (const double half : {0.02, 0.1}) {
      for (const double beyond : {0.002, 0.01, 0.04}) {
        SCOPED_TRACE(fmt::format("{} {} {}", half, beyond, name(mode)));
        expectFreesWhatTips(tippingOf(letGo(half, beyond), mode), 0.05);
      }
    }
  }
}

TEST(Seesaw, AFaintPushFreesWhatTipsAndNothingElse) {
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    for (const double half : {0.02, 0.05, 0.1}) {
      for (const double force : {0.02, 0.05, 0.1, 0.2, 0.4, 0.8}) {
        SCOPED_TRACE(fmt::format("{} {} {}", half, force, name(mode)));
        expectFreesWhatTips(tippingOf(pushed(half, force), mode), 0.05);
      }
    }
  }
}

TEST(TrussArch, ThreeHingesHoldAndFourFall) {
  SceneRun run("truss-arch", Mode::Merge);
  run.until(1.0);
  EXPECT_TRUE(run.anchored("left-leg"));
  EXPECT_TRUE(run.together("left-leg", "right-leg"));
  for (double t = 1.0; t < 2.0; t += 0.05) {
    run.until(t);
    for (const char* bar : {"left-post", "right-post", "lintel"}) {
      EXPECT_FALSE(run.merged(bar)) << bar << " at " << t;
    }
  }
  run.until(8.0);
  EXPECT_LT(run.body("lintel").x.y(), 1.0) << "it fell";
  EXPECT_NEAR(run.body("left-leg").x.y(), 1.006, 0.01) << "they stand";
  EXPECT_TRUE(run.together("left-leg", "right-leg"));
}

TEST(TrussArch, FallsAsInTheReference) {
  SceneRun run("truss-arch"), reference("truss-arch", Mode::Reference);
  run.until(2.0), reference.until(2.0);
  EXPECT_NEAR(run.body("lintel").angle, reference.body("lintel").angle, 0.02);
}

}  // namespace
}  // namespace merge2d
