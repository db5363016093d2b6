#pragma once
/// Runs of this very program in processes of their own, several at a time.

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace merge2d {

/// How a process ended.
struct ProcessEnd {
  std::size_t task = 0;           ///< the number that it was started with
  int exit_code = 0;              ///< 128 + n where signal n ended it, as shells have it
  bool timed_out = false;         ///< it was killed for its time limit
  double wall_seconds = 0.0;      ///< from its start to its end
  double cpu_seconds = 0.0;       ///< of all its threads
  std::int64_t memory_bytes = 0;  ///< the most that it held
  std::string out{}, err{};       ///< the beginnings of its output
};

/// Up to so many processes at once. They are killed with this object and with this program, however
/// it ends, and a signal to this program's group does not reach them.
class ProcessPool {
 public:
  /// `time_limit` is that of each process [s]; 0: none. Throws IoError.
  ProcessPool(std::size_t slots, double time_limit);
  ~ProcessPool();
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  bool full() const;
  bool idle() const;

  /// Starts this program with these arguments. There must be a free slot. Throws IoError.
  void start(std::size_t task, const std::vector<std::string>& arguments);

  /// Waits until a process ends. Throws Interrupted when this program is to stop.
  ProcessEnd wait();

 private:
  using Clock = std::chrono::steady_clock;

  struct Slot {
    pid_t process = 0;  ///< 0: free
    std::size_t task = 0;
    int out = -1, err = -1;  ///< files in memory
    Clock::time_point start;
    bool timed_out = false;
  };

  std::optional<ProcessEnd> reap();
  void killLate();

  std::vector<Slot> slots_;
  double time_limit_;
};

}  // namespace merge2d
