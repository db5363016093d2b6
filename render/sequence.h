#pragma once
/// A run as numbered pictures, drawn and encoded by several workers.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/frame_digests.h"
#include "render/style.h"

namespace merge2d {

/// "frame_000012.png": of constant width, so that names sort like numbers.
std::string frameName(std::int64_t number, FrameFormat format = FrameFormat::Png);
/// 12, of either format; nothing when it is no frame's name.
std::optional<std::int64_t> frameNumber(std::string_view name);

struct SequenceOptions {
  std::filesystem::path folder;     ///< made when it is missing
  int workers = 2;                  ///< threads, each with a canvas of its own
  bool resume = false;              ///< keep frames that are there with the digests noted
  FrameDigests* digests = nullptr;  ///< of the frames that are written; outlives the writer
};

struct SequenceStats {
  std::int64_t written = 0;     ///< frames
  std::int64_t kept = 0;        ///< frames that were there already
  std::uint64_t bytes = 0;      ///< of the files written
  double draw_seconds = 0.0;    ///< over all workers
  double encode_seconds = 0.0;  ///< over all workers, with writing
};

/// Takes the snapshots of a run in order and writes a frame for each. The bytes of a frame do not
/// depend on the number of workers: colours are decided here, in order.
class SequenceWriter {
 public:
  /// `bodies` must outlive the writer. Throws IoError.
  SequenceWriter(const std::vector<BodyInfo>& bodies, FrameStyle style, SequenceOptions options);
  /// Ends the workers; frames that wait are dropped unless `finish` was called.
  ~SequenceWriter();
  SequenceWriter(const SequenceWriter&) = delete;
  SequenceWriter& operator=(const SequenceWriter&) = delete;

  /// Frame number `frames()`. Waits while the queue is full. Throws what a worker threw.
  void add(Snapshot snapshot);
  /// A snapshot that is not drawn, but in which collections may get their colours.
  void skip(const Snapshot& snapshot);
  /// Waits until all frames are written. Throws what a worker threw.
  void finish();

  std::int64_t frames() const;  ///< added so far
  SequenceStats stats() const;  ///< up to now

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace merge2d
