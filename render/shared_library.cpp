#include "render/shared_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "src2d/core/error.h"

namespace merge2d {

SharedLibrary::SharedLibrary(std::initializer_list<const char*> files) {
  std::string reason;
  for (const char* file : files) {
    handle_ = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    file_ = file;
    if (handle_) return;
    if (reason.empty()) reason = dlerror();
  }
  throw IoError(fmt::format("cannot load {}", reason));
}

void* SharedLibrary::symbol(const char* name) const {
  if (void* found = dlsym(handle_, name)) return found;
  throw IoError(fmt::format("{} has no function {}", file_, name));
}

}  // namespace merge2d
