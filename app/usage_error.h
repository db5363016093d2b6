#pragma once
/// Errors that end a command early, beside those of src2d/core/error.h.

#include <stdexcept>
#include <string>

#include "src2d/core/utf8.h"

namespace merge2d {

/// The command line asks for something that cannot be; the message says what would be right.
class UsageError : public std::runtime_error {
 public:
  explicit UsageError(const std::string& message) : std::runtime_error(escaped(message)) {}
};

}  // namespace merge2d
