#pragma once
/// A run as a table for spreadsheets: one row of totals per time step.

#include <ostream>

#include "src2d/trace/snapshot.h"

namespace merge2d {

/// How every table begins.
inline constexpr std::string_view kCsvStart = "step,t,bodies,active_bodies,";

/// Writes each row as soon as it is known. The state of `out` tells whether that went well.
class CsvWriter {
 public:
  /// Writes the row of column names. With timings the last column is the wall time of the step [s].
  CsvWriter(std::ostream& out, bool timings);

  void add(const Snapshot& snapshot);

 private:
  std::ostream& out_;
  bool timings_;
};

}  // namespace merge2d
