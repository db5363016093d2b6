#pragma once
/// The charts of a study's report, as SVG for its page.

#include <string>
#include <vector>

#include "app/study_data.h"

namespace merge2d {

/// A number of each run that a study is about.
struct Measure {
  const char* column;
  const char* title;  ///< with its unit
  double scale;       ///< of the column's numbers to the unit
};

/// Those that the study has and that differ between runs.
std::vector<Measure> measuresOf(const StudyData& data);

/// Runs of one scene in one mode.
struct StudyGroup {
  std::string scene, mode{};
  std::vector<std::size_t> rows{};  ///< that went well
};
std::vector<StudyGroup> groupsOf(const StudyData& data);

/// A field of colours over two axes for each group, the mean of the runs that share a cell.
std::string heatMapsSvg(const StudyData& data, const Measure& measure, const StudyPlaces& x,
                        const StudyPlaces& y, const std::string& id);
/// The mean over an axis: a chart for each scene, a line for each mode.
std::string linesSvg(const StudyData& data, const Measure& measure, const StudyPlaces& x,
                     const std::string& id);
/// Every run as a dot, and the quartiles, for each group.
std::string distributionSvg(const StudyData& data, const Measure& measure, const std::string& id);

}  // namespace merge2d
