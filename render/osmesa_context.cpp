/// OSMesa, loaded at run time. Its header left Mesa together with the library: the declarations
/// below are those of GL/osmesa.h that are used here.

#include <array>
#include <vector>

#include "render/context_backend.h"
#include "render/gl.h"
#include "render/shared_library.h"
#include "src2d/core/error.h"

#ifdef __SANITIZE_ADDRESS__
// OSMesa keeps a few bytes of each context when it is destroyed.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa.so\nleak:libEGL\nleak:swrast_dri.so\nleak:libgallium";
}
#endif

namespace merge2d {
namespace {

constexpr int kSide = 16;  // of the default framebuffer, which nobody draws to [px]

enum OsmesaAttribute : int {
  kFormat = 0x22,
  kProfile = 0x33,
  kCoreProfile = 0x34,
  kMajorVersion = 0x36,
  kMinorVersion = 0x37,
  kDepthBits = 0x30,
};

using Handle = struct osmesa_context*;

struct Osmesa {
  SharedLibrary library{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
  Handle (*create)(const int*, Handle) =
      library.function<Handle(const int*, Handle)>("OSMesaCreateContextAttribs");
  void (*destroy)(Handle) = library.function<void(Handle)>("OSMesaDestroyContext");
  GLboolean (*make_current)(Handle, void*, GLenum, GLsizei, GLsizei) =
      library.function<GLboolean(Handle, void*, GLenum, GLsizei, GLsizei)>("OSMesaMakeCurrent");
  Handle (*current)() = library.function<Handle()>("OSMesaGetCurrentContext");
  void* (*function)(const char*) = library.function<void*(const char*)>("OSMesaGetProcAddress");
};

const Osmesa& osmesa() {
  static const Osmesa loaded;
  return loaded;
}

class OsmesaContext final : public ContextBackend {
 public:
  OsmesaContext() : pixels_(4 * kSide * kSide) {
    constexpr std::array<int, 11> attributes = {
        kFormat,    GL_RGBA, kProfile, kCoreProfile, kMajorVersion, 3, kMinorVersion, 3,
        kDepthBits, 0,       0};
    handle_ = osmesa().create(attributes.data(), nullptr);
    if (!handle_) throw IoError("OSMesa cannot create an OpenGL 3.3 context");
  }
  ~OsmesaContext() override { osmesa().destroy(handle_); }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  bool isCurrent() const override { return osmesa().current() == handle_; }

  void makeCurrent() override {
    if (!osmesa().make_current(handle_, pixels_.data(), GL_UNSIGNED_BYTE, kSide, kSide)) {
      throw IoError("cannot make the OSMesa context current");
    }
  }

  void* function(const char* name) const override { return osmesa().function(name); }

 private:
  Handle handle_ = nullptr;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace

std::unique_ptr<ContextBackend> makeOsmesaContext() { return std::make_unique<OsmesaContext>(); }

}  // namespace merge2d
