#pragma once
/// A study as one page: the results of its runs, in charts.

#include <string>

#include "app/study_data.h"

namespace merge2d {

/// A page of HTML that needs nothing beside it. Throws IoError where there is no font.
std::string studyReport(const StudyData& data);

}  // namespace merge2d
