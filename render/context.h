#pragma once
/// An off-screen OpenGL 3.3 core context in software.

#include <memory>
#include <optional>
#include <string>

#include "render/context_backend.h"
#include "render/gl.h"

namespace merge2d {

/// The library a context comes from; both are loaded when the first context is made.
enum class ContextKind { Osmesa, Egl };

/// Decides where all later contexts of the process come from. Without a choice, OSMesa where it is
/// installed, and else EGL. Both draw the same pixels with the same driver.
void chooseContext(std::optional<ContextKind> kind);
/// The choice; nothing when none was made.
std::optional<ContextKind> chosenContext();

/// Owns a context and its function table. A context is current on one thread at a time: draw on
/// the thread that last called `makeCurrent`.
class Context {
 public:
  /// Creates a context and makes it current. Throws IoError when there is none to be had.
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Makes the context current on this thread and returns its functions.
  const Gl& makeCurrent();
  /// Library and driver: "OSMesa, 4.5 (Core Profile) Mesa 22.3.6, llvmpipe (…)".
  std::string description();

 private:
  std::optional<ContextKind> kind_;
  std::unique_ptr<ContextBackend> backend_;
  Gl gl_;
};

}  // namespace merge2d
