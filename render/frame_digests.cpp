#include "render/frame_digests.h"

#include <fmt/format.h>

#include <system_error>

#include "render/png.h"
#include "src2d/core/digest.h"

namespace merge2d {
namespace {

std::string text(std::span<const std::uint8_t> bytes) {
  return fmt::format("{:016x}",
                     digestOf({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
}

}  // namespace

void FrameDigests::note(std::int64_t frame, std::span<const std::uint8_t> bytes) {
  std::string digest = text(bytes);
  const std::lock_guard lock(mutex_);
  known_[frame] = std::move(digest);
}

bool FrameDigests::holds(std::int64_t frame, const std::filesystem::path& file) const {
  std::string expected;
  {
    const std::lock_guard lock(mutex_);
    const auto noted = known_.find(frame);
    if (noted == known_.end()) return false;
    expected = noted->second;
  }
  std::error_code missing;
  return std::filesystem::is_regular_file(file, missing) && text(readFileBytes(file)) == expected;
}

FrameDigests::Map FrameDigests::all() const {
  const std::lock_guard lock(mutex_);
  return known_;
}

}  // namespace merge2d
