#pragma once
/// The record of a run of a study: a small file each, which appears complete or not at all.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/json.h"
#include "app/study_design.h"

namespace merge2d {

/// How a run went.
struct StudyRow {
  std::string key{};                   ///< identifies the run: 16 hexadecimal digits
  std::vector<std::string> command{};  ///< "merge2d", "run", …
  int exit_code = 0;                   ///< 128 + n where signal n ended it
  std::string message{};               ///< the error in one line; empty where it went well
  double wall_seconds = 0.0;           ///< of the whole process
  double cpu_seconds = 0.0;            ///< of the whole process, all threads
  std::int64_t memory_bytes = 0;       ///< the most that it held
  Json result{};                       ///< of `run --json`; null where it printed none

  /// Whether it went well, so that it need not be run again.
  bool finished() const { return exit_code == 0 && result.is_object(); }
};

/// Writes DIR/rows/KEY.json. Throws IoError.
void writeRow(const std::filesystem::path& folder, const StudyRow& row);

/// Nothing where there is no such row, or it is damaged.
std::optional<StudyRow> readRow(const std::filesystem::path& folder, const std::string& key);

/// A study as a table: one row for each run, whose columns are the same whatever the runs gave.
class StudyTable {
 public:
  explicit StudyTable(const Study& study);

  /// With the line break at its end, as all of these.
  std::string head() const;
  /// `number` is that of the run, from 1.
  std::string row(std::size_t number, const StudyRun& run, const StudyRow& row) const;

 private:
  const Study& study_;
  std::vector<std::string> parameters_;  ///< that no axis varies: "solver.iterations"
};

/// How each table begins.
inline constexpr std::string_view kStudyCsvStart = "run,scene,mode,";

}  // namespace merge2d
