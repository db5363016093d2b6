#include "app/interrupt.h"

#include <csignal>
#include <cstdlib>

namespace merge2d {
namespace {

volatile std::sig_atomic_t received = 0;

extern "C" void remember(int signal) { received = signal; }

}  // namespace

void catchInterrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // a second signal is not caught
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

void stopIfInterrupted() {
  if (received != 0) throw Interrupted("interrupted");
}

void endByInterrupt() {
  const int signal = received != 0 ? static_cast<int>(received) : SIGINT;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  std::abort();
}

}  // namespace merge2d
