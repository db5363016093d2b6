#include "src2d/relaxation/reached_rows.h"

#include <cmath>
#include <map>
#include <tuple>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

const std::string kWideWall = R"(
format = 1
[[body]]
name = "ground"
motion = "pinned"
at = [0, -0.5]
box = [300, 1]
[[body]]
name = "brick"
at = [-59.5, 0.5]
box = [1, 1]
repeat = { count = [120, 20], spacing = [1, 1], stagger = 0.5 }
)";

using Place = std::tuple<BodyId, BodyId, std::uint32_t>;

/// The impulses along the normals at the contact points that are farther away than this [m].
std::map<Place, double> farImpulses(const Snapshot& now, const Vec2& from, double distance) {
  std::map<Place, double> impulses;
  for (const ContactView& c : now.contacts) {
    if ((c.x - from).norm() > distance) impulses[{c.a, c.b, c.feature}] = c.lambda_n;
  }
  return impulses;
}

TEST(ReachedRows, APushOnAWallChangesNoImpulseFarAway) {
  Simulation run(kWideWall, Mode::Merge);
  run.until(6.0);
  const Vec2 struck = run.body("brick[60,19]").x;
  const auto before = farImpulses(run.now(), struck, 40.0);
  ASSERT_GT(before.size(), 500u);
  run.kick("brick[60,19]", {0.05, 0.0});
  bool changes = false;
  run.steps(60, [&] {
    for (const ContactView& c : run.now().contacts) {
      changes |= c.internal && (c.x - struck).norm() < 2.0 && std::abs(c.lambda_t) > 1e-3;
    }
  });
  EXPECT_TRUE(changes) << "near by";
  const auto after = farImpulses(run.now(), struck, 40.0);
  ASSERT_EQ(after.size(), before.size());
  for (const auto& [place, impulse] : before) {
    ASSERT_TRUE(after.contains(place));
    EXPECT_NEAR(after.at(place), impulse, 1e-6);
  }
}

}  // namespace
}  // namespace merge2d
