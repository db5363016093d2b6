#pragma once
/// An off-screen OpenGL 3.3 core context, and the one place that knows where it comes from
/// (OSMesa).

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/gl.h"

namespace merge2d {

/// Owns a context and its function table. A context is current on one thread at a time: draw on
/// the thread that last called `makeCurrent`.
class Context {
 public:
  /// Creates a context and makes it current. Throws IoError when there is none to be had.
  Context();

  /// Makes the context current on this thread and returns its functions.
  const Gl& makeCurrent();
  /// What the driver calls itself: "4.5 (Core Profile) Mesa 22.3.6, llvmpipe (…)".
  std::string description();

 private:
  struct Release {
    void operator()(void* handle) const;
  };
  std::unique_ptr<void, Release> handle_;
  std::vector<std::uint8_t> pixels_;  ///< of the default framebuffer, which nobody draws to
  Gl gl_;
};

}  // namespace merge2d
