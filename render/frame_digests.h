#pragma once
/// Which frames of a folder are those that were drawn.

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <span>
#include <string>

namespace merge2d {

/// Digests of the files of frames, by number. Several threads may note them.
class FrameDigests {
 public:
  using Map = std::map<std::int64_t, std::string>;  ///< 16 hexadecimal digits each

  FrameDigests() = default;
  explicit FrameDigests(Map known) : known_(std::move(known)) {}

  void note(std::int64_t frame, std::span<const std::uint8_t> bytes);
  /// Whether the file has the very bytes that were noted for this frame.
  bool holds(std::int64_t frame, const std::filesystem::path& file) const;
  Map all() const;

 private:
  mutable std::mutex mutex_;
  Map known_;
};

}  // namespace merge2d
