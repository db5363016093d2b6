#include "src2d/scene/image.h"

#include <fmt/format.h>
#include <png.h>

#include <array>

#include "src2d/core/error.h"
#include "src2d/scene/scene.h"

namespace merge2d {
namespace {

/// libpng's simplified interface, freed at the end; it never leaves by longjmp or exit.
class PngReader {
 public:
  explicit PngReader(const std::string& name) : name_(name) { image_.version = PNG_IMAGE_VERSION; }
  ~PngReader() { png_image_free(&image_); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  void readHeader(const std::string& bytes) {
    if (png_image_begin_read_from_memory(&image_, bytes.data(), bytes.size()) == 0) fail();
    // As with 8 bits, where no chunk says otherwise; libpng would take 16 for linear light.
    image_.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  }

  Image readPixels() {
    image_.format = PNG_FORMAT_RGBA;
    Image result{static_cast<int>(image_.width), static_cast<int>(image_.height), {}};
    result.pixels.resize(std::size_t{image_.width} * image_.height);
    if (png_image_finish_read(&image_, nullptr, result.pixels.data(), 0, nullptr) == 0) fail();
    return result;
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError(fmt::format("{}: not a whole PNG picture ({})", name_, image_.message));
  }

  const std::string& name_;
  png_image image_{};
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

/// What libpng would say in words of its own, or not at all.
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

/// What the header of a whole PNG claims, before anybody believes it.
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
  PngReader reader(name);
  reader.readHeader(bytes);
  return reader.readPixels();
}

}  // namespace merge2d
