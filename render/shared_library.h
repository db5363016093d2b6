#pragma once
/// Libraries that are loaded when they are first needed.

#include <initializer_list>
#include <string>

namespace merge2d {

/// A shared library that stays loaded until the process ends: drivers leave handlers behind, so
/// that unloading one is not safe.
class SharedLibrary {
 public:
  /// Loads the first of these files that there is. Throws IoError with the loader's reason.
  explicit SharedLibrary(std::initializer_list<const char*> files);

  /// A function of the library. Throws IoError when it is missing.
  template <class Function>
  Function* function(const char* name) const {
    return reinterpret_cast<Function*>(symbol(name));
  }

 private:
  void* symbol(const char* name) const;

  void* handle_ = nullptr;
  std::string file_;
};

}  // namespace merge2d
