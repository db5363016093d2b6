#pragma once
/// Errors that a user can cause. A programmer's mistake trips an assertion instead (core/assert.h).
/// Their messages are of one line: control characters in what they quote are shown escaped.

#include <stdexcept>
#include <string>
#include <vector>

#include "src2d/core/utf8.h"

namespace merge2d {

/// A message of one line, and the lines below it that show the place.
struct PlacedMessage {
  std::string sentence, excerpt;
};

/// A scene, lesson or graph that cannot be used. `what()` is the whole message as the user sees it:
/// `tower.toml:12:8: unknown key 'frction' in [[body]] (did you mean 'friction'?)`, and, where the
/// source line is known, that line and a caret below it.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(escaped(message)) {}
  explicit InputError(const PlacedMessage& message)
      : std::runtime_error(escaped(message.sentence) + message.excerpt) {}
};

/// Reading or writing failed, or a picture could not be made.
class IoError : public std::runtime_error {
 public:
  explicit IoError(const std::string& message) : std::runtime_error(escaped(message)) {}
};

/// A number stopped being finite in the middle of a run; the message names body, stage and step.
class SimulationError : public std::runtime_error {
 public:
  explicit SimulationError(const std::string& message) : std::runtime_error(escaped(message)) {}
};

}  // namespace merge2d
