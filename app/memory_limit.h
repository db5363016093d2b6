#pragma once
/// Bounds the memory of the program, so that a scene that needs too much ends with a sentence and
/// not by the system, which would kill it or other programs beside it.

#include <cstddef>
#include <new>
#include <string>

namespace merge2d {

/// An allocation would have gone beyond the limit.
class MemoryLimitReached : public std::bad_alloc {
 public:
  const char* what() const noexcept override;
};

/// Blocks of memory are refused from now on where all of them together would exceed so many bytes.
/// Only allocations by C++ code count: nearly all that a simulation needs.
void limitMemory(std::size_t bytes);
/// 75% of the memory of the machine, or of the container that the program runs in [bytes].
std::size_t defaultMemoryLimit();
/// The limit in force, such as "17.6 GB".
std::string memoryLimitText();

/// "500MB", "2GB", "1.5G" or "50%" of the machine's memory as bytes. Throws UsageError.
std::size_t readMemory(const std::string& option, const std::string& text);

}  // namespace merge2d
