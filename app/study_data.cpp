#include "app/study_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "src2d/core/error.h"
#include "src2d/scene/file.h"

namespace merge2d {
namespace {

constexpr std::size_t kMostTable = std::size_t{4} << 30;  // bytes
constexpr std::size_t kMostPlaces = 24;                   // of one axis
constexpr std::size_t kIntervals = 8;                     // of drawn values

std::optional<double> numberOf(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Each value by itself.
void placeValues(const std::vector<double>& values, StudyPlaces& places) {
  for (const double value : values) {
    places.centers.push_back(value);
    places.labels.push_back(fmt::format("{:.6g}", value));
  }
}

/// Intervals over the whole range, by their centres.
void placeIntervals(double low, double high, StudyPlaces& places) {
  for (std::size_t i = 0; i < kIntervals; ++i) {
    const double part = (static_cast<double>(i) + 0.5) / kIntervals;
    const double center =
        places.logarithmic ? low * std::pow(high / low, part) : low + part * (high - low);
    places.centers.push_back(center);
    places.labels.push_back(fmt::format("{:.2g}", center));
  }
}

std::size_t nearestPlace(const StudyPlaces& places, double value) {
  const auto distance = [&](double center) {
    return places.logarithmic ? std::abs(std::log(value / center)) : std::abs(value - center);
  };
  const auto nearest = std::ranges::min_element(places.centers, {}, distance);
  return static_cast<std::size_t>(nearest - places.centers.begin());
}

}  // namespace

std::vector<std::vector<std::string>> parseCsv(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  bool quoted = false, fresh = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (fresh) rows.push_back({""}), fresh = false;
    std::string& field = rows.back().back();
    if (c == '"' && quoted && i + 1 < text.size() && text[i + 1] == '"') {
      field += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      rows.back().emplace_back();
    } else if (c == '\n' && !quoted) {
      fresh = true;
    } else if (c != '\r' || quoted) {
      field += c;
    }
  }
  return rows;
}

StudyData::StudyData(const std::filesystem::path& folder) {
  const std::filesystem::path description = folder / "study.json", table = folder / "study.csv";
  for (const auto& file : {description, table}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) continue;
    throw InputError(
        fmt::format("{} is not the folder of a study: it has no {}; 'merge2d study GRID.toml -o "
                    "DIR' makes one, "
                    "and --collect its table",
                    folder.string(), file.filename().string()));
  }
  const Json study = Json::parse(readFile(description, {.what = "a study"}), nullptr, false);
  if (!study.is_object() || study.value("format", Json()) != "merge2d-study") {
    throw InputError(fmt::format("{}: this is no study", description.string()));
  }
  title_ = study.value("title", std::string());
  rows_ = parseCsv(readFile(table, {.what = "the table of a study", .most = kMostTable}));
  if (rows_.empty()) throw InputError(fmt::format("{}: it is empty", table.string()));
  for (std::size_t i = 0; i < rows_.front().size(); ++i) columns_[rows_.front()[i]] = i;
  rows_.erase(rows_.begin());
  findAxes(study);
}

const std::string& StudyData::text(std::size_t row, const std::string& column) const {
  static const std::string kEmpty;
  const auto found = columns_.find(column);
  if (found == columns_.end() || found->second >= rows_[row].size()) return kEmpty;
  return rows_[row][found->second];
}

std::optional<double> StudyData::number(std::size_t row, const std::string& column) const {
  return numberOf(text(row, column));
}

std::vector<std::string> StudyData::valuesOf(const std::string& column) const {
  std::vector<std::string> values;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const std::string& value = text(row, column);
    if (!value.empty() && std::ranges::find(values, value) == values.end()) values.push_back(value);
  }
  return values;
}

void StudyData::findAxes(const Json& study) {
  for (const Json& axis : study.value("axes", Json::array())) {
    StudyPlaces places{.key = axis.value("key", std::string())};
    if (!axis.value("numeric", false) || places.key == "seed") continue;
    std::vector<double> values;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      if (const auto value = number(row, places.key)) values.push_back(*value);
    }
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    if (values.size() < 2) continue;
    constexpr double kWide = 20.0;  // from the least to the largest value
    places.logarithmic = values.front() > 0.0 && (axis.value("logarithmic", false) ||
                                                  values.back() > kWide * values.front());
    if (values.size() > kMostPlaces || axis.value("drawn", false)) {
      placeIntervals(values.front(), values.back(), places);
    } else {
      placeValues(values, places);
    }
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const auto value = number(row, places.key);
      places.of_row.push_back(value ? std::optional(nearestPlace(places, *value)) : std::nullopt);
    }
    axes_.push_back(std::move(places));
  }
}

}  // namespace merge2d
