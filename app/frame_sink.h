#pragma once
/// Where the frames of a rendering go.

#include <filesystem>
#include <memory>

#include "app/film.h"
#include "render/frame_digests.h"
#include "render/style.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

struct FrameCounts {
  std::int64_t written = 0;
  std::int64_t kept = 0;  ///< were there already
};

/// Takes the states of all frames of a run in order, and draws those that are wanted.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// A state between two frames in which collections were made: it decides on their colours.
  virtual void note(const Snapshot& snapshot) = 0;
  virtual void add(std::int64_t frame, const Snapshot& snapshot) = 0;
  /// All frames are there. Throws what went wrong.
  virtual void finish() = 0;
  virtual FrameCounts counts() const = 0;
};

/// Notes the digests of what it writes; with `resume`, frames that are there with the digests noted
/// are kept. `bodies` and `digests` must outlive the sink.
std::unique_ptr<FrameSink> makeFrameSink(const std::vector<BodyInfo>& bodies,
                                         const FrameStyle& style,
                                         const std::filesystem::path& folder, const Film& film,
                                         FrameDigests& digests, bool resume);

}  // namespace merge2d
