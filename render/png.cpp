#include "render/png.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>

#include "render/new_file.h"
#include "render/png_chunks.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr png_uint_32 kMaxSide = 8192;  // [px]

// The text that tells what a picture shows: its key, its language, and the key in that language.
// Other programs do without the last one, and so it also tells whose picture it is.
constexpr const char* kTextKey = "Description";
constexpr const char* kTextLanguage = "en";

[[noreturn]] void onError(png_structp, png_const_charp message) {
  throw IoError(fmt::format("PNG: {}", message));
}
void onWarning(png_structp, png_const_charp) {}

void setDescription(png_structp png, png_infop info, const std::string& description) {
  if (description.empty()) return;
  std::string key = kTextKey, value = description;
  png_text text{};
  text.compression = PNG_ITXT_COMPRESSION_NONE;  // iTXt is the one in UTF-8
  text.key = key.data();
  text.text = value.data();
  std::string language = kTextLanguage, translated = key;
  text.lang = language.data();
  text.lang_key = translated.data();
  png_set_text(png, info, &text, 1);
}

void setPalette(png_structp png, png_infop info, std::span<const std::uint32_t> palette) {
  std::vector<png_color> colors;
  Bytes opacities;
  const auto channel = [](std::uint32_t color, int shift) {
    return static_cast<png_byte>(color >> shift & 0xff);
  };
  for (const std::uint32_t c : palette) {
    colors.push_back({channel(c, 0), channel(c, 8), channel(c, 16)});
    opacities.push_back(channel(c, 24));
  }
  png_set_PLTE(png, info, colors.data(), static_cast<int>(colors.size()));
  if (std::ranges::all_of(opacities, [](int a) { return a == 255; })) return;
  png_set_tRNS(png, info, opacities.data(), static_cast<int>(opacities.size()), nullptr);
}

/// PNG counts per metre.
void setResolution(png_structp png, png_infop info, double dots_per_inch) {
  if (dots_per_inch <= 0.0) return;
  constexpr double kInch = 0.0254;  // [m]
  const auto dots = static_cast<png_uint_32>(std::lround(dots_per_inch / kInch));
  png_set_pHYs(png, info, dots, dots, PNG_RESOLUTION_METER);
}

struct Writer {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, onError, onWarning);
  png_infop info = png_create_info_struct(png);
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

struct Reader {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, onError, onWarning);
  png_infop info = png_create_info_struct(png);
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct Source {
  std::span<const std::uint8_t> rest;
};

void readBytes(png_structp png, png_bytep out, std::size_t size) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (size > source.rest.size()) png_error(png, "the file ends too early");
  std::memcpy(out, source.rest.data(), size);
  source.rest = source.rest.subspan(size);
}

void appendBytes(png_structp png, png_bytep data, std::size_t size) {
  auto& out = *static_cast<Bytes*>(png_get_io_ptr(png));
  out.insert(out.end(), data, data + size);
}

}  // namespace

/// The format of a file's pixels.
struct PngEncoder::Image {
  int color_type = PNG_COLOR_TYPE_RGB;
  std::span<const std::uint32_t> pixels;
  std::size_t bytes = 3;  ///< of a pixel
  std::span<const std::uint32_t> palette;
};

std::span<const std::uint8_t> PngEncoder::encode(const Picture& picture,
                                                 const PngOptions& options) {
  loadPixels(picture, options.alpha);
  Image image{.pixels = pixels_, .palette = {}};
  if (options.alpha) image.color_type = PNG_COLOR_TYPE_RGB_ALPHA, image.bytes = 4;
  write(image, picture, options, out_);
  if (options.palette && findPalette()) {
    write({PNG_COLOR_TYPE_PALETTE, indices_, 1, palette_}, picture, options, smaller_);
    if (smaller_.size() < out_.size()) out_.swap(smaller_);
  }
  return out_;
}

/// Red in the lowest byte; without alpha all are opaque.
void PngEncoder::loadPixels(const Picture& picture, bool alpha) {
  const std::size_t count = picture.rgba.size() / 4;
  const std::uint32_t opaque = alpha ? 0 : 0xff000000U;
  pixels_.resize(count);
  const std::uint8_t* p = picture.rgba.data();
  for (std::size_t i = 0; i < count; ++i, p += 4) {
    pixels_[i] =
        (p[0] | std::uint32_t{p[1]} << 8 | std::uint32_t{p[2]} << 16 | std::uint32_t{p[3]} << 24) |
        opaque;
  }
}

