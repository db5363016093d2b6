#include "src2d/body_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "src2d/core/error.h"

namespace merge2d {
namespace {

/// Hands one row of `columns` numbers for each body to `fill`, which leaves it where none is there.
template <class T, class Fill>
void fillRows(const State& state, std::span<T> out, std::size_t columns, T none, Fill&& fill) {
  const std::size_t needed = columns * state.bodies.size();
  if (out.size() != needed) {
    throw InputError(fmt::format("the array must have {} elements, not {}", needed, out.size()));
  }
  std::fill(out.begin(), out.end(), none);
  for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
    if (state.bodies[i].alive) fill(BodyId{i}, out.subspan(columns * i, columns));
  }
}

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

Vec2 centerNow(const State& state, BodyId body) {
  const bool own = state[body].rigid == rigidOf(body);
  return own ? state.rigid(body).exactCenter() : state.pose(body).position;
}

}  // namespace

void writePoses(const State& state, std::span<double> out) {
  fillRows(state, out, 3, kAbsent, [&](BodyId body, std::span<double> row) {
    const Vec2 x = centerNow(state, body);
    row[0] = x.x();
    row[1] = x.y();
    row[2] = state.angle(body);
  });
}

void writeVelocities(const State& state, std::span<double> out) {
  fillRows(state, out, 3, kAbsent, [&](BodyId body, std::span<double> row) {
    const Vec2 v = state.rigid(body).velocityAt(state.pose(body).position);
    row[0] = v.x();
    row[1] = v.y();
    row[2] = state.rigid(body).omega;
  });
}

void writeCollections(const State& state, std::span<std::int32_t> out) {
  fillRows(state, out, 1, value(kNoCollection), [&](BodyId body, std::span<std::int32_t> row) {
    const RigidId rigid = state[body].rigid;
    if (state.isCollection(rigid)) row[0] = value(state.collection(rigid).id);
  });
}

}  // namespace merge2d
