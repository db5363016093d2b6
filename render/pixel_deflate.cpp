#include "render/pixel_deflate.h"

#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "render/huffman.h"
#include "src2d/core/assert.h"

namespace merge2d {
namespace {

constexpr std::size_t kLongestMatch = 258, kFarthestBack = 32768;  // of deflate [bytes]
constexpr std::uint32_t kEndOfBlock = 256;
constexpr int kLongestCode = 15, kLongestLengthCode = 7;
constexpr int kHashBits = 12;

/// A symbol of deflate's tables, and the bits that follow it.
struct Coded {
  std::uint32_t symbol, extra_bits, extra;
};

/// Numbers in ranges of 2^extra_bits, `per_doubling` of them before each range doubles: the scheme
/// of both of deflate's tables.
constexpr Coded coded(std::uint32_t number, std::uint32_t log_per_doubling) {
  const std::uint32_t first = 1U << (log_per_doubling + 1);
  if (number < first) return {number, 0, 0};
  const auto top = static_cast<std::uint32_t>(std::bit_width(number)) - 1;
  const std::uint32_t bits = top - log_per_doubling;
  return {(bits << log_per_doubling) + (number >> bits), bits, number & ((1U << bits) - 1)};
}

/// The length of a match [bytes], 3 to 258; symbols from 257 on (RFC 1951, section 3.2.5).
constexpr Coded codedLength(std::uint32_t length) {
  if (length == kLongestMatch) return {285, 0, 0};
  Coded c = coded(length - 3, 2);
  c.symbol += 257;
  return c;
}

/// The distance of a match [bytes], 1 to 32768.
constexpr Coded codedDistance(std::uint32_t distance) { return coded(distance - 1, 1); }

static_assert(codedLength(3).symbol == 257 && codedLength(10).symbol == 264);
static_assert(codedLength(11).symbol == 265 && codedLength(12).extra == 1);
static_assert(codedLength(257).symbol == 284 && codedLength(257).extra_bits == 5);
static_assert(codedDistance(4).symbol == 3 && codedDistance(5).symbol == 4);
static_assert(codedDistance(32768).symbol == 29 && codedDistance(32768).extra == 8191);

/// How many of the next `most` pixels are the same in two places.
std::size_t sameFrom(const std::uint32_t* a, const std::uint32_t* b, std::size_t most) {
  std::size_t n = 0;
  for (; n + 2 <= most; n += 2) {
    std::uint64_t two, others;
    std::memcpy(&two, a + n, sizeof two);
    std::memcpy(&others, b + n, sizeof others);
    if (two != others) return n + (a[n] == b[n] ? 1 : 0);
  }
  return n + (n < most && a[n] == b[n] ? 1 : 0);
}

std::size_t hashOf(std::uint32_t a, std::uint32_t b) {
  const std::uint64_t both = std::uint64_t{a} << 32 | b;
  return static_cast<std::size_t>(both * 0x9e3779b97f4a7c15U >> (64 - kHashBits));
}

}  // namespace

/// Appends bits to bytes, the lowest first.
class PixelDeflate::Bits {
 public:
  explicit Bits(std::vector<std::uint8_t>& out) : out_(out) {}

  void put(std::uint32_t bits, std::uint32_t count) {
    pending_ |= std::uint64_t{bits} << filled_;
    filled_ += count;
    if (filled_ < 32) return;
    for (int i = 0; i < 4; ++i) out_.push_back(static_cast<std::uint8_t>(pending_ >> 8 * i));
    pending_ >>= 32;
    filled_ -= 32;
  }

  void fillByte() {
    for (; filled_ > 0; filled_ -= std::min(filled_, 8U), pending_ >>= 8) {
      out_.push_back(static_cast<std::uint8_t>(pending_));
    }
  }

