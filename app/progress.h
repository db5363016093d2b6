#pragma once
/// How far a long command is.

#include <chrono>
#include <cstdint>
#include <string>

#include "app/console.h"

namespace merge2d {

/// On a terminal one line on stderr that is written over and over, and gone at the end. In a log a
/// line every ten seconds, so that whoever reads it later knows how far the command came. With
/// --quiet nothing.
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

  std::string text(std::int64_t done, Clock::time_point now) const;

  bool quiet_;
  bool terminal_;
  std::string unit_;
  std::int64_t total_;
  Clock::time_point start_ = Clock::now(), next_ = start_;
};

}  // namespace merge2d
