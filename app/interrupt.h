#pragma once
/// Ctrl-C: long commands stop between two steps, and leave nothing half done behind.

#include <stdexcept>

namespace merge2d {

/// Thrown where a command noticed that it is to stop.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// From now on SIGINT, SIGTERM and SIGHUP are remembered; a second one ends the program at once.
void catchInterrupts();

/// Throws Interrupted after a signal.
void stopIfInterrupted();

/// Ends the program by the signal that interrupted it, so that the shell knows.
[[noreturn]] void endByInterrupt();

}  // namespace merge2d
