#include "render/text.h"

#include <fmt/format.h>
#include <ft2build.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "src2d/core/error.h"
#include FT_FREETYPE_H

namespace merge2d {
namespace {

/// The next code point; bytes that are not UTF-8 become U+FFFD one by one.
char32_t nextCode(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(at++);
  if (lead < 0x80) return lead;
  const int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : -1;
  if (more < 0 || at + static_cast<std::size_t>(more) > text.size()) return 0xfffd;
  char32_t code = lead & (0x3f >> more);
  for (int i = 0; i < more; ++i) {
    if ((byte(at) & 0xc0) != 0x80) return 0xfffd;
    code = code << 6 | (byte(at++) & 0x3f);
  }
  return code;
}

float fromFixed(FT_Pos x) { return static_cast<float>(x) / 64.0F; }

}  // namespace

std::filesystem::path fontFile(Weight weight) {
  const std::string name = weight == Weight::Bold ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf";
  std::vector<std::filesystem::path> folders = {
      "/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/TTF", "/usr/share/fonts/dejavu",
      "/usr/share/fonts/dejavu-sans-fonts", "/usr/local/share/fonts/dejavu"};
  if (const char* own = std::getenv("MERGE2D_FONTS")) folders.insert(folders.begin(), own);
  for (const auto& folder : folders) {
    if (std::filesystem::exists(folder / name)) return folder / name;
  }
  throw IoError(fmt::format(
      "font {} not found: install fonts-dejavu-core, or name its folder in MERGE2D_FONTS", name));
}

struct Text::Faces {
  FT_Library library = nullptr;
  std::array<FT_Face, 2> face{};

  Faces() {
    if (FT_Init_FreeType(&library) != 0) throw IoError("cannot start FreeType");
    for (const Weight weight : {Weight::Regular, Weight::Bold}) {
      const std::string file = fontFile(weight).string();
      if (FT_New_Face(library, file.c_str(), 0, &face[static_cast<std::size_t>(weight)]) != 0) {
        FT_Done_FreeType(library);
        throw IoError(fmt::format("{}: not a font", file));
      }
    }
  }
  ~Faces() { FT_Done_FreeType(library); }  // and its faces
  Faces(const Faces&) = delete;
  Faces& operator=(const Faces&) = delete;

  FT_Face sized(Font font) const {
    FT_Face f = face[static_cast<std::size_t>(font.weight)];
    FT_Set_Pixel_Sizes(f, 0, static_cast<FT_UInt>(font.size));
    return f;
  }
};

Text::Text() = default;
Text::~Text() = default;
Text::Text(Text&&) noexcept = default;
Text& Text::operator=(Text&&) noexcept = default;

float Text::width(std::string_view text, Font font) {
  float pen = 0.0F;
  for (std::size_t at = 0; at < text.size();) pen += glyph(nextCode(text, at), font).advance;
  return pen;
}

float Text::capHeight(Font font) const {
  // DejaVu Sans: 1493 of 2048 units per em.
  return std::round(0.729F * static_cast<float>(font.size));
}

void Text::set(std::vector<GlyphInstance>& out, std::string_view text, Font font, float x,
               float baseline, Color color) {
  float pen = std::round(x);
  const int base = static_cast<int>(std::lround(baseline));
  for (std::size_t at = 0; at < text.size();) {
    const Glyph& g = glyph(nextCode(text, at), font);
    if (g.width > 0) {
      const int left = static_cast<int>(std::lround(pen)) + g.left;
      const auto s = [](int i) { return static_cast<std::int16_t>(i); };
      out.push_back({s(left), s(base - g.top), s(g.width), s(g.height), s(g.u), s(g.v), color});
    }
    pen += g.advance;
  }
}

std::string Text::elided(std::string_view text, Font font, float width) {
  if (this->width(text, font) <= width) return std::string(text);
  float pen = glyph(U'…', font).advance;
  std::size_t end = 0;
  for (std::size_t at = 0; at < text.size(); end = at) {
    pen += glyph(nextCode(text, at), font).advance;
    if (pen > width) break;
  }
  return end == 0 ? std::string() : std::string(text.substr(0, end)) + "…";
}

const Text::Glyph& Text::glyph(char32_t code, Font font) {
  const Key key{font.size, font.weight, code};
  const auto found = glyphs_.find(key);
  return found != glyphs_.end() ? found->second
                                : glyphs_.emplace(key, rasterise(code, font)).first->second;
}

Text::Glyph Text::rasterise(char32_t code, Font font) {
  if (!faces_) faces_ = std::make_unique<Faces>();  // not needed by drawings without text
  FT_Face face = faces_->sized(font);
  Glyph g;
  if (FT_Load_Char(face, code, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0) return g;
  const FT_GlyphSlot slot = face->glyph;
  g.width = static_cast<int>(slot->bitmap.width);
  g.height = static_cast<int>(slot->bitmap.rows);
  g.left = slot->bitmap_left;
  g.top = slot->bitmap_top;
  g.advance = fromFixed(slot->advance.x);
  place(g);
  for (int row = 0; row < g.height; ++row) {
    const auto* from = slot->bitmap.buffer + std::ptrdiff_t{row} * slot->bitmap.pitch;
    std::copy_n(from, g.width,
                atlas_.coverage.begin() + std::ptrdiff_t{g.v + row} * GlyphAtlas::kWidth + g.u);
  }
  ++atlas_.version;
  return g;
}

/// Finds room on the current shelf, or starts a new one below it.
void Text::place(Glyph& glyph) {
  constexpr int kApart = 1;  // [px]
  if (shelf_x_ + glyph.width > GlyphAtlas::kWidth) {
    shelf_y_ += shelf_height_ + kApart;
    shelf_x_ = shelf_height_ = 0;
  }
  glyph.u = shelf_x_;
  glyph.v = shelf_y_;
  shelf_x_ += glyph.width + kApart;
  shelf_height_ = std::max(shelf_height_, glyph.height);
  if (shelf_y_ + shelf_height_ > atlas_.height) {
    atlas_.height = std::max(shelf_y_ + shelf_height_, atlas_.height + 128);
    atlas_.coverage.resize(static_cast<std::size_t>(atlas_.height) * GlyphAtlas::kWidth);
  }
}

}  // namespace merge2d
