#pragma once
/// What ends a command early, beside the errors of src2d/core/error.h.

#include <stdexcept>
#include <string>

namespace merge2d {

/// The command line asks for something that cannot be; the message says what would be right.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace merge2d
