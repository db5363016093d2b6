#include "app/frame_sink.h"

#include <algorithm>
#include <thread>

#include "render/frame_encoder.h"
#include "render/sequence.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

/// Frames from the first one on: drawn by as many threads as there are processors.
class ParallelSink : public FrameSink {
 public:
  ParallelSink(const std::vector<BodyInfo>& bodies, const FrameStyle& style, const fs::path& folder,
               FrameDigests& digests, bool resume)
      : writer_(bodies, style,
                {.folder = folder, .workers = workers(), .resume = resume, .digests = &digests}) {}

  void note(const Snapshot& snapshot) override { writer_.skip(snapshot); }
  void add(std::int64_t, const Snapshot& snapshot) override { writer_.add(snapshot); }
  void finish() override { writer_.finish(); }
  FrameCounts counts() const override {
    const SequenceStats stats = writer_.stats();
    return {stats.written, stats.kept};
  }

 private:
  static int workers() {
    return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 16U));
  }

  SequenceWriter writer_;
};

/// Frames from somewhere in the middle: what comes before decides on the colours.
class PartialSink : public FrameSink {
 public:
  PartialSink(const std::vector<BodyInfo>& bodies, const FrameStyle& style, fs::path folder,
              std::int64_t from, FrameDigests& digests, bool resume)
      : bodies_(bodies),
        style_(style),
        looks_(bodies),
        encoder_(bodies_, looks_, style_),
        folder_(std::move(folder)),
        from_(from),
        digests_(digests),
        resume_(resume) {}

  void note(const Snapshot& snapshot) override { colors_.update(snapshot); }
  void add(std::int64_t frame, const Snapshot& snapshot) override {
    const CollectionSlots slots = colors_.update(snapshot);
    if (frame < from_) return;
    const fs::path file = folder_ / frameName(frame, style_.format);
    if (resume_ && digests_.holds(frame, file)) {
      ++counts_.kept;
      return;
    }
    encoder_.draw(snapshot, slots);
    const auto bytes = encoder_.encode();
    constexpr bool kDurable = false;  // a damaged one is drawn again
    writeAtomically(file, bytes, kDurable);
    digests_.note(frame, bytes);
    ++counts_.written;
  }

  void finish() override {}
  FrameCounts counts() const override { return counts_; }

 private:
  const std::vector<BodyInfo>& bodies_;
  FrameStyle style_;
  BodyLooks looks_;
  CollectionColors colors_;
  FrameEncoder encoder_;
  fs::path folder_;
  std::int64_t from_;
  FrameDigests& digests_;
  bool resume_;
  FrameCounts counts_;
};

}  // namespace

std::unique_ptr<FrameSink> makeFrameSink(const std::vector<BodyInfo>& bodies,
                                         const FrameStyle& style, const fs::path& folder,
                                         const Film& film, FrameDigests& digests, bool resume) {
  if (film.from == 0) return std::make_unique<ParallelSink>(bodies, style, folder, digests, resume);
  return std::make_unique<PartialSink>(bodies, style, folder, film.from, digests, resume);
}

}  // namespace merge2d
