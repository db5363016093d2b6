#include "tests/scenes/scene_testing.h"

namespace merge2d {
namespace {

/// A parcel falls by 1.15 m, and the belt stops its slip within the blow: x = v (t − t₀). The time
/// of the landing is known to a step, and a step that covers it has the old speed.
TEST(Conveyor, AParcelRidesOnFromWhereItLands) {
  constexpr double kBelt = 1.0, kStart = 3.0;
  const double landing = kStart + std::sqrt(2.0 * 1.15 / 9.81);
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    for (const char* step : {"0.016666666666666666", "0.01", "0.004166666666666667"}) {
      SceneRun run("conveyor", mode, Overrides{{"step", step}});
      SCOPED_TRACE(std::string(name(mode)) + ", h = " + step);
      run.until(8.0);
      const double way = kBelt * (run.world().time() - landing);
      EXPECT_NEAR(run.body("parcel[0]").x.x(), -9.0 + way, 2.0 * kBelt * run.world().scene().step);
      EXPECT_NEAR(run.body("parcel[0]").v.x(), kBelt, 1e-3);
    }
  }
}

}  // namespace
}  // namespace merge2d
