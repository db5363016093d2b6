#pragma once
/// How far a long command is, on terminals only.

#include <chrono>
#include <cstdint>
#include <string>

#include "app/console.h"

namespace merge2d {

/// One line on stderr that is written over and over, and gone at the end. Where nobody watches
/// (no terminal, CI, --quiet) it does nothing.
class Progress {
 public:
  /// `unit` is what is counted: "step", "frame".
  Progress(const Console& console, std::string unit, std::int64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::int64_t done);

 private:
  using Clock = std::chrono::steady_clock;

  bool shown_;
  std::string unit_;
  std::int64_t total_;
  Clock::time_point start_ = Clock::now(), next_ = start_;
};

}  // namespace merge2d
