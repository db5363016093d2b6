#pragma once
/// Which state of the sources the program was made from.

namespace merge2d {

/// The answer of `git describe --always --dirty --tags` when the program was built; empty where it
/// was built without a repository. Defined in a source that the build writes (cmake/version.cmake).
extern const char* const kGitDescribe;

}  // namespace merge2d
