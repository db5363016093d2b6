#include "app/progress.h"

#include <algorithm>

namespace merge2d {
namespace {

constexpr std::chrono::milliseconds kInterval{100};
constexpr std::int64_t kWidth = 30;  // characters of the bar

std::string clockText(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

Progress::Progress(const Console& console, std::string unit, std::int64_t total)
    : shown_(watchedTerminal() && !console.quiet()),
      unit_(std::move(unit)),
      total_(std::max<std::int64_t>(total, 1)) {}

Progress::~Progress() {
  if (shown_) sayRaw("\r\033[K");
}

void Progress::update(std::int64_t done) {
  const Clock::time_point now = Clock::now();
  if (!shown_ || now < next_) return;
  next_ = now + kInterval;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double fraction = static_cast<double>(done) / static_cast<double>(total_);
  const std::int64_t filled = std::min(kWidth, kWidth * done / total_);
  std::string line = fmt::format("\r{0:#<{1}}{0:.<{2}} {3} {4} of {5}", "", filled, kWidth - filled,
                                 unit_, done, total_);
  if (done > 0) line += fmt::format(", {} left", clockText(elapsed * (1.0 / fraction - 1.0)));
  sayRaw(line + "\033[K");
}

}  // namespace merge2d
