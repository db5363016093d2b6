#include "render/canvas.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "render/context.h"
#include "render/headroom.h"
#include "render/shaders.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

unsigned compile(const Gl& gl, GLenum type, const char* source) {
  const unsigned shader = gl.CreateShader(type);
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  int ok = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (!ok) {
    std::array<char, 2048> log{};
    gl.GetShaderInfoLog(shader, static_cast<int>(log.size()), nullptr, log.data());
    throw IoError(fmt::format("cannot compile a shader: {}", log.data()));
  }
  return shader;
}

unsigned link(const Gl& gl, const shaders::Source& source) {
  const unsigned program = gl.CreateProgram();
  for (const auto& [type, text] : {std::pair{GL_VERTEX_SHADER, source.vertex},
                                   std::pair{GL_FRAGMENT_SHADER, source.fragment}}) {
    const unsigned shader = compile(gl, static_cast<GLenum>(type), text);
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);
  }
  gl.LinkProgram(program);
  int ok = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &ok);
  if (!ok) {
    std::array<char, 2048> log{};
    gl.GetProgramInfoLog(program, static_cast<int>(log.size()), nullptr, log.data());
    throw IoError(fmt::format("cannot link a shader: {}", log.data()));
  }
  return program;
}

/// One attribute per instance, at `offset` bytes.
struct Attribute {
  int count;
  GLenum type;
  std::size_t offset;
};

template <std::size_t N>
void describe(const Gl& gl, std::size_t stride, const std::array<Attribute, N>& attributes) {
  for (unsigned location = 0; location < N; ++location) {
    const auto& [count, type, offset] = attributes[location];
    const auto* start = reinterpret_cast<const void*>(offset);
    if (type == GL_INT) {
      gl.VertexAttribIPointer(location, count, type, static_cast<int>(stride), start);
    } else {
      const GLboolean normalised = type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE;
      gl.VertexAttribPointer(location, count, type, normalised, static_cast<int>(stride), start);
    }
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribDivisor(location, 1);
  }
}

int checkedSide(int pixels) {
  if (pixels < 1 || pixels > Canvas::kMaxSide) {
    throw IoError(
        fmt::format("a picture of {} pixels: sizes go from 1 to {}", pixels, Canvas::kMaxSide));
  }
  return pixels;
}

/// Undoes the multiplication of colour by alpha.
void unpremultiply(std::vector<std::uint8_t>& rgba) {
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    const unsigned a = rgba[i + 3];
    if (a == 255 || a == 0) continue;
    for (std::size_t c = i; c < i + 3; ++c) {
      rgba[c] = static_cast<std::uint8_t>(std::min(255U, (rgba[c] * 255U + a / 2) / a));
    }
  }
}

}  // namespace

namespace {

/// Memory that the driver may ask for while it draws [bytes]: a target, and code for new shapes.
std::size_t memoryToDraw(int width, int height) {
  constexpr std::size_t kCode = 64u << 20, kPerPixel = 16;
  return kCode + kPerPixel * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

}  // namespace

Canvas::Canvas(int width, int height)
    : width_(checkedSide(width)),
      height_(checkedSide(height)),
      context_(std::make_unique<Context>()),
      gl_(&context_->makeCurrent()) {
  requireHeadroom(memoryToDraw(width_, height_));
  makeTarget();
  makePrograms();
  describeInstances();
}

Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;

std::string Canvas::description() { return context_->description(); }

void Canvas::makeTarget() {
  // The default framebuffer's pixels differ by up to 2/255 between machines; our own do not.
  unsigned target = 0, pixels = 0;
  gl_->GenRenderbuffers(1, &pixels);
  gl_->BindRenderbuffer(GL_RENDERBUFFER, pixels);
  gl_->RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_, height_);
  gl_->GenFramebuffers(1, &target);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, target);
  gl_->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixels);
  if (gl_->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw IoError(fmt::format("cannot make a framebuffer of {}x{} pixels", width_, height_));
  }
  gl_->Viewport(0, 0, width_, height_);
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

void Canvas::makePrograms() {
  const std::array<const shaders::Source*, kKinds> sources = {&shaders::kShape, &shaders::kArrow,
                                                              &shaders::kGlyph};
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    const unsigned program = programs_[kind] = link(*gl_, *sources[kind]);
    gl_->UseProgram(program);
    gl_->Uniform2f(gl_->GetUniformLocation(program, "picture"), static_cast<float>(width_),
                   static_cast<float>(height_));
    const auto sampler = [&](const char* name, int unit) {
      const int location = gl_->GetUniformLocation(program, name);
      if (location >= 0) gl_->Uniform1i(location, unit);
    };
    sampler("polygons", 0);
    sampler("atlas", 1);
  }
}

