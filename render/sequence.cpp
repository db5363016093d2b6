#include "render/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "render/frame_encoder.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Job {
  Snapshot snapshot;
  CollectionSlots slots;
  std::int64_t frame = 0;
};

/// Jobs on their way to the workers: so many that none waits, so few that memory stays bounded.
class Queue {
 public:
  explicit Queue(std::size_t room) : room_(room) {}

  /// Waits for room. False when the queue is closed.
  bool push(Job job) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return jobs_.size() < room_ || closed_; });
    if (closed_) return false;
    jobs_.push_back(std::move(job));
    changed_.notify_all();
    return true;
  }

  /// Waits for a job. False when there will be none any more.
  bool pop(Job& job) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !jobs_.empty() || closed_; });
    if (jobs_.empty()) return false;
    job = std::move(jobs_.front());
    jobs_.pop_front();
    changed_.notify_all();
    return true;
  }

  /// Nothing more comes in; what waits is worked off or dropped.
  void close(bool drop) {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    if (drop) jobs_.clear();
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  std::size_t room_;
  bool closed_ = false;
};

}  // namespace

std::string frameName(std::int64_t number, FrameFormat format) {
  return fmt::format("frame_{:06}.{}", number, format == FrameFormat::Svg ? "svg" : "png");
}

std::optional<std::int64_t> frameNumber(std::string_view name) {
  constexpr std::size_t kDigits = 6;
  constexpr std::string_view kStart = "frame_", kEnd = ".png", kVectorEnd = ".svg";
  if (name.size() != kStart.size() + kDigits + kEnd.size()) return std::nullopt;
  if (!name.starts_with(kStart)) return std::nullopt;
  if (!name.ends_with(kEnd) && !name.ends_with(kVectorEnd)) return std::nullopt;
  std::int64_t number = 0;
  const std::string_view digits = name.substr(kStart.size(), kDigits);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + kDigits, number);
  const bool whole = error == std::errc() && end == digits.data() + kDigits && number >= 0;
  return whole ? std::optional(number) : std::nullopt;
}

struct SequenceWriter::Impl {
  Impl(const std::vector<BodyInfo>& bodies_in, FrameStyle style_in, SequenceOptions options_in)
      : bodies(bodies_in),
        style(std::move(style_in)),
        options(std::move(options_in)),
        looks(bodies),
        queue(2 * static_cast<std::size_t>(std::max(1, options.workers))) {
    std::error_code failed;
    std::filesystem::create_directories(options.folder, failed);
    if (failed) {
      throw IoError(fmt::format("cannot make {}: {}", options.folder.string(), failed.message()));
    }
    for (int i = 0; i < std::max(1, options.workers); ++i) {
      try {
        workers.emplace_back([this] { work(); });
      } catch (const std::system_error&) {  // no memory for its stack: some less will do
        if (workers.empty()) throw std::bad_alloc();
        break;
      }
    }
  }

  ~Impl() { stop(true); }

  void stop(bool drop) {
    queue.close(drop);
    for (std::thread& worker : workers) worker.join();
    workers.clear();
  }

  /// A worker: draws and writes one job after the other until there are none.
  void work() {
    try {
      std::unique_ptr<FrameEncoder> encoder;  // with memory that all frames share
      for (Job job; queue.pop(job);) {
        if (!encoder) encoder = std::make_unique<FrameEncoder>(bodies, looks, style);
        drawAndWrite(*encoder, job);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
      queue.close(true);
    }
  }

  void drawAndWrite(FrameEncoder& encoder, const Job& job) {
    const Clock::time_point start = Clock::now();
    encoder.draw(job.snapshot, job.slots);
    const double draw_seconds = secondsSince(start);
    const std::span<const std::uint8_t> file = encoder.encode();
    constexpr bool kDurable = false;  // thousands of files; a damaged one is drawn again
    writeAtomically(options.folder / frameName(job.frame, style.format), file, kDurable);
    if (options.digests != nullptr) options.digests->note(job.frame, file);

    const std::lock_guard lock(mutex);
    ++stats.written;
    stats.bytes += file.size();
    stats.draw_seconds += draw_seconds;
    stats.encode_seconds += secondsSince(start) - draw_seconds;
  }

  /// Whether this frame is there from an earlier rendering.
  bool isThere(std::int64_t frame) const {
    return options.resume && options.digests != nullptr &&
           options.digests->holds(frame, options.folder / frameName(frame, style.format));
  }

  void rethrow() {
    const std::lock_guard lock(mutex);
    if (error) std::rethrow_exception(error);
  }

  const std::vector<BodyInfo>& bodies;
  FrameStyle style;
  SequenceOptions options;
  BodyLooks looks;
  CollectionColors colors;
  std::int64_t next = 0;
  Queue queue;
  std::mutex mutex;  // guards what follows
  SequenceStats stats;
  std::exception_ptr error;
  std::vector<std::thread> workers;
};

SequenceWriter::SequenceWriter(const std::vector<BodyInfo>& bodies, FrameStyle style,
                               SequenceOptions options)
    : impl_(std::make_unique<Impl>(bodies, std::move(style), std::move(options))) {}

SequenceWriter::~SequenceWriter() = default;

void SequenceWriter::add(Snapshot snapshot) {
  Impl& w = *impl_;
  CollectionSlots slots = w.colors.update(snapshot);
  const std::int64_t frame = w.next++;
  if (w.isThere(frame)) {
    const std::lock_guard lock(w.mutex);
    ++w.stats.kept;
    return;
  }
  if (!w.queue.push({std::move(snapshot), std::move(slots), frame})) w.rethrow();
}

void SequenceWriter::skip(const Snapshot& snapshot) { impl_->colors.update(snapshot); }

void SequenceWriter::finish() {
  impl_->stop(false);
  impl_->rethrow();
}

std::int64_t SequenceWriter::frames() const { return impl_->next; }

SequenceStats SequenceWriter::stats() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->stats;
}

}  // namespace merge2d
