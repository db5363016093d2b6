#include "render/png.h"

#include <fmt/format.h>
#include <libdeflate.h>
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

constexpr int kLevel = 1;               // higher levels cost much and gain little on flat pictures
constexpr png_uint_32 kMaxSide = 8192;  // [px]

// The text that tells what a picture shows: its key, its language, and the key in that language.
// Other programs do without the last one, and so it also tells whose picture it is.
constexpr const char* kTextKey = "Description";
constexpr const char* kTextLanguage = "en";

[[noreturn]] void onError(png_structp, png_const_charp message) {
  throw IoError(fmt::format("PNG: {}", message));
}
void onWarning(png_structp, png_const_charp) {}

struct Compressor {
  libdeflate_compressor* handle = libdeflate_alloc_compressor(kLevel);
  ~Compressor() { libdeflate_free_compressor(handle); }
};

/// Rows as PNG stores them: a filter byte (0, none) and the pixels.
Bytes rawRows(const Picture& picture, bool alpha) {
  const auto width = static_cast<std::size_t>(picture.width);
  const std::size_t channels = alpha ? 4 : 3;
  Bytes raw(static_cast<std::size_t>(picture.height) * (1 + channels * width));
  const std::uint8_t* from = picture.rgba.data();
  std::uint8_t* to = raw.data();
  for (int y = 0; y < picture.height; ++y) {
    *to++ = 0;
    if (alpha) {
      std::memcpy(to, from, 4 * width);
      to += 4 * width, from += 4 * width;
      continue;
    }
    for (std::size_t x = 0; x < width; ++x, from += 4, to += 3) {
      to[0] = from[0], to[1] = from[1], to[2] = from[2];
    }
  }
  return raw;
}

/// libdeflate compresses such pictures almost twice as fast as zlib.
Bytes compressed(const Bytes& raw) {
  thread_local const Compressor compressor;
  Bytes out(libdeflate_zlib_compress_bound(compressor.handle, raw.size()));
  out.resize(
      libdeflate_zlib_compress(compressor.handle, raw.data(), raw.size(), out.data(), out.size()));
  return out;
}

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

std::vector<std::uint8_t> encodePng(const Picture& picture, const PngOptions& options) {
  Bytes data = compressed(rawRows(picture, options.alpha));
  Bytes out;
  out.reserve(data.size() + 1024);
  const Writer writer;
  png_structp png = writer.png;
  png_infop info = writer.info;
  png_set_write_fn(png, &out, appendBytes, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width),
               static_cast<png_uint_32>(picture.height), 8,
               options.alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  setResolution(png, info, options.dots_per_inch);
  setDescription(png, info, options.description);
  png_write_info(png, info);
  png_write_chunk(png, reinterpret_cast<png_const_bytep>("IDAT"), data.data(), data.size());
  png_write_chunk(png, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
  return out;
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
  constexpr std::size_t kHead = 128;  // bytes in which the text begins
  // After the key two zeros say that the text is not compressed.
  const std::string text =
      fmt::format("iTXt{0}{1}{1}{1}{2}{1}{0}{1}", kTextKey, '\0', kTextLanguage);
  std::ifstream in(file, std::ios::binary);
  std::string head(kHead, '\0');
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

void writeAtomically(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                     bool durable) {
  NewFile out(file, {.durable = durable});
  out.write(bytes);
  out.finish();
}

}  // namespace merge2d
