/// Frames of posts and beams that are pushed slowly.

#include <fmt/format.h>

#include "tests/support/merging_testing.h"

namespace merge2d {
namespace {

/// Five storeys of two posts and a beam, the second pushed from 2.5 s on with so many newtons.
std::string frame(double push) {
  std::string toml = kGround;
  const auto box = [&](const std::string& name, double x, double y, const char* size) {
    toml += fmt::format("[[body]]\nname = \"{}\"\nat = [{}, {}]\nbox = {}\n", name, x, y, size);
  };
  for (int storey = 0; storey < 5; ++storey) {
    const double foot = 1.2 * storey;
    box(fmt::format("left{}", storey), -1.2, foot + 0.5, "[0.3, 1]");
    box(fmt::format("right{}", storey), 1.2, foot + 0.5, "[0.3, 1]");
    box(fmt::format("beam{}", storey), 0.0, foot + 1.1, "[3, 0.2]");
  }
  return toml + fmt::format("[[force]]\nbody = \"beam1\"\nfrom = 2.5\nforce = [{}, 0]\n", push);
}

/// When the highest beam goes faster than half a metre per second [s].
double timeOfFall(Mode mode, double push) {
  Simulation run(frame(push), mode, {{"solver.iterations", "30"}});
  while (run.world().time() < 6.0) {
    run.steps(1);
    if (run.body("beam4").v.norm() > 0.5) return run.world().time();
  }
  return 6.0;
}

/// The posts of the second storey bear 41 N and the beam on them 6 N, and are 0.3 m wide and 1 m
/// high: they tip at 14.5 N. A single sweep a step found it 0.8 s later at 17 N.
TEST(SlowLoad, AFrameThatIsPushedFallsInTime) {
  for (const double push : {17.0, 18.0, 20.0}) {
    const double reference = timeOfFall(Mode::Reference, push);
    EXPECT_LT(reference, 3.2) << push << " N";
    for (const Mode mode : {Mode::Merge, Mode::MergeSleep}) {
      EXPECT_NEAR(timeOfFall(mode, push), reference, 0.2) << push << " N, " << name(mode);
    }
  }
}

TEST(SlowLoad, AFrameThatIsPushedLessStands) {
  for (const double push : {4.0, 8.0, 12.0}) {
    EXPECT_EQ(timeOfFall(Mode::Reference, push), 6.0) << push << " N";
    EXPECT_EQ(timeOfFall(Mode::Merge, push), 6.0) << push << " N";
  }
}

}  // namespace
}  // namespace merge2d