/// Numbers the colours; false when there are more than a palette holds.
bool PngEncoder::findPalette() {
  constexpr std::size_t kMost = 256, kSlots = 1024;
  std::array<std::uint16_t, kSlots> slots{};  // by hash of the colour: its number, from 1
  palette_.clear();
  indices_.resize(pixels_.size());
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const std::uint32_t color = pixels_[i];
    if (i > 0 && color == pixels_[i - 1]) {
      indices_[i] = indices_[i - 1];
      continue;
    }
    std::size_t slot = color * 0x9e3779b1U >> 22;
    while (slots[slot] != 0 && palette_[slots[slot] - 1U] != color) slot = (slot + 1) % kSlots;
    if (slots[slot] == 0) {
      if (palette_.size() == kMost) return false;
      palette_.push_back(color);
      slots[slot] = static_cast<std::uint16_t>(palette_.size());
    }
    indices_[i] = slots[slot] - 1U;
  }
  return true;
}

void PngEncoder::write(const Image& image, const Picture& picture, const PngOptions& options,
                       Bytes& out) {
  out.clear();
  const Writer writer;
  png_structp png = writer.png;
  png_infop info = writer.info;
  png_set_write_fn(png, &out, appendBytes, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width),
               static_cast<png_uint_32>(picture.height), 8, image.color_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!image.palette.empty()) setPalette(png, info, image.palette);
  setResolution(png, info, options.dots_per_inch);
  setDescription(png, info, options.description);
  png_write_info(png, info);
  const std::span<const std::uint8_t> data =
      deflate_.compress(image.pixels, static_cast<std::size_t>(picture.width), image.bytes);
  png_write_chunk(png, reinterpret_cast<png_const_bytep>("IDAT"), data.data(), data.size());
  png_write_chunk(png, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
}

Picture decodePng(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 8 || png_sig_cmp(bytes.data(), 0, 8) != 0) throw IoError("not a PNG file");
  Source source{bytes};
  const Reader reader;
  png_structp png = reader.png;
  png_infop info = reader.info;
  png_set_user_limits(png, kMaxSide, kMaxSide);
  png_set_read_fn(png, &source, readBytes);
  png_read_info(png, info);
  png_set_expand(png);
  png_set_strip_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);

  Picture picture(static_cast<int>(png_get_image_width(png, info)),
                  static_cast<int>(png_get_image_height(png, info)));
  std::vector<png_bytep> rows;
  for (int y = 0; y < picture.height; ++y)
    rows.push_back(picture.rgba.data() + picture.offset(0, y));
  png_read_image(png, rows.data());
  png_read_end(png, nullptr);
  return picture;
}

PngSummary inspectPng(std::span<const std::uint8_t> bytes) {
  PngSummary out;
  PngChunks chunks(bytes);
  while (const auto chunk = chunks.next()) {
    if (chunk->type == "IHDR" && chunk->data.size() == 13) {
      out.width = static_cast<int>(fromBigEndian(chunk->data));
      out.height = static_cast<int>(fromBigEndian(chunk->data.subspan(4)));
    }
    out.complete = chunk->type == "IEND";
  }
  return out;
}

bool isOurPng(const std::filesystem::path& file) {
  constexpr std::size_t kHeader = 2048;  // bytes in which the text begins, behind a palette
  // After the key two zeros say that the text is not compressed.
  const std::string text =
      fmt::format("iTXt{0}{1}{1}{1}{2}{1}{0}{1}", kTextKey, '\0', kTextLanguage);
  std::ifstream in(file, std::ios::binary);
  std::string head(kHeader, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return std::ranges::equal(head.substr(0, kPngSignature.size()), kPngSignature, {},
                            [](char c) { return static_cast<std::uint8_t>(c); }) &&
         head.find(text) != std::string::npos;
}

std::vector<std::uint8_t> readFileBytes(const std::filesystem::path& file) {
  const auto fail = [&] {
    throw IoError(
        fmt::format("cannot read {}: {}", file.string(), std::generic_category().message(errno)));
  };
  const auto closed = [](std::FILE* in) { std::fclose(in); };
  const std::unique_ptr<std::FILE, decltype(closed)> in(std::fopen(file.c_str(), "rbe"), closed);
  if (!in) fail();
  Bytes bytes;
  constexpr std::size_t kBlock = 1 << 16;
  for (std::size_t got = kBlock; got == kBlock;) {
    const std::size_t size = bytes.size();
    bytes.resize(size + kBlock);
    got = std::fread(bytes.data() + size, 1, kBlock, in.get());
    bytes.resize(size + got);
  }
  if (std::ferror(in.get()) != 0) fail();  // a folder can be opened, but not read
  return bytes;
}

std::string readFileText(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = readFileBytes(file);
  return {bytes.begin(), bytes.end()};
}

void writeAtomically(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                     bool durable) {
  NewFile out(file, {.durable = durable});
  out.write(bytes);
  out.finish();
}

}  // namespace merge2d
