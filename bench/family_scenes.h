#pragma once
/// Eight families of random structures that are to fall: see docs/benchmarks.md.

#include <array>
#include <string>
#include <vector>

#include "bench/random_scene.h"

namespace merge2d::bench {

/// A body whose motion tells that its structure falls, seen from another.
struct Watch {
  BodyIndex body = 0, frame = 0;
  double way = 0.25;             ///< that is a fall [m]
  double turn = 15.0 * kDegree;  ///< that is one [rad]
  Vec2 at = Vec2::Zero();        ///< its point, from the centre of mass, in the body frame [m]
  Vec2 along = Vec2::Zero();     ///< direction of the way in the frame; zero: any
};

/// A random structure.
struct Structure {
  std::string kind;
  Scene scene = {};
  std::vector<Watch> watched = {};
  double from = 0.0;    ///< when it has settled and its load begins [s]
  double until = 12.0;  ///< [s]
};

struct Family {
  const char* name;
  Structure (*make)(Random&);
};

Structure movingFrame(Random& random);
Structure drum(Random& random);
Structure arch(Random& random);
Structure ladder(Random& random);
Structure cardHouse(Random& random);
Structure disassembly(Random& random);
Structure heavyOnLight(Random& random);
Structure conveyor(Random& random);

inline constexpr std::array kFamilies{
    Family{"frames", movingFrame}, Family{"drums", drum},
    Family{"arches", arch},        Family{"ladders", ladder},
    Family{"cards", cardHouse},    Family{"disassembly", disassembly},
    Family{"heavy", heavyOnLight}, Family{"conveyors", conveyor},
};

}  // namespace merge2d::bench
