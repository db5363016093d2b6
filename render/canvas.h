#pragma once
/// Draws a `Drawing` into a picture, off screen.

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "render/drawing.h"
#include "render/picture.h"
#include "render/text.h"

namespace merge2d {

class Context;
struct Gl;

/// A picture-sized framebuffer with the three programs that draw on it. Belongs to one thread at a
/// time; each thread that draws has a canvas of its own.
class Canvas {
 public:
  static constexpr int kMaxSide = 8192;  ///< [px]

  /// Throws IoError when there is no OpenGL, no font, or the size is out of range.
  Canvas(int width, int height);
  ~Canvas();
  Canvas(Canvas&&) noexcept;
  Canvas& operator=(Canvas&&) noexcept;

  int width() const { return width_; }
  int height() const { return height_; }
  /// Sets the text of the drawings for this canvas: it owns their glyphs.
  Text& text() { return text_; }
  /// The name of the renderer: "4.5 (Core Profile) Mesa 22.3.6, llvmpipe (…)".
  std::string description();

  Picture draw(const Drawing& drawing) {
    Picture picture;
    draw(drawing, picture);
    return picture;
  }
  /// The same into a picture of any size, whose memory is used again.
  void draw(const Drawing& drawing, Picture& picture);

 private:
  enum Kind : std::size_t { Shapes, Arrows, Glyphs, kKinds };

  void makeTarget();
  void makePrograms();
  void describeInstances();
  void uploadEdges(const std::vector<Edge>& edges);
  void uploadAtlas();
  void drawLayer(const Layer& layer);
  template <class Instance>
  void drawInstances(Kind kind, const std::vector<Instance>& instances);
  void read(Picture& picture, bool opaque);

  int width_, height_;
  std::unique_ptr<Context> context_;
  const Gl* gl_;
  Text text_;
  std::uint64_t atlas_version_ = 0;
  std::array<unsigned, kKinds> programs_{}, arrays_{}, buffers_{};
  unsigned edge_buffer_ = 0, edge_texture_ = 0, atlas_texture_ = 0;
};

}  // namespace merge2d
