#pragma once
/// Huffman codes as deflate writes them.

#include <cstdint>
#include <span>
#include <vector>

namespace merge2d {

/// How many bits the code of each symbol has: none for symbols that do not occur, at most `limit`
/// for the others. Of equal counts the lower symbol is the rarer one.
std::vector<std::uint8_t> huffmanLengths(std::span<const std::uint32_t> counts, int limit);

/// The canonical codes of these lengths, their bits in the order in which deflate writes them
/// (RFC 1951, section 3.2.2, reversed).
std::vector<std::uint16_t> huffmanCodes(std::span<const std::uint8_t> lengths);

}  // namespace merge2d
