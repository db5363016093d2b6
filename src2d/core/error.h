#pragma once
/// Errors that a user can cause. A programmer's mistake trips an assertion instead (core/assert.h).

#include <stdexcept>
#include <string>
#include <vector>

namespace merge2d {

/// A scene, lesson or graph that cannot be used. `what()` is the whole message as the user sees it:
/// `tower.toml:12:8: unknown key 'frction' in [[body]] (did you mean 'friction'?)`, and, where the
/// source line is known, that line and a caret below it.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reading or writing failed, or a picture could not be made.
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A number stopped being finite in the middle of a run; the message names body, stage and step.
class SimulationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace merge2d
