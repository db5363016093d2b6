#include "app/memory_limit.h"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string_view>

#include "app/usage_error.h"

namespace {

std::atomic<std::size_t> held_bytes{0};
std::atomic<std::size_t> most_bytes{std::numeric_limits<std::size_t>::max()};

/// Small blocks have some room beyond the limit: a message needs them, and so do libraries that
/// do not survive a refusal, as the compiler inside the OpenGL driver. Memory that grows without
/// bound is requested in large ones.
bool isBeyondLimit(std::size_t size) {
  constexpr std::size_t kLarge = 64u << 10, kRoom = 64u << 20;
  const std::size_t most = most_bytes.load(std::memory_order_relaxed);
  const std::size_t held = held_bytes.load(std::memory_order_relaxed);
  if (size >= kLarge) return size > most || held > most - size;
  return held > most && held - most > most / 8 + kRoom;
}

}  // namespace

namespace {

/// A block of the size, or an exception; `allocate` asks the system for it.
template <class Allocate>
void* counted(std::size_t size, const Allocate& allocate) {
  if (isBeyondLimit(size)) throw merge2d::MemoryLimitReached();
  void* block = allocate();
  if (block == nullptr) throw std::bad_alloc();
  held_bytes.fetch_add(malloc_usable_size(block), std::memory_order_relaxed);
  return block;
}

}  // namespace

// All of them, as some runtimes do not make one of the other.

void* operator new(std::size_t size) {
  return counted(size, [size] { return std::malloc(std::max<std::size_t>(size, 1)); });
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  const std::size_t units = std::max<std::size_t>(1, size / unit + (size % unit != 0 ? 1 : 0));
  return counted(size, [=] { return std::aligned_alloc(unit, units * unit); });
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return operator new(size, alignment);
}
void* operator new[](std::size_t size, const std::nothrow_t& nothrow) noexcept {
  return operator new(size, nothrow);
}

void operator delete(void* block) noexcept {
  held_bytes.fetch_sub(malloc_usable_size(block), std::memory_order_relaxed);
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept { operator delete(block); }
void operator delete(void* block, std::align_val_t) noexcept { operator delete(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  operator delete(block);
}
void operator delete(void* block, const std::nothrow_t&) noexcept { operator delete(block); }
void operator delete[](void* block) noexcept { operator delete(block); }
void operator delete[](void* block, std::size_t) noexcept { operator delete(block); }
void operator delete[](void* block, std::align_val_t) noexcept { operator delete(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept {
  operator delete(block);
}
void operator delete[](void* block, const std::nothrow_t&) noexcept { operator delete(block); }

namespace merge2d {
namespace {

std::size_t memoryInstalled() {
  const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || bytes <= 0) return std::numeric_limits<std::size_t>::max();
  return static_cast<std::size_t>(pages) * static_cast<std::size_t>(bytes);
}

/// The memory limit of the control group [bytes], by either version; "max" is no number.
std::size_t memoryOfContainer() {
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const char* file :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::size_t bytes = 0;
    if (std::ifstream(file) >> bytes) least = std::min(least, bytes);
  }
  return least;
}

std::size_t memoryOfMachine() { return std::min(memoryInstalled(), memoryOfContainer()); }

/// Bytes of a unit; 0 for an unknown one.
double bytesOfUnit(std::string_view unit) {
  constexpr std::array<std::string_view, 4> kLetters{"K", "M", "G", "T"};
  if (unit == "%") return 0.01 * static_cast<double>(memoryOfMachine());
  double bytes = 1.0;
  for (const std::string_view letter : kLetters) {
    bytes *= 1e3;
    const bool meant = unit == letter || unit == std::string(letter) + "B";
    if (meant) return bytes;
  }
  return 0.0;
}

}  // namespace

const char* MemoryLimitReached::what() const noexcept { return "the memory limit is reached"; }

void limitMemory(std::size_t bytes) { most_bytes = bytes; }

std::size_t defaultMemoryLimit() { return memoryOfMachine() / 4 * 3; }

std::string memoryLimitText() {
  const auto bytes = static_cast<double>(most_bytes.load());
  return bytes < 1e9 ? fmt::format("{:.3g} MB", 1e-6 * bytes)
                     : fmt::format("{:.3g} GB", 1e-9 * bytes);
}

std::size_t readMemory(const std::string& option, const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  const double bytes = number * bytesOfUnit(unit);
  if (error != std::errc() || !(bytes >= 1.0) || bytes > 1e18) {
    throw UsageError(
        fmt::format("{} must be a size such as 500MB, 2GB or 50%, but is '{}'", option, text));
  }
  return static_cast<std::size_t>(bytes);
}

}  // namespace merge2d
