#pragma once
/// Threads that share independent work within a stage.

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace merge2d {

/// Work is cut into tasks whose number and order say nothing about the threads that do them. A task
/// writes only what no other one reads or writes, so that the results are the same bytes whatever
/// the number of threads.
class TaskPool {
 public:
  /// `threads` of 1 or more, of which the caller's is one.
  explicit TaskPool(int threads);
  ~TaskPool();
  TaskPool(const TaskPool&) = delete;
  TaskPool& operator=(const TaskPool&) = delete;

  int threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls `work(task, thread)` for each task below `tasks`, once, in any order; `thread` is below
  /// threads(). Returns when all of them are done. Where `work` throws, tasks that have not begun
  /// are left out, and one of the exceptions is thrown here once no thread has a task any more.
  template <class Work>
  void run(std::size_t tasks, Work&& work) {
    if (workers_.empty() || tasks <= 1) {
      for (std::size_t task = 0; task < tasks; ++task) work(task, 0);
      return;
    }
    using Type = std::remove_reference_t<Work>;
    runOnAll(tasks, {&work, [](void* of, std::size_t task, int thread) {
                       (*static_cast<Type*>(of))(task, thread);
                     }});
  }

 private:
  struct Job {
    void* work = nullptr;
    void (*call)(void* work, std::size_t task, int thread) = nullptr;
  };

  void runOnAll(std::size_t tasks, Job job);
  void takeTasks(int thread);
  void keepError();
  void serve(int thread);
  /// Waits until the job after `seen` is there; returns its number, or 0 at the end.
  std::uint64_t awaitJob(std::uint64_t seen);

  Job job_;
  std::size_t tasks_ = 0;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::uint64_t> job_number_{0};
  std::atomic<bool> open_{false};  ///< tasks of the job may be taken
  std::atomic<int> busy_{0};       ///< workers that may be taking some
  std::atomic<bool> ends_{false};
  std::atomic<int> sleepers_{0};
  std::mutex mutex_;
  std::exception_ptr error_;  ///< of a task
  std::condition_variable wakes_;
  std::vector<std::thread> workers_;
};

/// Calls `work(first, count, thread)` for runs of at most `grain` of the numbers below `n`; without
/// a pool once for all of them.
template <class Work>
void forEachRun(TaskPool* pool, std::size_t n, std::size_t grain, Work&& work) {
  if (pool == nullptr || n <= grain) return work(0, n, 0);
  pool->run((n + grain - 1) / grain, [&](std::size_t task, int thread) {
    const std::size_t first = task * grain;
    work(first, n - first < grain ? n - first : grain, thread);
  });
}

/// Calls `work(i, thread)` for each i below `n`, in such runs.
template <class Work>
void forEachIndex(TaskPool* pool, std::size_t n, std::size_t grain, Work&& work) {
  forEachRun(pool, n, grain, [&](std::size_t first, std::size_t count, int thread) {
    for (std::size_t i = first; i < first + count; ++i) work(i, thread);
  });
}

}  // namespace merge2d
