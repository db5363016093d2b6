#pragma once
/// Numbers to few bytes: rounded, as differences, in seven bits a byte, deflated, as base64.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace merge2d {

/// Whole numbers in the order they are to be read again.
class Packer {
 public:
  void number(std::int64_t value);
  /// The length, then the differences of consecutive values.
  void column(std::span<const std::int32_t> values);
  /// The same for values that rarely change: (how many, value) for each run.
  void runs(std::span<const std::int32_t> values);

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Rounds to whole multiples of a quantum.
struct Linear {
  double quantum = 1.0;
  std::int32_t code(double value) const;
};

/// Rounds sizes over many decades alike: code = ± round(steps · log2(1 + |value| / floor)).
/// Relative error 0.35 / steps far above `floor`; what is far below `floor` becomes 0.
struct Logarithmic {
  double floor = 1e-7;
  double steps = 64.0;  ///< per factor of two
  std::int32_t code(double value) const;
  double value(std::int32_t code) const;
};

/// zlib's format. Throws IoError when there is not enough memory.
std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes);

std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace merge2d
