/// Towers whose layers weigh a hundred times as much in turn (Section 8.1 of the paper).

#include <fmt/format.h>

#include "tests/scenes/scene_testing.h"

namespace merge2d {
namespace {

const Overrides kPapersRules = {{"merging.rule", "paper"}, {"unmerging.rule", "paper"}};

/// All that moves by more than 1% of a brick in the reference comes free, and at most a fifth of
/// the others: some of them slip by less.
void expectFreesWhatMoves(const std::vector<Reaction>& seen, int moving, int standing) {
  const auto [moved, moved_freed] = movedAndFreed(seen, 0.01);
  EXPECT_GE(moved, moving);
  EXPECT_EQ(moved_freed, moved);
  const auto [others, others_freed] = movedAndFreed(seen, -1.0, 0.01);
  EXPECT_GE(others, standing);
  EXPECT_LE(others_freed, 0.25 * others);
}

TEST(TowerImpulseHeavy, FreesWhatMovesAndNotWhatStands) {
  for (const char* iterations : {"120", "200", "300"}) {
    SCOPED_TRACE(iterations);
    const Overrides both{{"solver.iterations", iterations}};
    SceneRun reference("tower-impulse-heavy", Mode::Reference, both);
    SceneRun merged("tower-impulse-heavy", Mode::Merge, both);
    expectFreesWhatMoves(disturb(reference, merged, 1.49, 1.0), 30, 60);
  }
}

TEST(TowerImpulseHeavy, FreesWhatMovesInAReferenceThatHasConverged) {
  SceneRun converged("tower-impulse-heavy", Mode::Reference,
                     {{"solver.iterations", "1000"}, {"solver.compliance", "2e-6"}});
  SceneRun merged("tower-impulse-heavy", Mode::Merge);
  expectFreesWhatMoves(disturb(converged, merged, 1.49, 1.0), 30, 60);
  converged.until(3.5), merged.until(3.5);
  EXPECT_LT(farthest(merged, converged), 0.05);
}

TEST(TowerImpulseHeavy, EndsWhereItEndsInTheReference) {
  SceneRun reference("tower-impulse-heavy", Mode::Reference);
  SceneRun merged("tower-impulse-heavy", Mode::Merge);
  SceneRun asleep("tower-impulse-heavy", Mode::MergeSleep);
  const Snapshot before = reference.now();
  for (const double time : {2.0, 2.5, 3.5}) {
    reference.until(time), merged.until(time), asleep.until(time);
    EXPECT_LT(farthest(merged, reference), 0.05) << time;
    EXPECT_LT(farthest(asleep, reference), 0.05) << time;
  }
  const BodyState& struck = reference.body("heavy[0,4]");
  EXPECT_GT((struck.x - before.bodies[index(struck.id)].x).x(), 0.15) << "and that is not nothing";
  asleep.until(6.0);
  EXPECT_LT(farthest(asleep, reference), 0.05) << "where nothing moves any more";
  EXPECT_EQ(asleep.now().stats.asleep, 104);
}

TEST(TowerImpulseHeavy, UnderThePapersRulesItEndsElsewhere) {
  SceneRun reference("tower-impulse-heavy", Mode::Reference);
  SceneRun paper("tower-impulse-heavy", Mode::Merge, kPapersRules);
  reference.until(3.5), paper.until(3.5);
  EXPECT_GT(farthest(paper, reference), 0.1);
}

struct Tower {
  int columns, layers;   ///< of light bricks; one less of heavy ones
  double blow;           ///< to the first brick [N s]
  int at;                ///< in this heavy layer
  double step = 0.0025;  ///< [s]
  int iterations = 200;
  double compliance = 2e-5;
};

std::string tomlOf(const Tower& t) {
  return fmt::format(R"(
format = 1
step = {}
[solver]
iterations = {}
compliance = {}
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [60, 1]
[[body]]
name = "light"
at = [-1.224, 0.25]
box = [1, 0.5]
repeat = {{ count = [{}, {}], spacing = [1.02, 1.0] }}
[[body]]
name = "heavy"
at = [-0.816, 0.75]
box = [1, 0.5]
density = 100
repeat = {{ count = [{}, {}], spacing = [1.02, 1.0] }}
[[impulse]]
body = "heavy[0,{}]"
at = [-1.316, {}]
impulse = [{}, 0]
time = 1.5
)",
                     t.step, t.iterations, t.compliance, t.columns, t.layers, t.columns,
                     t.layers - 1, t.at, t.at + 0.75, t.blow);
}

SceneRun runOf(const Tower& tower, Mode mode, const Overrides& overrides = {}) {
  return SceneRun(parseScene(tomlOf(tower), "tower.toml", overrides), mode);
}

constexpr std::array kHeavyTowers{
    Tower{.columns = 6, .layers = 7, .blow = 1050, .at = 5},
    Tower{.columns = 8, .layers = 7, .blow = 650, .at = 4, .iterations = 300}};

/// Bricks that slide over the top, or bump into what stands, once drove the whole tower off.
TEST(HeavyTower, KeepsItsFootOnTheGround) {
  for (const Tower& tower : kHeavyTowers) {
    SCOPED_TRACE(tower.blow);
    SceneRun run = runOf(tower, Mode::Merge);
    run.until(1.49);
    const std::int64_t merged = run.world().steps();
    run.until(2.0);
    EXPECT_GT(run.count(EventType::Unmerge, merged), 10);
    const auto leavesTheGround = [&](const SceneRun::Logged& e) {
      return e.type == EventType::Unmerge && e.step > merged && e.a == "ground";
    };
    EXPECT_LE(std::ranges::count_if(run.log(), leavesTheGround), 3) << "of the lowest bricks";
  }
}

TEST(HeavyTower, MovesItsFootNoFartherThanInTheReference) {
  for (const Tower& tower : kHeavyTowers) {
    SCOPED_TRACE(tower.blow);
    SceneRun run = runOf(tower, Mode::Merge), reference = runOf(tower, Mode::Reference);
    run.until(3.5), reference.until(3.5);
    for (int i = 0; i < tower.columns; ++i) {
      const std::string brick = cell("light", i, 0);
      EXPECT_NEAR(run.body(brick).x.x(), reference.body(brick).x.x(), 1e-3) << brick;
    }
  }
}

/// Struck so hard, it sways, and bricks fall.
constexpr Tower kSlender{
    .columns = 3, .layers = 10, .blow = 500, .at = 7, .step = 0.01, .compliance = 2e-4};

/// The tower's own reference sways down to its foot, as its contacts are soft and its steps long.
/// One that is harder, has converged, and takes shorter steps tells what moves.
TEST(SlenderTower, FreesWhatMoves) {
  SceneRun converged =
      runOf(kSlender, Mode::Reference,
            {{"step", "0.0025"}, {"solver.iterations", "2000"}, {"solver.compliance", "2e-6"}});
  SceneRun merged = runOf(kSlender, Mode::Merge);
  const std::vector<Reaction> seen = disturb(converged, merged, 1.49, 1.0);
  const auto [moved, moved_freed] = movedAndFreed(seen, 0.01);
  EXPECT_GE(moved, 20);
  EXPECT_EQ(moved_freed, moved);
  EXPECT_GE(movedAndFreed(seen, 0.02).first, 15) << "clearly";
}

/// How many bricks lie beside the tower at the end.
int bricksBesideTheTower(Mode mode, const Overrides& overrides = {}) {
  SceneRun run = runOf(kSlender, mode, overrides);
  run.until(8.0);
  return static_cast<int>(std::ranges::count_if(run.now().bodies, [](const BodyState& b) {
    return b.x.y() < 2.0 && std::abs(b.x.x()) > 2.5;
  }));
}

TEST(SlenderTower, EndsMuchAsInTheReference) {
  const int reference = bricksBesideTheTower(Mode::Reference);
  const int merged = bricksBesideTheTower(Mode::MergeSleep);
  EXPECT_NEAR(merged, reference, 3);
  EXPECT_GT(merged, 0);
  EXPECT_GT(bricksBesideTheTower(Mode::Merge), 0);
}

TEST(SlenderTower, UnderThePapersRulesNoBrickFalls) {
  EXPECT_EQ(bricksBesideTheTower(Mode::Reference, kPapersRules), 5);
  for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
    EXPECT_EQ(bricksBesideTheTower(mode, kPapersRules), 0) << name(mode);
  }
}

}  // namespace
}  // namespace merge2d
