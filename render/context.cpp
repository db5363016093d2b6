#include "render/context.h"  // first: its OpenGL header must come before OSMesa's

#include <GL/osmesa.h>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <mutex>

#include "src2d/core/error.h"

#ifdef __SANITIZE_ADDRESS__
// OSMesa keeps a few bytes of each context when it is destroyed.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa.so"; }
#endif

namespace merge2d {
namespace {

constexpr int kSide = 16;  // of the default framebuffer [px]

/// OSMesa sets itself up when the first context is made, and does not say that it may be called by
/// several threads then. What makes, switches or destroys contexts takes turns.
std::mutex& turn() {
  static std::mutex mutex;
  return mutex;
}

/// One context per thread draws faster than one context with many threads, so the driver is told
/// to make none of its own. It reads the variable when the first context is created.
void keepDriverSingleThreaded() { setenv("LP_NUM_THREADS", "0", 0); }

OSMesaContext createContext() {
  const std::lock_guard lock(turn());
  keepDriverSingleThreaded();
  // clang-format off
  constexpr std::array<int, 11> attributes = {
      OSMESA_FORMAT, OSMESA_RGBA,
      OSMESA_PROFILE, OSMESA_CORE_PROFILE,
      OSMESA_CONTEXT_MAJOR_VERSION, 3,
      OSMESA_CONTEXT_MINOR_VERSION, 3,
      OSMESA_DEPTH_BITS, 0,
      0};
  // clang-format on
  return OSMesaCreateContextAttribs(attributes.data(), nullptr);
}

Gl loadFunctions() {
  Gl gl;
#define MERGE2D_GL_LOAD(TYPE, NAME) \
  gl.NAME = reinterpret_cast<PFN##TYPE##PROC>(OSMesaGetProcAddress("gl" #NAME));
  MERGE2D_GL_FUNCTIONS(MERGE2D_GL_LOAD)
#undef MERGE2D_GL_LOAD
  return gl;
}

/// OSMesa returns an address for any name at all, so the version has to tell what is there.
void requireVersion(const Gl& gl) {
  int major = 0, minor = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (major * 10 + minor < 33) {
    throw IoError(fmt::format("OpenGL 3.3 is needed, but OSMesa has {}.{}", major, minor));
  }
}

}  // namespace

void Context::Release::operator()(void* handle) const {
  const std::lock_guard lock(turn());
  OSMesaDestroyContext(static_cast<OSMesaContext>(handle));
}

Context::Context() : handle_(createContext()), pixels_(4 * kSide * kSide), gl_(loadFunctions()) {
  if (!handle_) throw IoError("cannot create an off-screen OpenGL 3.3 context with OSMesa");
  requireVersion(makeCurrent());
}

const Gl& Context::makeCurrent() {
  auto* context = static_cast<OSMesaContext>(handle_.get());
  if (OSMesaGetCurrentContext() == context) return gl_;
  const std::lock_guard lock(turn());
  if (!OSMesaMakeCurrent(context, pixels_.data(), GL_UNSIGNED_BYTE, kSide, kSide)) {
    throw IoError("cannot make the OSMesa context current");
  }
  return gl_;
}

std::string Context::description() {
  const Gl& gl = makeCurrent();
  const auto text = [&](GLenum what) {
    return std::string(reinterpret_cast<const char*>(gl.GetString(what)));
  };
  return fmt::format("{}, {}", text(GL_VERSION), text(GL_RENDERER));
}

}  // namespace merge2d
