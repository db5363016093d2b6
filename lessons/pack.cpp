#include "lessons/pack.h"

#include <libdeflate.h>

#include <cmath>
#include <limits>
#include <memory>

#include "src2d/core/error.h"

namespace merge2d {
namespace {

constexpr double kLargest = std::numeric_limits<std::int32_t>::max();

std::int32_t rounded(double x) {
  if (!(std::abs(x) < kLargest)) return x > 0 ? std::numeric_limits<std::int32_t>::max() : 0;
  return static_cast<std::int32_t>(std::lround(x));
}

}  // namespace

/// Small numbers of either sign first become small numbers without one: 0, −1, 1, −2, …
void Packer::number(std::int64_t value) {
  const auto sign = static_cast<std::uint64_t>(value >> 63);
  std::uint64_t rest = (static_cast<std::uint64_t>(value) << 1U) ^ sign;
  while (rest >= 0x80U) {
    bytes_.push_back(static_cast<std::uint8_t>(rest | 0x80U));
    rest >>= 7U;
  }
  bytes_.push_back(static_cast<std::uint8_t>(rest));
}

void Packer::column(std::span<const std::int32_t> values) {
  number(static_cast<std::int64_t>(values.size()));
  std::int64_t before = 0;
  for (const std::int32_t value : values) {
    number(value - before);
    before = value;
  }
}

void Packer::runs(std::span<const std::int32_t> values) {
  number(static_cast<std::int64_t>(values.size()));
  for (std::size_t i = 0; i < values.size();) {
    std::size_t end = i + 1;
    while (end < values.size() && values[end] == values[i]) ++end;
    number(static_cast<std::int64_t>(end - i));
    number(values[i]);
    i = end;
  }
}

std::int32_t Linear::code(double value) const { return rounded(value / quantum); }

std::int32_t Logarithmic::code(double value) const {
  const std::int32_t size = rounded(steps * std::log2(1.0 + std::abs(value) / floor));
  return value < 0.0 ? -size : size;
}

double Logarithmic::value(std::int32_t code) const {
  const double size = floor * (std::exp2(std::abs(code) / steps) - 1.0);
  return code < 0 ? -size : size;
}

std::vector<std::uint8_t> deflated(std::span<const std::uint8_t> bytes) {
  constexpr int kLevel = 9;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  if (!compressor) throw IoError("there is not enough memory to compress the recording");
  std::vector<std::uint8_t> out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  out.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(),
                                      out.size()));
  return out;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t triple = (static_cast<std::uint32_t>(bytes[i]) << 16U) |
                                 (left > 1 ? static_cast<std::uint32_t>(bytes[i + 1]) << 8U : 0U) |
                                 (left > 2 ? static_cast<std::uint32_t>(bytes[i + 2]) : 0U);
    out += kDigits[triple >> 18U];
    out += kDigits[(triple >> 12U) & 63U];
    out += left > 1 ? kDigits[(triple >> 6U) & 63U] : '=';
    out += left > 2 ? kDigits[triple & 63U] : '=';
  }
  return out;
}

}  // namespace merge2d
