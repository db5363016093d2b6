#pragma once
/// The table of a study, read back for its report.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/json.h"

namespace merge2d {

/// Fields of CSV (RFC 4180), row by row.
std::vector<std::vector<std::string>> parseCsv(const std::string& text);

/// A varied quantity whose values are put into a few places along an axis: each value of a grid has
/// its own, drawn ones share intervals of equal extent.
struct StudyPlaces {
  std::string key{};
  std::vector<std::string> labels{};                 ///< ascending
  std::vector<double> centers{};                     ///< of the places
  std::vector<std::optional<std::size_t>> of_row{};  ///< the place of each row
  bool logarithmic = false;
};

/// study.json and study.csv of a folder.
class StudyData {
 public:
  /// Throws InputError where there is no study, or its table cannot be read.
  explicit StudyData(const std::filesystem::path& folder);

  const std::string& title() const { return title_; }
  std::size_t rows() const { return rows_.size(); }
  /// Empty where there is no such column.
  const std::string& text(std::size_t row, const std::string& column) const;
  std::optional<double> number(std::size_t row, const std::string& column) const;
  bool failed(std::size_t row) const { return text(row, "exit_code") != "0"; }
  /// The different texts of a column, in their order.
  std::vector<std::string> valuesOf(const std::string& column) const;

  /// The axes with numbers of which at least two differ.
  const std::vector<StudyPlaces>& axes() const { return axes_; }

 private:
  void findAxes(const Json& study);

  std::string title_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<StudyPlaces> axes_;
};

}  // namespace merge2d
