#pragma once
/// A run as a table for spreadsheets: one row of totals per time step.

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "src2d/trace/snapshot.h"

namespace merge2d {

/// How every table begins.
inline constexpr std::string_view kCsvStart = "step,t,bodies,active_bodies,";

/// A value of a table: in quotes where it has a comma, a quote or a line break in it (RFC 4180).
std::string csvField(std::string_view text);

/// Writes each row as soon as it is known. The state of `out` tells whether that went well.
class CsvWriter {
 public:
  /// Texts by their columns that are the same in each row: they say where the table comes from.
  using Constants = std::vector<std::pair<std::string, std::string>>;

  /// Writes the row of column names. With timings there is a column of the wall time of the step
  /// [s]. Constants come last.
  CsvWriter(std::ostream& out, bool timings, const Constants& constants = {});

  void add(const Snapshot& snapshot);

 private:
  std::ostream& out_;
  bool timings_;
  std::string end_;  ///< of each row
};

}  // namespace merge2d