void Canvas::describeInstances() {
  gl_->GenVertexArrays(kKinds, arrays_.data());
  gl_->GenBuffers(kKinds, buffers_.data());
  const auto select = [&](Kind kind) {
    gl_->BindVertexArray(arrays_[kind]);
    gl_->BindBuffer(GL_ARRAY_BUFFER, buffers_[kind]);
  };
  using S = ShapeInstance;
  select(Shapes);
  describe(*gl_, sizeof(S),
           std::array<Attribute, 7>{{{4, GL_FLOAT, offsetof(S, center)},
                                     {4, GL_FLOAT, offsetof(S, half)},
                                     {4, GL_FLOAT, offsetof(S, hatch)},
                                     {2, GL_INT, offsetof(S, first_edge)},
                                     {4, GL_UNSIGNED_BYTE, offsetof(S, fill)},
                                     {4, GL_UNSIGNED_BYTE, offsetof(S, outline)},
                                     {4, GL_UNSIGNED_BYTE, offsetof(S, hatch_color)}}});
  using A = ArrowInstance;
  select(Arrows);
  describe(*gl_, sizeof(A),
           std::array<Attribute, 4>{{{4, GL_FLOAT, offsetof(A, tail)},
                                     {3, GL_FLOAT, offsetof(A, width)},
                                     {4, GL_UNSIGNED_BYTE, offsetof(A, color)},
                                     {4, GL_UNSIGNED_BYTE, offsetof(A, rim_color)}}});
  using G = GlyphInstance;
  select(Glyphs);
  describe(*gl_, sizeof(G),
           std::array<Attribute, 3>{{{4, GL_SHORT, offsetof(G, x)},
                                     {2, GL_SHORT, offsetof(G, u)},
                                     {4, GL_UNSIGNED_BYTE, offsetof(G, color)}}});

  gl_->GenBuffers(1, &edge_buffer_);
  gl_->GenTextures(1, &edge_texture_);
  gl_->GenTextures(1, &atlas_texture_);
}

void Canvas::draw(const Drawing& drawing, Picture& picture) {
  gl_ = &context_->makeCurrent();
  requireHeadroom(memoryToDraw(width_, height_));
  const Color c = drawing.background;
  const float alpha = static_cast<float>(c.a) / 255.0F;
  const auto channel = [&](std::uint8_t x) { return alpha * static_cast<float>(x) / 255.0F; };
  gl_->Disable(GL_SCISSOR_TEST);
  gl_->ClearColor(channel(c.r), channel(c.g), channel(c.b), alpha);
  gl_->Clear(GL_COLOR_BUFFER_BIT);
  uploadEdges(drawing.edges);
  uploadAtlas();
  for (const Layer& layer : drawing.layers) drawLayer(layer);
  read(picture, drawing.background.a == 255);
}

void Canvas::uploadEdges(const std::vector<Edge>& edges) {
  gl_->BindBuffer(GL_TEXTURE_BUFFER, edge_buffer_);
  gl_->BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(edges.size() * sizeof(Edge)),
                  edges.data(), GL_STREAM_DRAW);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_BUFFER, edge_texture_);
  gl_->TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, edge_buffer_);
}

void Canvas::uploadAtlas() {
  const GlyphAtlas& atlas = text_.atlas();
  gl_->ActiveTexture(GL_TEXTURE1);
  gl_->BindTexture(GL_TEXTURE_2D, atlas_texture_);
  if (atlas_version_ == atlas.version) return;
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_R8, GlyphAtlas::kWidth, atlas.height, 0, GL_RED,
                  GL_UNSIGNED_BYTE, atlas.coverage.data());
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  atlas_version_ = atlas.version;
}

void Canvas::drawLayer(const Layer& layer) {
  if (layer.clip) {
    const auto whole = [](float x) { return static_cast<int>(std::lround(x)); };
    gl_->Enable(GL_SCISSOR_TEST);
    gl_->Scissor(whole(layer.clip->x), whole(layer.clip->y), whole(layer.clip->width),
                 whole(layer.clip->height));
  } else {
    gl_->Disable(GL_SCISSOR_TEST);
  }
  drawInstances(Shapes, layer.shapes);
  drawInstances(Arrows, layer.arrows);
  drawInstances(Glyphs, layer.glyphs);
}

template <class Instance>
void Canvas::drawInstances(Kind kind, const std::vector<Instance>& instances) {
  if (instances.empty()) return;
  gl_->UseProgram(programs_[kind]);
  gl_->BindVertexArray(arrays_[kind]);
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffers_[kind]);
  gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances.size() * sizeof(Instance)),
                  instances.data(), GL_STREAM_DRAW);
  gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instances.size()));
}

void Canvas::read(Picture& picture, bool opaque) {
  picture.width = width_, picture.height = height_;
  picture.rgba.resize(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  gl_->ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
  if (!opaque) unpremultiply(picture.rgba);
  if (const GLenum error = gl_->GetError(); error != GL_NO_ERROR) {
    throw IoError(fmt::format("OpenGL error 0x{:04x} while drawing", error));
  }
}

}  // namespace merge2d
