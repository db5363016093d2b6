#pragma once
/// A comparison as text, as JSON and as a table for spreadsheets.

#include <optional>
#include <string>
#include <string_view>

#include "app/comparison.h"

namespace merge2d {

/// How every table of a comparison begins.
inline constexpr std::string_view kComparisonCsvStart = "mode,step,t,active_bodies,";

/// "3.2 mm", in the unit that needs no power of ten.
std::string lengthText(double metres);

/// A column per mode, the numbers with their units; with a window, also the means within it.
std::string comparisonTable(const Comparison& comparison, const std::optional<Window>& window);

/// One object; `charts` are the files that were drawn. Without timings, what was measured in
/// seconds is null. docs/compare.md explains the keys.
std::string comparisonJson(const Comparison& comparison, const std::optional<Window>& window,
                           const std::vector<std::string>& charts);

/// A row per mode and step.
std::string comparisonCsv(const Comparison& comparison);

}  // namespace merge2d
