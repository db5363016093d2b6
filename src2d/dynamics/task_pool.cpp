#include "src2d/dynamics/task_pool.h"

#include <chrono>
#include <utility>

namespace merge2d {
namespace {

/// Between two jobs of one step a worker looks for the next one for as long before it sleeps: to
/// wake it takes longer than most jobs.
constexpr std::chrono::microseconds kPatience{200};

/// Waits a moment without giving the processor away, as the wait is short.
void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

/// Waits until `done()`, for `kPatience` at most; returns whether it came.
template <class Done>
bool spinUntil(Done&& done) {
  const auto start = std::chrono::steady_clock::now();
  for (int i = 1; !done(); ++i) {
    pause();
    if (i % 64 == 0 && std::chrono::steady_clock::now() - start > kPatience) return false;
  }
  return true;
}

}  // namespace

TaskPool::TaskPool(int threads) {
  for (int i = 1; i < threads; ++i) workers_.emplace_back([this, i] { serve(i); });
}

TaskPool::~TaskPool() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
  }
  wakes_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void TaskPool::runOnAll(std::size_t tasks, Job job) {
  job_ = job;
  tasks_ = tasks;
  next_ = 0;
  open_ = true;
  ++job_number_;
  if (sleepers_ > 0) {
    const std::scoped_lock lock(mutex_);  // or a worker that is about to sleep misses it
    wakes_.notify_all();
  }
  takeTasks(0);
  open_ = false;
  while (!spinUntil([&] { return busy_ == 0; })) std::this_thread::yield();
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void TaskPool::keepError() {
  const std::scoped_lock lock(mutex_);
  if (!error_) error_ = std::current_exception();
  next_ = tasks_;
}

void TaskPool::takeTasks(int thread) {
  for (std::size_t task = next_++; task < tasks_; task = next_++) {
    try {
      job_.call(job_.work, task, thread);
    } catch (...) {
      keepError();
    }
  }
}

void TaskPool::serve(int thread) {
  for (std::uint64_t seen = 0; (seen = awaitJob(seen)) != 0;) {
    ++busy_;
    if (open_) takeTasks(thread);  // else the job is done: its caller may be gone
    --busy_;
  }
}

std::uint64_t TaskPool::awaitJob(std::uint64_t seen) {
  const auto comes = [&] { return ends_ || job_number_ != seen; };
  if (spinUntil(comes)) return ends_ ? 0 : job_number_.load();
  std::unique_lock lock(mutex_);
  ++sleepers_;
  wakes_.wait(lock, comes);
  --sleepers_;
  return ends_ ? 0 : job_number_.load();
}

}  // namespace merge2d
