#include "render/huffman.h"

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <utility>

namespace merge2d {
namespace {

constexpr int kLongest = 15;  // bits of a code in deflate

/// Depths of the leaves in the tree of the symbols that occur: Huffman's method.
std::vector<std::uint8_t> depths(std::span<const std::uint32_t> counts) {
  using Node = std::pair<std::uint64_t, std::uint32_t>;  // weight, index
  std::priority_queue<Node, std::vector<Node>, std::greater<>> open;
  for (std::uint32_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) open.emplace(counts[i], i);
  }
  std::vector<std::uint8_t> depth(counts.size());
  if (open.size() == 1) depth[open.top().second] = 1;
  std::vector<std::uint32_t> parent(2 * counts.size());
  auto next = static_cast<std::uint32_t>(counts.size());
  while (open.size() > 1) {
    const Node a = open.top();
    open.pop();
    const Node b = open.top();
    open.pop();
    parent[a.second] = parent[b.second] = next;
    open.emplace(a.first + b.first, next++);
  }
  std::vector<std::uint8_t> inner(2 * counts.size());  // of the nodes, from the root down
  for (std::uint32_t node = next - 1; node-- > counts.size();) {
    inner[node] = static_cast<std::uint8_t>(inner[parent[node]] + 1);
  }
  for (std::uint32_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0 && next > counts.size()) {
      depth[i] = static_cast<std::uint8_t>(inner[parent[i]] + 1);
    }
  }
  return depth;
}

}  // namespace

std::vector<std::uint8_t> huffmanLengths(std::span<const std::uint32_t> counts, int limit) {
  std::vector<std::uint32_t> flattened(counts.begin(), counts.end());
  for (;;) {
    std::vector<std::uint8_t> lengths = depths(flattened);
    if (std::ranges::all_of(lengths, [&](int length) { return length <= limit; })) return lengths;
    // Counts that are closer to each other make a tree that is less deep.
    for (std::uint32_t& count : flattened) count = (count + 1) / 2;
  }
}

std::vector<std::uint16_t> huffmanCodes(std::span<const std::uint8_t> lengths) {
  std::array<std::uint32_t, kLongest + 1> count{}, code{};
  for (const std::uint8_t length : lengths) count[length] += length > 0 ? 1U : 0U;
  for (std::size_t bits = 1; bits <= kLongest; ++bits) {
    code[bits] = (code[bits - 1] + count[bits - 1]) << 1;
  }
  std::vector<std::uint16_t> codes(lengths.size());
  for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
    std::uint32_t forward = code[lengths[symbol]]++, backward = 0;
    for (int bit = 0; bit < lengths[symbol]; ++bit, forward >>= 1) {
      backward = backward << 1 | (forward & 1);
    }
    codes[symbol] = static_cast<std::uint16_t>(backward);
  }
  return codes;
}

}  // namespace merge2d
