#pragma once
/// A set of indices below a bound, which lists them ascending.

#include <bit>
#include <cstdint>
#include <vector>

namespace merge2d {

class IndexSet {
 public:
  explicit IndexSet(std::size_t bound) : words_(bound / kBits + 1, 0) {}

  /// False where it is in the set already.
  bool add(std::uint32_t index) {
    const std::uint64_t bit = std::uint64_t{1} << index % kBits;
    std::uint64_t& word = words_[index / kBits];
    const bool is_new = (word & bit) == 0;
    word |= bit;
    return is_new;
  }

  std::vector<std::uint32_t> ascending() const {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t w = 0; w < words_.size(); ++w) {
      for (std::uint64_t word = words_[w]; word != 0; word &= word - 1) {
        indices.push_back(kBits * w + static_cast<std::uint32_t>(std::countr_zero(word)));
      }
    }
    return indices;
  }

 private:
  static constexpr std::uint32_t kBits = 64;
  std::vector<std::uint64_t> words_;
};

}  // namespace merge2d
