#pragma once
/// Rigid groups by another route: exact ranks over a prime field, of every subset of the bodies.

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "src2d/cycles/pins.h"

namespace merge2d {

/// Arithmetic modulo the Mersenne prime 2^61 − 1.
struct Field {
  static constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61u) - 1;
  __extension__ using Wide = unsigned __int128;

  static std::uint64_t of(std::int64_t i) {
    const auto p = static_cast<std::int64_t>(kPrime);
    return static_cast<std::uint64_t>(((i % p) + p) % p);
  }
  static std::uint64_t sub(std::uint64_t x, std::uint64_t y) { return (x + kPrime - y) % kPrime; }
  static std::uint64_t mul(std::uint64_t x, std::uint64_t y) {
    return static_cast<std::uint64_t>(Wide{x} * y % kPrime);
  }
  static std::uint64_t inverse(std::uint64_t x) {  // x^(p − 2)
    std::uint64_t result = 1;
    for (std::uint64_t e = kPrime - 2; e > 0; e >>= 1u, x = mul(x, x)) {
      if (e & 1u) result = mul(result, x);
    }
    return result;
  }
};

using Row = std::vector<std::uint64_t>;

inline std::size_t rankOf(std::vector<Row> rows) {
  std::size_t rank = 0;
  const std::size_t columns = rows.empty() ? 0 : rows[0].size();
  for (std::size_t c = 0; c < columns && rank < rows.size(); ++c) {
    const auto pivot = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(rank), rows.end(),
                                    [&](const Row& row) { return row[c] != 0; });
    if (pivot == rows.end()) continue;
    std::swap(*pivot, rows[rank]);
    const std::uint64_t inverse = Field::inverse(rows[rank][c]);
    for (std::size_t r = rank + 1; r < rows.size(); ++r) {
      const std::uint64_t factor = Field::mul(rows[r][c], inverse);
      if (factor == 0) continue;
      for (std::size_t k = c; k < columns; ++k) {
        rows[r][k] = Field::sub(rows[r][k], Field::mul(factor, rows[rank][k]));
      }
    }
    ++rank;
  }
  return rank;
}

/// The pins' places as field elements: integers where they are placed, else random.
inline std::vector<std::array<std::uint64_t, 2>> placesOf(std::span<const Pin> pins) {
  std::mt19937_64 random(7);
  std::vector<std::array<std::uint64_t, 2>> places;
  for (const Pin& pin : pins) {
    places.push_back(pin.placed ? std::array{Field::of(std::lround(pin.at.x())),
                                             Field::of(std::lround(pin.at.y()))}
                                : std::array{random() % Field::kPrime, random() % Field::kPrime});
  }
  return places;
}

/// The maximal sets of bodies that the pins between them hold together: each subset is tried.
inline Groups exactGroups(std::uint32_t nodes, std::span<const Pin> pins) {
  const auto places = placesOf(pins);
  std::vector<std::uint32_t> subsets(std::size_t{1} << nodes);
  for (std::uint32_t s = 0; s < subsets.size(); ++s) subsets[s] = s;
  std::stable_sort(subsets.begin(), subsets.end(), [](std::uint32_t x, std::uint32_t y) {
    return __builtin_popcount(x) > __builtin_popcount(y);
  });
  Groups groups(nodes);
  for (std::uint32_t i = 0; i < nodes; ++i) groups[i] = i;
  std::uint32_t taken = 0;  // maximal groups have no body in common
  for (const std::uint32_t subset : subsets) {
    const auto size = static_cast<std::size_t>(__builtin_popcount(subset));
    if (size < 2 || (subset & taken) != 0) continue;
    std::vector<Row> rows;
    for (std::size_t i = 0; i < pins.size(); ++i) {
      const Pin& pin = pins[i];
      if (pin.a == pin.b || !((subset >> pin.a) & (subset >> pin.b) & 1u)) continue;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        Row row(std::size_t{3} * nodes, 0);
        const std::uint64_t arm = axis == 0 ? Field::sub(0, places[i][1]) : places[i][0];
        row[3 * pin.a + axis] = 1;
        row[3 * pin.b + axis] = Field::sub(0, 1);
        row[3 * pin.a + 2] = arm;
        row[3 * pin.b + 2] = Field::sub(0, arm);
        rows.push_back(row);
      }
    }
    if (rankOf(rows) != 3 * (size - 1)) continue;
    taken |= subset;
    const auto first = static_cast<std::uint32_t>(__builtin_ctz(subset));
    for (std::uint32_t i = 0; i < nodes; ++i) {
      if ((subset >> i) & 1u) groups[i] = first;
    }
  }
  return groups;
}

}  // namespace merge2d
