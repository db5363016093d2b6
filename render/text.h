#pragma once
/// Text in DejaVu Sans, rasterised by FreeType into one atlas.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "render/drawing.h"

namespace merge2d {

enum class Weight { Regular, Bold };

struct Font {
  int size = 13;  ///< [px] per em
  Weight weight = Weight::Regular;
};

/// Coverage of all glyphs seen so far; grows downwards, so places stay valid.
struct GlyphAtlas {
  static constexpr int kWidth = 1024;  ///< [px]
  int height = 0;                      ///< [px]
  std::vector<std::uint8_t> coverage;
  std::uint64_t version = 0;  ///< changes with the contents
};

/// Where the font of a weight was found; throws IoError when it was not.
std::filesystem::path fontFile(Weight weight);

/// Measures and sets lines of UTF-8 text. Not for several threads at once.
class Text {
 public:
  Text();
  ~Text();
  Text(Text&&) noexcept;
  Text& operator=(Text&&) noexcept;

  /// The advance of a line [px].
  float width(std::string_view text, Font font);
  /// Height of capital letters [px].
  float capHeight(Font font) const;

  /// Sets a line with its start at (x, baseline), both rounded to whole pixels.
  void set(std::vector<GlyphInstance>& out, std::string_view text, Font font, float x,
           float baseline, Color color);

  /// The text, or its beginning and "…" where it is wider than `width` [px].
  std::string elided(std::string_view text, Font font, float width);

  const GlyphAtlas& atlas() const { return atlas_; }

 private:
  struct Glyph {
    int u = 0, v = 0, width = 0, height = 0;
    int left = 0, top = 0;  ///< of the bitmap from the pen [px], up positive
    float advance = 0.0F;   ///< [px]
  };
  struct Faces;
  using Key = std::tuple<int, Weight, char32_t>;

  const Glyph& glyph(char32_t code, Font font);
  Glyph rasterise(char32_t code, Font font);
  void place(Glyph& glyph);

  std::unique_ptr<Faces> faces_;
  std::map<Key, Glyph> glyphs_;
  GlyphAtlas atlas_;
  int shelf_x_ = 0, shelf_y_ = 0, shelf_height_ = 0;  ///< where the next glyph goes
};

}  // namespace merge2d
