#pragma once
/// The libraries a context comes from, behind one small interface. Internal to the renderer.

#include <memory>

namespace merge2d {

/// One OpenGL 3.3 core context of one library; the destructor destroys it.
class ContextBackend {
 public:
  virtual ~ContextBackend() = default;
  /// Whether the context is the current one of this thread.
  virtual bool isCurrent() const = 0;
  /// Makes the context the current one of this thread. Throws IoError.
  virtual void makeCurrent() = 0;
  /// The address of an OpenGL function, such as "glClear".
  virtual void* function(const char* name) const = 0;
};

/// Mesa's OSMesa, which draws to main memory (Mesa 25.1 removed it). Throws IoError when it cannot
/// be loaded or has no OpenGL 3.3.
std::unique_ptr<ContextBackend> makeOsmesaContext();

/// EGL without a window system, on Mesa's software device: pixels do not depend on a graphics card.
/// Throws IoError when it cannot be loaded or has no such device.
std::unique_ptr<ContextBackend> makeEglContext();

}  // namespace merge2d
