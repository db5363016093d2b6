#include "app/process_pool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "app/interrupt.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

constexpr std::size_t kMostOutput = 1 << 20;  // bytes of each stream that are read
constexpr std::int64_t kLook = 100'000'000;   // between two looks at clocks and signals [ns]
constexpr int kNoProgram = 127;               // as shells return it

[[noreturn]] void failPool(const char* what) {
  throw IoError(fmt::format("cannot {}: {}", what, std::generic_category().message(errno)));
}

int fileInMemory() {
  const int file = memfd_create("merge2d-output", MFD_CLOEXEC);
  if (file < 0) failPool("keep the output of a process");
  return file;
}

/// The beginning of a file, which is empty afterwards.
std::string takeText(int file) {
  std::string text(kMostOutput, '\0');
  const ssize_t got = pread(file, text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  if (ftruncate(file, 0) != 0 || lseek(file, 0, SEEK_SET) != 0) failPool("empty a file");
  return text;
}

/// SIGCHLD alone.
sigset_t childSignal() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGCHLD);
  return set;
}

double secondsOf(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// In the child: nothing between fork and exec that a handler of signals may not call.
[[noreturn]] void becomeRun(char* const* arguments, pid_t parent, int out, int err) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kNoProgram);
  setpgid(0, 0);
  restoreSignals();
  const sigset_t blocked = childSignal();
  sigprocmask(SIG_UNBLOCK, &blocked, nullptr);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  execv("/proc/self/exe", arguments);
  _exit(kNoProgram);
}

}  // namespace

ProcessPool::ProcessPool(std::size_t slots, double time_limit)
    : slots_(slots), time_limit_(time_limit) {
  std::signal(SIGCHLD, SIG_DFL);  // ignored, the system would forget how processes ended
  const sigset_t blocked = childSignal();
  sigprocmask(SIG_BLOCK, &blocked, nullptr);  // so that `wait` can wait for it
  for (Slot& slot : slots_) {
    slot.out = fileInMemory();
    slot.err = fileInMemory();
  }
}

ProcessPool::~ProcessPool() {
  for (const Slot& slot : slots_) {
    if (slot.process > 0) kill(slot.process, SIGKILL);
  }
  for (const Slot& slot : slots_) {
    if (slot.process > 0) waitpid(slot.process, nullptr, 0);
    close(slot.out);
    close(slot.err);
  }
}

bool ProcessPool::full() const {
  return std::ranges::all_of(slots_, [](const Slot& slot) { return slot.process > 0; });
}

bool ProcessPool::idle() const {
  return std::ranges::none_of(slots_, [](const Slot& slot) { return slot.process > 0; });
}

void ProcessPool::start(std::size_t task, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"merge2d"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  Slot& slot = *std::ranges::find(slots_, 0, &Slot::process);
  const pid_t parent = getpid(), child = fork();
  if (child == 0) becomeRun(argv.data(), parent, slot.out, slot.err);
  if (child < 0) failPool("start a process");
  slot.process = child;
  slot.task = task;
  slot.start = Clock::now();
  slot.timed_out = false;
}

ProcessEnd ProcessPool::wait() {
  const sigset_t set = childSignal();
  while (true) {
    stopIfInterrupted();
    if (auto end = reap()) return *std::move(end);
    killLate();
    const timespec look{.tv_sec = 0, .tv_nsec = kLook};
    sigtimedwait(&set, nullptr, &look);
  }
}

std::optional<ProcessEnd> ProcessPool::reap() {
  for (Slot& slot : slots_) {
    int status = 0;
    rusage usage{};
    if (slot.process <= 0 || wait4(slot.process, &status, WNOHANG, &usage) != slot.process)
      continue;
    ProcessEnd end{.task = slot.task, .timed_out = slot.timed_out};
    end.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    end.wall_seconds = std::chrono::duration<double>(Clock::now() - slot.start).count();
    end.cpu_seconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
    end.memory_bytes = std::int64_t{1024} * usage.ru_maxrss;
    end.out = takeText(slot.out);
    end.err = takeText(slot.err);
    slot.process = 0;
    return end;
  }
  return std::nullopt;
}

void ProcessPool::killLate() {
  if (time_limit_ <= 0.0) return;
  for (Slot& slot : slots_) {
    const double seconds = std::chrono::duration<double>(Clock::now() - slot.start).count();
    if (slot.process <= 0 || seconds < time_limit_) continue;
    slot.timed_out = true;
    kill(slot.process, SIGKILL);
  }
}

}  // namespace merge2d
