#include "app/interrupt.h"

#include <csignal>
#include <cstdlib>

#include "render/new_file.h"

namespace merge2d {
namespace {

volatile std::sig_atomic_t received = 0, awaited = 0;
bool pipes_end_programs = false, sizes_end_programs = false;  ///< by default

bool asksToStop(int signal) {
  return signal == SIGINT || signal == SIGTERM || signal == SIGHUP || signal == SIGXCPU;
}

/// Whether the default action of a signal is to end the program, in a way that can be changed.
bool endsPrograms(int signal) {
  for (const int other : {SIGKILL, SIGSTOP, SIGTSTP, SIGTTIN, SIGTTOU, SIGCONT, SIGCHLD, SIGURG,
                          SIGWINCH, SIGPIPE, SIGXFSZ}) {
    if (signal == other) return false;
  }
  return true;
}

extern "C" void onSignal(int signal) {
  if (asksToStop(signal) && awaited != 0 && received == 0) {
    received = signal;
    return;
  }
  removeTemporaryFiles();
  std::signal(signal, SIG_DFL);
  std::raise(signal);  // which arrives when this function returns
}

/// Replaces the default action of a signal, and no other. Returns whether it was the default.
bool replaceDefault(int signal, void (*handler)(int)) {
  struct sigaction action {};
  if (sigaction(signal, nullptr, &action) != 0 || (action.sa_flags & SA_SIGINFO) != 0 ||
      action.sa_handler != SIG_DFL) {
    return false;
  }
  action.sa_handler = handler;
  return sigaction(signal, &action, nullptr) == 0;
}

[[noreturn]] void endBy(int signal) {
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  std::abort();
}

}  // namespace

void prepareSignals() {
  pipes_end_programs = replaceDefault(SIGPIPE, SIG_IGN);
  sizes_end_programs = replaceDefault(SIGXFSZ, SIG_IGN);
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    if (endsPrograms(signal)) replaceDefault(signal, onSignal);
  }
}

void restoreSignals() {
  if (pipes_end_programs) std::signal(SIGPIPE, SIG_DFL);
  if (sizes_end_programs) std::signal(SIGXFSZ, SIG_DFL);
}

void catchInterrupts() { awaited = 1; }

int interruptSignal() { return static_cast<int>(received); }

void stopIfInterrupted() {
  if (received != 0) throw Interrupted("interrupted");
}

void endByInterrupt() { endBy(received != 0 ? interruptSignal() : SIGINT); }

void endByBrokenPipe() {
  if (pipes_end_programs) endBy(SIGPIPE);
}

}  // namespace merge2d
