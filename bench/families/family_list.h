#pragma once
/// Eight families of random structures that are to fall, one file each: see docs/benchmarks.md.

#include <array>

#include "bench/families/structure.h"

namespace merge2d::bench {

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
