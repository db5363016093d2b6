#include "app/progress.h"

#include <algorithm>

namespace merge2d {
namespace {

constexpr std::chrono::milliseconds kOnTerminal{100}, kInLog{10'000};
constexpr std::int64_t kWidth = 30;  // characters of the bar

std::string clockText(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

Progress::Progress(const Console& console, std::string unit, std::int64_t total)
    : quiet_(console.quiet()),
      terminal_(watchedTerminal()),
      unit_(std::move(unit)),
      total_(std::max<std::int64_t>(total, 1)) {
  next_ += terminal_ ? std::chrono::milliseconds(0) : kInLog;
}

Progress::~Progress() {
  if (terminal_ && !quiet_) sayRaw("\r\033[K");
}

void Progress::update(std::int64_t done) {
  const Clock::time_point now = Clock::now();
  if (quiet_ || now < next_) return;
  next_ = now + (terminal_ ? kOnTerminal : kInLog);
  if (!terminal_) return sayRaw(text(done, now) + "\n");
  const std::int64_t filled = std::min(kWidth, kWidth * done / total_);
  sayRaw(
      fmt::format("\r{0:#<{1}}{0:.<{2}} {3}\033[K", "", filled, kWidth - filled, text(done, now)));
}

/// "step 900 of 45000, 0:41 left"
std::string Progress::text(std::int64_t done, Clock::time_point now) const {
  std::string line = fmt::format("{} {} of {}", unit_, done, total_);
  if (done == 0) return line;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double fraction = static_cast<double>(done) / static_cast<double>(total_);
  return line + fmt::format(", {} left", clockText(elapsed * (1.0 / fraction - 1.0)));
}

}  // namespace merge2d
