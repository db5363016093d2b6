/// EGL, loaded at run time, without a window system: the display is Mesa's software device.

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <array>
#include <string_view>

#include "render/context_backend.h"
#include "render/shared_library.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

constexpr int kMostDevices = 64;

struct EglLibrary {
  SharedLibrary library{"libEGL.so.1", "libEGL.so"};
  decltype(&eglGetProcAddress) address =
      library.function<std::remove_pointer_t<decltype(&eglGetProcAddress)>>("eglGetProcAddress");

  /// A function of EGL itself or of an extension; null where it is missing.
  template <class Function>
  Function find(const char* name) const {
    return reinterpret_cast<Function>(address(name));
  }
};

/// Whether a list of words with spaces between them holds a word.
bool lists(const char* words, std::string_view word) {
  std::string_view rest = words ? words : "";
  while (!rest.empty()) {
    const std::size_t space = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, space) == word) return true;
    rest.remove_prefix(std::min(space + 1, rest.size()));
  }
  return false;
}

/// The functions of EGL and the software device's display, which stays until the process ends.
class Egl {
 public:
  Egl() {
    for (const void* function :
         {reinterpret_cast<const void*>(bind_api), reinterpret_cast<const void*>(create_context),
          reinterpret_cast<const void*>(make_current)}) {
      if (!function) throw IoError("libEGL.so.1 lacks functions of EGL 1.5");
    }
    display = initialised(softwareDevice());
  }

  EglLibrary egl;
// NOLINTNEXTLINE(bugprone-macro-parentheses): names cannot stand in parentheses.
#define MERGE2D_EGL(NAME, function) decltype(&NAME) function = egl.find<decltype(&NAME)>(#NAME)
  MERGE2D_EGL(eglGetError, error);
  MERGE2D_EGL(eglInitialize, initialize);
  MERGE2D_EGL(eglBindAPI, bind_api);
  MERGE2D_EGL(eglQueryString, query_string);
  MERGE2D_EGL(eglCreateContext, create_context);
  MERGE2D_EGL(eglDestroyContext, destroy_context);
  MERGE2D_EGL(eglMakeCurrent, make_current);
  MERGE2D_EGL(eglGetCurrentContext, current_context);
#undef MERGE2D_EGL
  EGLDisplay display = EGL_NO_DISPLAY;

 private:
  EGLDeviceEXT softwareDevice() const {
    const auto query_devices = egl.find<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto device_string = egl.find<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    std::array<EGLDeviceEXT, kMostDevices> devices{};
    EGLint count = 0;
    if (!query_devices || !device_string || !query_devices(kMostDevices, devices.data(), &count)) {
      throw IoError("EGL cannot list its devices (EGL_EXT_device_enumeration)");
    }
    for (int i = 0; i < count; ++i) {
      EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
      if (lists(device_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) return device;
    }
    throw IoError(fmt::format("none of EGL's {} devices is Mesa's software device", count));
  }

  EGLDisplay initialised(EGLDeviceEXT device) const {
    const auto platform_display =
        egl.find<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (!platform_display) throw IoError("EGL has no displays of devices (EGL_EXT_platform_base)");
    EGLDisplay found = platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    if (found == EGL_NO_DISPLAY || !initialize(found, nullptr, nullptr)) {
      throw IoError(fmt::format("EGL cannot initialise the software device (error 0x{:04x})",
                                static_cast<unsigned>(error())));
    }
    const char* extensions = query_string(found, EGL_EXTENSIONS);
    for (const char* needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"}) {
      if (!lists(extensions, needed)) throw IoError(fmt::format("EGL lacks {}", needed));
    }
    return found;
  }
};

const Egl& egl() {
  static const Egl loaded;
  return loaded;
}

class EglContext final : public ContextBackend {
 public:
  EglContext() {
    // clang-format off
    constexpr std::array<EGLint, 7> attributes = {
        EGL_CONTEXT_MAJOR_VERSION, 3,
        EGL_CONTEXT_MINOR_VERSION, 3,
        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
        EGL_NONE};
    // clang-format on
    selectOpenGl();
    handle_ =
        egl().create_context(egl().display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (handle_ == EGL_NO_CONTEXT) {
      throw IoError(fmt::format("EGL cannot create an OpenGL 3.3 context (error 0x{:04x})",
                                static_cast<unsigned>(egl().error())));
    }
  }
  ~EglContext() override {
    if (isCurrent()) {
      egl().make_current(egl().display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    egl().destroy_context(egl().display, handle_);
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  bool isCurrent() const override {
    selectOpenGl();
    return egl().current_context() == handle_;
  }

  void makeCurrent() override {
    selectOpenGl();
    if (!egl().make_current(egl().display, EGL_NO_SURFACE, EGL_NO_SURFACE, handle_)) {
      throw IoError("cannot make the EGL context current");
    }
  }

  void* function(const char* name) const override {
    return reinterpret_cast<void*>(egl().egl.address(name));
  }

 private:
  /// Each thread has its own choice between OpenGL and OpenGL ES.
  static void selectOpenGl() {
    if (!egl().bind_api(EGL_OPENGL_API)) throw IoError("EGL has no OpenGL");
  }

  EGLContext handle_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<ContextBackend> makeEglContext() { return std::make_unique<EglContext>(); }

}  // namespace merge2d
