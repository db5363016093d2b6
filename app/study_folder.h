#pragma once
/// The folder of a study:
///   study.json   the parameters that vary
///   rows/        a file for each run, which appears complete or not at all: they count
///   ends/        where the reference runs end
///   study.csv    all rows as one table; always of whole lines, and made anew from `rows`

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/study_row.h"

namespace merge2d {

/// Where the ends of reference runs are kept.
std::filesystem::path endsFolder(const std::filesystem::path& folder);

/// Identifies runs: by the content of their scenes, their changes, and how they are run.
class RunKeys {
 public:
  /// Loads each scene, and tries the first value of each axis on it. Throws InputError, IoError.
  explicit RunKeys(const Study& study);

  std::string of(const StudyRun& run) const;

 private:
  const Study& study_;
  std::map<std::string, std::string> digests_;  ///< of the scenes, by their names
};

/// Makes the folder and those in it, and writes study.json. Several processes may do so at once.
/// Throws UsageError where there are files in it and no study of ours, unless `force`; IoError.
void prepareStudyFolder(const std::filesystem::path& folder, const Study& study, bool force);

/// study.csv while runs end: first the rows that are there, then one after another. A reader, or
/// who comes after a kill, finds whole lines.
class GrowingTable {
 public:
  /// `rows` are those there are, one for each run; empty keys are missing ones. Throws IoError.
  GrowingTable(std::filesystem::path file, const Study& study, const std::vector<StudyRun>& runs,
               std::vector<StudyRow>& rows);
  ~GrowingTable();
  GrowingTable(const GrowingTable&) = delete;
  GrowingTable& operator=(const GrowingTable&) = delete;

  /// Appends the row of a run. Throws IoError.
  void add(std::size_t run);
  /// Writes all rows in their order.
  void finish();

 private:
  std::string whole() const;

  std::filesystem::path file_;
  StudyTable table_;
  const std::vector<StudyRun>& runs_;
  std::vector<StudyRow>& rows_;
  int descriptor_ = -1;
};

}  // namespace merge2d
