#include "src2d/scene/image.h"

#include <fmt/format.h>
#include <png.h>

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
    const auto pixels = static_cast<std::uint64_t>(image_.width) * image_.height;
    if (pixels > SceneLimits::kDrawingPixels) {
      throw InputError(fmt::format("{}: a drawing has at most {} pixels, this one has {} x {}",
                                   name_, SceneLimits::kDrawingPixels, image_.width,
                                   image_.height));
    }
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

/// libpng is content once it has all pixels; a file that was cut off behind them is still not
/// whole.
bool endsAsPng(std::string_view bytes) {
  std::size_t at = 8;  // behind the signature, chunks: length, type, data, checksum
  while (bytes.size() >= at + 12) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      length = 256 * length + static_cast<unsigned char>(bytes[at + i]);
    }
    if (bytes.substr(at + 4, 4) == "IEND") return true;
    at += 12 + length;
  }
  return false;
}

}  // namespace

Image decodePng(const std::string& bytes, const std::string& name) {
  static_assert(sizeof(Image::Pixel) == 4, "libpng writes four bytes per pixel");
  PngReader reader(name);
  reader.readHeader(bytes);
  if (!endsAsPng(bytes)) {
    throw InputError(fmt::format("{}: not a whole PNG picture (its end is missing)", name));
  }
  return reader.readPixels();
}

}  // namespace merge2d