 private:
  std::vector<std::uint8_t>& out_;
  std::uint64_t pending_ = 0;
  std::uint32_t filled_ = 0;
};

std::span<const std::uint8_t> PixelDeflate::compress(std::span<const std::uint32_t> pixels,
                                                     std::size_t width, std::size_t bytes) {
  MERGE2D_ASSERT(width > 0 && pixels.size() % width == 0, "{} pixels in rows of {}", pixels.size(),
                 width);
  width_ = width;
  bytes_ = bytes;
  most_ = kLongestMatch / bytes;
  findTokens(pixels);
  out_.clear();
  Bits bits(out_);
  bits.put(0x0178, 16);  // zlib: deflate with a window of 32 KiB, the fastest level
  bits.put(1, 1);        // the last block
  bits.put(2, 2);        // with codes of its own
  writeTrees(bits);
  writeTokens(bits, pixels);
  bits.fillByte();
  const std::uint32_t sum = checksum(pixels);
  for (const int shift : {24, 16, 8, 0}) out_.push_back(static_cast<std::uint8_t>(sum >> shift));
  return out_;
}

void PixelDeflate::findTokens(std::span<const std::uint32_t> pixels) {
  tokens_.clear();
  seen_.assign(std::size_t{1} << kHashBits, 0);
  literal_counts_.fill(0);
  distance_counts_.fill(0);
  const std::size_t rows = pixels.size() / width_;
  for (std::size_t row = 0; row < rows; ++row) findTokensOfRow(pixels.data(), row);
  literal_counts_[0] += static_cast<std::uint32_t>(rows);  // the filter bytes
  ++literal_counts_[kEndOfBlock];
  ++distance_counts_[0], ++distance_counts_[1];  // so that there is a tree in any case
}

void PixelDeflate::findTokensOfRow(const std::uint32_t* first, std::size_t row) {
  const std::uint32_t* pixel = first + row * width_;
  std::size_t start = 0;  // of the pixels that are not yet in a token
  for (std::size_t x = 0; x < width_;) {
    const Match match = bestMatch(first, row, x);
    if (match.pixels == 0) {
      ++x;
      continue;
    }
    addToken(pixel + start, {static_cast<std::uint32_t>(x - start), match});
    start = x += match.pixels;
  }
  if (start < width_) addToken(pixel + start, {static_cast<std::uint32_t>(width_ - start), {}});
}

/// The longest of: a run of the pixel to the left, a copy of the row above, and a copy from where
/// the next two pixels were seen last.
PixelDeflate::Match PixelDeflate::bestMatch(const std::uint32_t* first, std::size_t row,
                                            std::size_t x) {
  const std::size_t here = row * width_ + x, stride = width_ * bytes_ + 1;
  const std::uint32_t* pixel = first + here;
  const std::size_t most = std::min(most_, width_ - x);
  const std::size_t least = bytes_ == 1 ? 3 : 1;  // deflate copies no less than three bytes
  std::size_t best = least - 1, distance = 0;
  const auto consider = [&](std::size_t length, std::size_t bytes_back) {
    if (length > best && bytes_back <= kFarthestBack) best = length, distance = bytes_back;
  };
  if (x > 0) consider(sameFrom(pixel, pixel - 1, most), bytes_);
  if (best < most && row > 0) consider(sameFrom(pixel, pixel - width_, most), stride);
  if (best < most && x + 1 < width_) {
    std::uint32_t& place = seen_[hashOf(pixel[0], pixel[1])];
    if (place > 0) {
      const std::size_t there = place - 1, column = there % width_;
      const std::size_t back = (row - there / width_) * stride + x * bytes_ - column * bytes_;
      consider(sameFrom(pixel, first + there, std::min(most, width_ - column)), back);
    }
    place = static_cast<std::uint32_t>(here + 1);
  }
  if (distance == 0) return {};
  return {static_cast<std::uint32_t>(best), static_cast<std::uint32_t>(distance)};
}

void PixelDeflate::addToken(const std::uint32_t* pixel, const Token& token) {
  tokens_.push_back(token);
  for (std::uint32_t i = 0; i < token.literal; ++i) {
    for (std::size_t b = 0; b < bytes_; ++b) ++literal_counts_[pixel[i] >> 8 * b & 0xff];
  }
  if (token.match.pixels == 0) return;
  const auto length = static_cast<std::uint32_t>(token.match.pixels * bytes_);
  ++literal_counts_[codedLength(length).symbol];
  ++distance_counts_[codedDistance(token.match.distance).symbol];
}

/// The lengths of both codes, themselves in a Huffman code: 16 repeats the last length 3 to 6
/// times, 17 and 18 are 3 to 10 and 11 to 138 zeros (RFC 1951, section 3.2.7).
void PixelDeflate::writeTrees(Bits& bits) {
  literal_lengths_ = huffmanLengths(literal_counts_, kLongestCode);
  distance_lengths_ = huffmanLengths(distance_counts_, kLongestCode);
  literal_codes_ = huffmanCodes(literal_lengths_);
  distance_codes_ = huffmanCodes(distance_lengths_);
  std::vector<std::uint8_t> lengths = literal_lengths_;
  lengths.insert(lengths.end(), distance_lengths_.begin(), distance_lengths_.end());

  std::vector<Coded> sequence;
  for (std::size_t i = 0; i < lengths.size();) {
    std::size_t run = 1;
    while (i + run < lengths.size() && lengths[i + run] == lengths[i] && run < 138) ++run;
    const auto n = static_cast<std::uint32_t>(run);
    if (lengths[i] == 0 && n >= 11) {
      sequence.push_back({18, 7, n - 11});
    } else if (lengths[i] == 0 && n >= 3) {
      sequence.push_back({17, 3, n - 3});
    } else if (n >= 4) {
      run = std::min<std::size_t>(run, 7);
      sequence.push_back({lengths[i], 0, 0});
      sequence.push_back({16, 2, static_cast<std::uint32_t>(run) - 4});
    } else {
      run = 1;
      sequence.push_back({lengths[i], 0, 0});
    }
    i += run;
  }

  constexpr std::array<std::size_t, 19> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                  11, 4,  12, 3, 13, 2, 14, 1, 15};
  std::array<std::uint32_t, kOrder.size()> counts{};
  for (const Coded& c : sequence) ++counts[c.symbol];
  const std::vector<std::uint8_t> code_lengths = huffmanLengths(counts, kLongestLengthCode);
  const std::vector<std::uint16_t> codes = huffmanCodes(code_lengths);
  bits.put(kLiterals - 257, 5);
  bits.put(kDistances - 1, 5);
  bits.put(kOrder.size() - 4, 4);
  for (const std::size_t symbol : kOrder) bits.put(code_lengths[symbol], 3);
  for (const Coded& c : sequence) {
    bits.put(codes[c.symbol], code_lengths[c.symbol]);
    bits.put(c.extra, c.extra_bits);
  }
}

