#pragma once
/// The scenes that all engines are measured on, as plain data.

#include <cstdint>
#include <string>
#include <vector>

#include "src2d/scene/scene.h"

namespace merge2d::bench {

/// Of the towers' platform. The time that is measured is a whole period, so that what a tower bends
/// is not mistaken for what it creeps.
inline constexpr int kSwingSteps = 400;

/// The expected behaviour of a scene's bodies, and so the figures reported beside the time.
enum class Expectation {
  Stands,  ///< nothing should move against body 0, the platform or ground
  Moves,
};

/// Bodies that come while a scene runs.
struct Rain {
  int every = 0;  ///< steps; 0: none come
  BodyDesc body;
  double width = 0.0;  ///< they are spread over it, about the place of `body` [m]
};

struct BenchScene {
  Scene scene;
  Expectation expectation = Expectation::Stands;
  Rain rain = {};
  bool large = false;  ///< a step takes so long that fewer are measured
};

/// Where the rain lets its next body fall, after `step` steps; the same for every engine.
BodyDesc dropOf(const Rain& rain, std::int64_t step);

/// A running-bond wall of `count` boxes of 1 m, twice as high as wide, on a platform that swings
/// for ever. Its rows end in half boxes, so that no box stands on an edge.
BenchScene tower(int count);

/// A pyramid with `base` boxes of 1 m in its lowest row.
BenchScene pyramid(int base);

/// `count` boxes of 0.5 m dropped at once into a funnel above a floor.
BenchScene funnel(int count);

/// `count` boxes of 1 m that fall and never touch.
BenchScene freeFall(int count);

/// `count` stacks of five boxes of 1 m, side by side on the ground.
BenchScene stacks(int count);

/// A running-bond wall of about `count` boxes of 1 m, 20 high, on the ground.
BenchScene wall(int count);

/// The same, onto which a box falls every tenth step.
BenchScene rain(int count);

/// As many pyramids with ten boxes in their lowest row, side by side on the ground.
BenchScene pyramids(int count);

/// `count` small boxes in a drum of 20 m that turns by 25 degrees a second for ever.
BenchScene tumbler(int count);

/// Stacks of five boxes, all on the platform of the towers.
BenchScene swingingStacks(int count);

/// All scenes of the comparison; the quick ones leave out the largest.
std::vector<BenchScene> benchScenes(bool quick);

}  // namespace merge2d::bench
