#include "app/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

#include "app/interrupt.h"
#include "src2d/core/error.h"

namespace merge2d {
namespace {

using WaitClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kWait{50};  ///< between two looks at the child
constexpr std::chrono::seconds kPatience{5};    ///< with a child that was asked to end
constexpr std::size_t kMostMessages = 1 << 16;  ///< [bytes]
constexpr int kNotStarted = 127;                ///< as shells return it

[[noreturn]] void failToStart(const std::filesystem::path& program) {
  throw IoError(
      fmt::format("cannot start {}: {}", program.string(), std::generic_category().message(errno)));
}

/// The reading end of what the child writes.
class Messages {
 public:
  explicit Messages(int descriptor) : descriptor_(descriptor) {
    fcntl(descriptor_, F_SETFL, O_NONBLOCK);
  }
  ~Messages() { close(descriptor_); }
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  /// Waits a moment for more.
  void wait() {
    pollfd polled{.fd = ended_ ? -1 : descriptor_, .events = POLLIN, .revents = 0};
    poll(&polled, 1, static_cast<int>(kWait.count()));
    read();
  }

  /// Takes what is there; what is too much is lost.
  void read() {
    std::array<char, 4096> block{};
    ssize_t got = 0;
    while ((got = ::read(descriptor_, block.data(), block.size())) > 0) {
      text_.append(block.data(), static_cast<std::size_t>(got));
      text_.resize(std::min(text_.size(), kMostMessages));
    }
    ended_ = got == 0;
  }

  std::string text() const { return text_; }

 private:
  int descriptor_;
  bool ended_ = false;
  std::string text_;
};

/// Becomes the other program. Between fork and exec only functions may be called that handlers of
/// signals may call, too.
[[noreturn]] void become(const char* program, char* const* arguments, pid_t parent, int output) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kNotStarted);  // which ended before
  restoreSignals();
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(program, arguments);
  const char* reason = strerrordesc_np(errno);
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, reason, std::strlen(reason));
  _exit(kNotStarted);
}

/// Waits for the child's end, and hands on what interrupts this program.
int statusOf(pid_t child, Messages& messages) {
  std::optional<WaitClock::time_point> asked;
  for (int status = 0;; messages.wait()) {
    if (waitpid(child, &status, WNOHANG) == child) return status;
    if (interruptSignal() != 0 && !asked) {
      kill(child, interruptSignal());
      asked = WaitClock::now();
    }
    if (asked && WaitClock::now() > *asked + kPatience) kill(child, SIGKILL);
  }
}

}  // namespace

ChildResult runChild(const std::filesystem::path& program, std::vector<std::string> arguments) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) failToStart(program);
  const pid_t parent = getpid(), child = fork();
  if (child == 0) become(program.c_str(), argv.data(), parent, ends[1]);
  close(ends[1]);
  Messages messages(ends[0]);
  if (child < 0) failToStart(program);

  const int status = statusOf(child, messages);
  messages.read();
  stopIfInterrupted();
  ChildResult result{.messages = messages.text()};
  if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  return result;
}

}  // namespace merge2d