void PixelDeflate::writeTokens(Bits& bits, std::span<const std::uint32_t> pixels) const {
  const auto literal = [&](std::uint32_t symbol) {
    bits.put(literal_codes_[symbol], literal_lengths_[symbol]);
  };
  std::size_t x = 0;
  const std::uint32_t* pixel = pixels.data();
  for (const Token& token : tokens_) {
    if (x == 0) literal(0);  // the filter
    for (std::uint32_t i = 0; i < token.literal; ++i) {
      for (std::size_t b = 0; b < bytes_; ++b) literal(pixel[i] >> 8 * b & 0xff);
    }
    if (token.match.pixels > 0) {
      const Coded length = codedLength(static_cast<std::uint32_t>(token.match.pixels * bytes_));
      literal(length.symbol);
      bits.put(length.extra, length.extra_bits);
      const Coded distance = codedDistance(token.match.distance);
      bits.put(distance_codes_[distance.symbol], distance_lengths_[distance.symbol]);
      bits.put(distance.extra, distance.extra_bits);
    }
    const std::size_t pixels_done = token.literal + token.match.pixels;
    pixel += pixels_done;
    x = (x + pixels_done) % width_;
  }
  literal(kEndOfBlock);
}

/// Adler's checksum of what is stored.
std::uint32_t PixelDeflate::checksum(std::span<const std::uint32_t> pixels) {
  row_.assign(1 + width_ * bytes_ + sizeof(std::uint32_t), 0);
  std::uint32_t sum = 1;
  for (std::size_t from = 0; from < pixels.size(); from += width_) {
    std::uint8_t* to = row_.data() + 1;
    // Whole words are stored; the bytes too many are overwritten by the next pixel.
    for (std::size_t x = 0; x < width_; ++x, to += bytes_) {
      std::memcpy(to, &pixels[from + x], sizeof(std::uint32_t));
    }
    sum = libdeflate_adler32(sum, row_.data(), 1 + width_ * bytes_);
  }
  return sum;
}

}  // namespace merge2d
