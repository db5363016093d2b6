#pragma once
/// Where the tests were built. Asked when they run, so that their sources compile to the same in
/// every build, and are compiled once.

#include <filesystem>

namespace merge2d {

/// The folder of the build: a test's program lies in its folder tests/.
inline std::filesystem::path buildDir() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
}

}  // namespace merge2d
