#pragma once
/// The data that a direct solve (dynamics/newton.h) keeps between its parts: its rows, and the
/// layout of its matrix, which takes as long as two of its steps. All of it follows from the rows
/// of the solve, which must stay at their addresses.

#include <memory>

namespace merge2d {

class InteriorPoint;

struct NewtonWorkspace {
  std::shared_ptr<InteriorPoint> point;
};

}  // namespace merge2d
