#include "render/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <mutex>
#include <string_view>

#include "render/headroom.h"
#include "src2d/core/error.h"
#include "src2d/core/suggest.h"

namespace merge2d {
namespace {

constexpr std::array<const char*, 2> kTitles{"OSMesa", "EGL"};  // as in ContextKind
constexpr std::array<std::string_view, 2> kDrivers{"llvmpipe", "softpipe"};

std::optional<ContextKind>& choice() {
  static std::optional<ContextKind> kind;
  return kind;
}

/// Mesa sets itself up when the first context is made, and does not say that it may be called by
/// several threads then. What makes, switches or destroys contexts takes turns.
std::mutex& turn() {
  static std::mutex mutex;
  return mutex;
}

/// One context per thread draws faster than one context with many threads, so the driver is told
/// to make none of its own. It reads the variable when the first context is created.
void keepDriverSingleThreaded() { setenv("LP_NUM_THREADS", "0", 0); }

/// With a driver that it does not know, OSMesa 22.3 ends the process by a null pointer.
void requireKnownDriver() {
  const char* driver = std::getenv("GALLIUM_DRIVER");
  if (!driver || std::ranges::find(kDrivers, driver) != kDrivers.end()) return;
  throw IoError(
      fmt::format("GALLIUM_DRIVER is '{}', but Mesa's software drivers are {}{}; unset it", driver,
                  fmt::join(kDrivers, " and "), didYouMean(driver, kDrivers)));
}

std::unique_ptr<ContextBackend> make(ContextKind kind) {
  return kind == ContextKind::Osmesa ? makeOsmesaContext() : makeEglContext();
}

/// A context of the kind that was chosen, or of the first that there is; says which.
std::unique_ptr<ContextBackend> makeChosen(std::optional<ContextKind>& kind) {
  kind = choice();
  if (kind) return make(*kind);
  std::string reason;
  try {
    kind = ContextKind::Osmesa;
    return make(*kind);
  } catch (const IoError& error) {
    reason = error.what();
  }
  try {
    kind = ContextKind::Egl;
    return make(*kind);
  } catch (const IoError& error) {
    throw IoError(fmt::format(
        "no OpenGL in software: {}; {} (install libosmesa6, or libegl1 and libegl-mesa0)", reason,
        error.what()));
  }
}

Gl loadFunctions(const ContextBackend& backend) {
  Gl gl;
#define MERGE2D_GL_LOAD(TYPE, NAME) \
  gl.NAME = reinterpret_cast<PFN##TYPE##PROC>(backend.function("gl" #NAME));
  MERGE2D_GL_FUNCTIONS(MERGE2D_GL_LOAD)
#undef MERGE2D_GL_LOAD
  return gl;
}

/// A context needs some memory, and before the first one come the libraries: Mesa, and LLVM below
/// it.
void requireMemoryForContext() {
  constexpr std::size_t kLibraries = 320u << 20, kContext = 96u << 20;
  static bool loaded = false;  // on one thread at a time
  requireHeadroom(loaded ? kContext : kLibraries);
  loaded = true;
}

/// Both libraries return an address for any name at all, so the version has to tell what is there.
void requireVersion(const Gl& gl) {
  int major = 0, minor = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (major * 10 + minor < 33) {
    throw IoError(fmt::format("OpenGL 3.3 is needed, but the driver has {}.{}", major, minor));
  }
}

}  // namespace

void chooseContext(std::optional<ContextKind> kind) { choice() = kind; }

std::optional<ContextKind> chosenContext() { return choice(); }

Context::Context() {
  const std::lock_guard lock(turn());
  keepDriverSingleThreaded();
  requireKnownDriver();
  requireMemoryForContext();
  backend_ = makeChosen(kind_);
  backend_->makeCurrent();
  gl_ = loadFunctions(*backend_);
  requireVersion(gl_);
}

Context::~Context() {
  const std::lock_guard lock(turn());
  backend_.reset();
}

const Gl& Context::makeCurrent() {
  if (backend_->isCurrent()) return gl_;
  const std::lock_guard lock(turn());
  backend_->makeCurrent();
  return gl_;
}

std::string Context::description() {
  const Gl& gl = makeCurrent();
  const auto text = [&](GLenum what) {
    return std::string(reinterpret_cast<const char*>(gl.GetString(what)));
  };
  return fmt::format("{}, {}, {}", kTitles[static_cast<std::size_t>(*kind_)], text(GL_VERSION),
                     text(GL_RENDERER));
}

}  // namespace merge2d
