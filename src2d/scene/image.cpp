#include "src2d/scene/image.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>

#include "src2d/core/error.h"
#include "src2d/scene/scene.h"

namespace merge2d {
namespace {

/// libpng's classic interface; the simplified one of libpng 1.6.39 mixes up the rows of interlaced
/// pictures with 16 bits per channel.
class PngReader {
 public:
  PngReader(std::string_view bytes, const std::string& name) : name_(name), rest_(bytes) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, onError, onWarning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) fail();
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// Any kind of PNG as eight bits of red, green, blue and alpha.
  Image readPixels() {
    guarded([&] {
      readHeader();
      png_set_alpha_mode(png_, PNG_ALPHA_PNG, PNG_DEFAULT_sRGB);
      png_set_scale_16(png_);
      png_set_expand(png_);
      png_set_gray_to_rgb(png_);
      png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
    });
    Image result{static_cast<int>(width()), static_cast<int>(height()), {}};
    result.pixels.resize(std::size_t{width()} * height());
    readRows(reinterpret_cast<png_bytep>(result.pixels.data()), sizeof(Image::Pixel));
    return result;
  }

  /// Throws where a pixel of a picture with a palette has a number that no colour of it has.
  void checkPalette() {
    int colors = 0;
    guarded([&] {
      readHeader();
      png_set_packing(png_);
      png_colorp palette = nullptr;
      png_get_PLTE(png_, info_, &palette, &colors);
    });
    std::vector<png_byte> numbers(std::size_t{width()} * height());
    readRows(numbers.data(), 1);
    const auto bad = std::ranges::find_if(numbers, [&](png_byte n) { return n >= colors; });
    if (bad == numbers.end()) return;
    const auto at = static_cast<std::size_t>(bad - numbers.begin());
    throw InputError(fmt::format("{}: pixel ({}, {}) has colour {} of a palette that ends with {}",
                                 name_, at % width(), at / width(), *bad, colors - 1));
  }

 private:
  static void onError(png_structp png, png_const_charp message) {
    static_cast<PngReader*>(png_get_error_ptr(png))->message_ = message;
    png_longjmp(png, 1);
  }
  static void onWarning(png_structp, png_const_charp) {}
  static void readBytes(png_structp png, png_bytep out, std::size_t size) {
    std::string_view& rest = static_cast<PngReader*>(png_get_io_ptr(png))->rest_;
    if (size > rest.size()) png_error(png, "the file ends too early");
    std::memcpy(out, rest.data(), size);
    rest.remove_prefix(size);
  }

  /// Runs a part that calls libpng, whose errors leave it by longjmp: nothing in there may need a
  /// destructor.
  template <class Part>
  void guarded(const Part& part) {
    if (setjmp(png_jmpbuf(png_)) != 0) fail();
    part();
  }

  void readHeader() {
    // `checkSize` has seen to the size, and texts are of no use here.
    png_set_user_limits(png_, SceneLimits::kDrawingPixels, SceneLimits::kDrawingPixels);
    const auto* texts = reinterpret_cast<const png_byte*>("tEXt\0zTXt\0iTXt");
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, texts, 3);
    png_set_read_fn(png_, this, readBytes);
    png_read_info(png_, info_);
  }

  void readRows(png_bytep to, std::size_t bytes_per_pixel) {
    std::vector<png_bytep> rows(height());
    for (png_bytep& row : rows) {
      row = to;
      to += width() * bytes_per_pixel;
    }
    guarded([&] {
      png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
      png_read_image(png_, rows.data());
    });
  }

  png_uint_32 width() const { return png_get_image_width(png_, info_); }
  png_uint_32 height() const { return png_get_image_height(png_, info_); }

  [[noreturn]] void fail() const {
    throw InputError(fmt::format("{}: not a whole PNG picture ({})", name_, message_));
  }

  const std::string& name_;
  std::string_view rest_;
  std::string message_ = "no memory";
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

constexpr std::string_view kSignature{"\x89PNG\r\n\x1a\n", 8};

/// The four bytes at `at`, highest first.
std::uint32_t numberAt(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (const char c : bytes.substr(at, 4)) number = 256 * number + static_cast<unsigned char>(c);
  return number;
}

/// libpng is content once it has all pixels; a file that was cut off behind them is still not
/// whole.
bool endsAsPng(std::string_view bytes) {
  std::size_t at = kSignature.size();  // then chunks: length, type, data, checksum
  while (bytes.size() >= at + 12) {
    if (bytes.substr(at + 4, 4) == "IEND") return true;
    at += std::size_t{12} + numberAt(bytes, at);
  }
  return false;
}

/// Signatures at the start of a file and, where one alone could be the start of a text, further on.
struct Format {
  std::string_view name, start;
  std::size_t at = 0;
  std::string_view later = {};
};
constexpr std::array<Format, 6> kFormats{{{"PNG", kSignature},
                                          {"JPEG", "\xFF\xD8\xFF"},
                                          {"GIF", "GIF87a"},
                                          {"GIF", "GIF89a"},
                                          {"BMP", "BM", 6, {"\0\0\0\0", 4}},
                                          {"WebP", "RIFF", 8, "WEBP"}}};

/// Checks for which libpng has words of its own, or none.
void checkWhole(std::string_view bytes, const std::string& name) {
  const auto fail = [&](std::string_view sentence) {
    throw InputError(fmt::format("{}: {}", name, sentence));
  };
  if (bytes.empty()) fail("the file is empty");
  if (!kSignature.starts_with(bytes.substr(0, kSignature.size()))) {
    const std::string_view kind = pictureKind(bytes);
    if (kind.empty()) fail("not a PNG picture");
    fail(fmt::format("this is a {} picture, whatever its name: save it as PNG", kind));
  }
  if (!endsAsPng(bytes)) fail("not a whole PNG picture (its end is missing)");
}

/// Whether the header says that pixels are numbers of colours in a palette.
bool hasPalette(std::string_view bytes) {
  const std::size_t color_type = kSignature.size() + 8 + 9;
  return bytes.size() > color_type && bytes[color_type] == PNG_COLOR_TYPE_PALETTE;
}

/// Checks the size that the header of a whole PNG claims, before anybody believes it.
void checkSize(std::string_view bytes, const std::string& name) {
  const std::size_t header = kSignature.size() + 4;
  if (bytes.substr(header, 4) != "IHDR") return;  // libpng says so
  const std::uint64_t width = numberAt(bytes, header + 4), height = numberAt(bytes, header + 8);
  if (width * height <= SceneLimits::kDrawingPixels) return;
  throw InputError(fmt::format("{}: a drawing has at most {} pixels, this one has {} x {}", name,
                               SceneLimits::kDrawingPixels, width, height));
}

}  // namespace

std::string_view pictureKind(std::string_view bytes) {
  for (const Format& format : kFormats) {
    if (!bytes.starts_with(format.start) || bytes.size() < format.at) continue;
    if (bytes.substr(format.at).starts_with(format.later)) return format.name;
  }
  return {};
}

Image decodePng(const std::string& bytes, const std::string& name) {
  static_assert(sizeof(Image::Pixel) == 4, "libpng writes four bytes per pixel");
  checkWhole(bytes, name);
  checkSize(bytes, name);
  if (hasPalette(bytes)) PngReader(bytes, name).checkPalette();
  return PngReader(bytes, name).readPixels();
}

}  // namespace merge2d
