#pragma once
/// Signals: long commands stop between two steps, and no command leaves anything half done behind.
///
/// A signal whose action was not the default when the program began keeps that action: what nohup
/// or a script had ignored stays ignored.

#include <stdexcept>

namespace merge2d {

/// Thrown where a command noticed that it is to stop.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// To be called before a command begins. A signal that ends the program removes its temporary files
/// first. Writing to a pipe that nobody reads, or beyond the limit of a file's size, becomes an
/// error of that write.
void prepareSignals();

/// Gives a child process the actions that this program was started with, before it becomes another
/// program, which has no handlers anyway.
void restoreSignals();

/// From now on SIGINT, SIGTERM, SIGHUP and SIGXCPU are remembered; a second one ends the program at
/// once.
void catchInterrupts();

/// The signal that was remembered; 0 when there was none.
int interruptSignal();

/// Throws Interrupted after a signal.
void stopIfInterrupted();

/// Ends the program by the signal that interrupted it, so that the shell knows.
[[noreturn]] void endByInterrupt();

/// Ends the program by SIGPIPE, unless whoever started it had that signal ignored.
void endByBrokenPipe();

}  // namespace merge2d
