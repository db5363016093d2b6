#include "app/study_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/comparison.h"
#include "render/chart.h"
#include "render/distribution.h"
#include "render/heat_map.h"
#include "render/svg.h"
#include "src2d/scene/names.h"

namespace merge2d {
namespace {

constexpr int kPageWidth = 1120;  // px

constexpr Measure kMeasures[] = {
    {"ms_per_step_median", "median time per step [ms]", 1.0},
    {"reference_error_mean", "mean distance from the reference at the end [m]", 1.0},
    {"reference_error_max", "largest distance from the reference at the end [m]", 1.0},
    {"unmerges", "welds that broke", 1.0},
    {"merges", "merges", 1.0},
    {"active_bodies", "bodies simulated at the end", 1.0},
    {"max_penetration", "deepest overlap [mm]", 1e3},
    {"kinetic_energy", "kinetic energy at the end [J]", 1.0},
};

std::optional<double> valueOf(const StudyData& data, std::size_t row, const Measure& measure) {
  const auto value = data.number(row, measure.column);
  return value ? std::optional(*value * measure.scale) : std::nullopt;
}

/// Values over two decades or more, all positive, are compared by their logarithms.
struct Spread {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;
};

Spread spreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  const auto [low, high] = std::ranges::minmax_element(values);
  constexpr double kWide = 100.0;
  return {*low, *high, *low > 0.0 && *high > kWide * *low};
}

/// Means by cells.
class Means {
 public:
  explicit Means(std::size_t cells) : sums_(cells), counts_(cells) {}

  void add(std::size_t cell, double value) {
    sums_[cell] += value;
    ++counts_[cell];
  }
  std::optional<double> operator[](std::size_t cell) const {
    if (counts_[cell] == 0) return std::nullopt;
    return sums_[cell] / static_cast<double>(counts_[cell]);
  }
  std::size_t size() const { return sums_.size(); }
  std::vector<std::optional<double>> all() const {
    std::vector<std::optional<double>> out;
    for (std::size_t i = 0; i < size(); ++i) out.push_back((*this)[i]);
    return out;
  }

 private:
  std::vector<double> sums_;
  std::vector<int> counts_;
};

/// The colour of a mode, whichever modes a study has.
Color colorOf(const Theme& theme, const std::string& mode) {
  for (std::size_t i = 0; i < kModes.size(); ++i) {
    if (nameOf(kModes[i]) == mode) return theme.lines[i];
  }
  return theme.ink;
}

std::string groupName(const StudyData& data, const StudyGroup& group) {
  return data.valuesOf("scene").size() > 1 ? group.scene + ", " + group.mode : group.mode;
}

std::string finished(Drawing& drawing, int height, const std::string& title,
                     const std::string& id) {
  drawing.background = lightTheme().background;
  return toSvg(
      drawing,
      {.width = kPageWidth, .height = height, .title = title, .id_prefix = id, .inner = true});
}

}  // namespace

std::vector<Measure> measuresOf(const StudyData& data) {
  std::vector<Measure> found;
  for (const Measure& measure : kMeasures) {
    std::optional<double> first;
    bool differs = false;
    for (std::size_t row = 0; row < data.rows(); ++row) {
      const auto value = data.failed(row) ? std::nullopt : valueOf(data, row, measure);
      if (!value) continue;
      differs = differs || (first && *first != *value);
      first = value;
    }
    if (differs) found.push_back(measure);
  }
  return found;
}

std::vector<StudyGroup> groupsOf(const StudyData& data) {
  std::vector<StudyGroup> groups;
  for (const std::string& scene : data.valuesOf("scene")) {
    for (const std::string& mode : data.valuesOf("mode")) {
      StudyGroup group{scene, mode, {}};
      for (std::size_t row = 0; row < data.rows(); ++row) {
        const bool here = data.text(row, "scene") == scene && data.text(row, "mode") == mode;
        if (here && !data.failed(row)) group.rows.push_back(row);
      }
      if (!group.rows.empty()) groups.push_back(std::move(group));
    }
  }
  return groups;
}

std::string heatMapsSvg(const StudyData& data, const Measure& measure, const StudyPlaces& x,
                        const StudyPlaces& y, const std::string& id) {
  std::vector<HeatMap> maps;
  std::vector<double> all;
  for (const StudyGroup& group : groupsOf(data)) {
    const std::size_t columns = x.labels.size();
    Means means(columns * y.labels.size());
    for (const std::size_t row : group.rows) {
      const auto value = valueOf(data, row, measure);
      if (value && x.of_row[row] && y.of_row[row]) {
        means.add(*y.of_row[row] * columns + *x.of_row[row], *value);
      }
    }
    HeatMap map{.title = groupName(data, group), .x_label = x.key, .y_label = y.key};
    map.x_values = x.labels;
    map.y_values = y.labels;
    map.cells = means.all();
    for (const auto& cell : map.cells) {
      if (cell) all.push_back(*cell);
    }
    maps.push_back(std::move(map));
  }
  const Spread spread = spreadOf(all);
  const int columns = std::clamp(static_cast<int>(maps.size()), 1, x.labels.size() > 9 ? 1 : 2);
  const int rows = (static_cast<int>(maps.size()) + columns - 1) / columns;
  const int height =
      110 + 30 * std::clamp(static_cast<int>(y.labels.size()), 4, 14);  // of a row of maps
  Drawing drawing;
  Text text;
  Painter painter(drawing, text);
  painter.beginLayer();
  for (std::size_t i = 0; i < maps.size(); ++i) {
    maps[i].low = spread.low;
    maps[i].high = spread.high;
    maps[i].logarithmic = spread.logarithmic;
    const float width = static_cast<float>(kPageWidth) / static_cast<float>(columns);
    const int place = static_cast<int>(i), line = place / columns;
    const auto column = static_cast<float>(place % columns), row = static_cast<float>(line);
    drawHeatMap(
        painter, maps[i], lightTheme(),
        {column * width, row * static_cast<float>(height), width, static_cast<float>(height)},
        1.0F);
  }
  return finished(drawing, rows * height,
                  fmt::format("{} over {} and {}", measure.title, x.key, y.key), id);
}

std::string linesSvg(const StudyData& data, const Measure& measure, const StudyPlaces& x,
                     const std::string& id) {
  const std::vector<StudyGroup> groups = groupsOf(data);
  std::vector<Chart> charts;
  std::vector<double> all;
  for (const std::string& scene : data.valuesOf("scene")) {
    Chart chart{.title = scene, .x_label = x.key, .y_label = measure.title};
    for (const Mode mode : kModes) {  // each keeps its colour
      Series& series = chart.series.emplace_back();
      for (const StudyGroup& group : groups) {
        if (group.scene != scene || group.mode != nameOf(mode)) continue;
        series.name = group.mode;
        Means means(x.labels.size());
        for (const std::size_t row : group.rows) {
          const auto value = valueOf(data, row, measure);
          if (value && x.of_row[row]) means.add(*x.of_row[row], *value);
        }
        for (std::size_t i = 0; i < means.size(); ++i) {
          if (!means[i]) continue;
          series.x.push_back(x.logarithmic ? std::log10(x.centers[i]) : x.centers[i]);
          series.y.push_back(*means[i]);
          all.push_back(*means[i]);
        }
      }
    }
    for (std::size_t i = 0; i < x.centers.size(); ++i) {
      const double place = x.logarithmic ? std::log10(x.centers[i]) : x.centers[i];
      chart.x_ticks.emplace_back(place, x.labels[i]);
    }
    chart.points = true;
    charts.push_back(std::move(chart));
  }
  const bool logarithmic = spreadOf(all).logarithmic;
  for (Chart& chart : charts) chart.log_y = logarithmic;
  constexpr int kHeight = 280;
  const int height = kHeight * static_cast<int>(charts.size());
  Text text;
  Drawing drawing = composeCharts(text, charts, 1, kPageWidth, height, lightTheme());
  return finished(drawing, height, fmt::format("{} over {}", measure.title, x.key), id);
}

std::string distributionSvg(const StudyData& data, const Measure& measure, const std::string& id) {
  Distribution distribution{.title = "All runs", .x_label = measure.title};
  std::vector<double> all;
  for (const StudyGroup& group : groupsOf(data)) {
    auto& shown = distribution.groups.emplace_back();
    shown.name = groupName(data, group);
    shown.color = colorOf(lightTheme(), group.mode);
    for (const std::size_t row : group.rows) {
      if (const auto value = valueOf(data, row, measure)) shown.values.push_back(*value);
    }
    all.insert(all.end(), shown.values.begin(), shown.values.end());
  }
  distribution.logarithmic = spreadOf(all).logarithmic;
  Drawing drawing;
  Text text;
  Painter painter(drawing, text);
  painter.beginLayer();
  const float height = heightOf(distribution);
  drawDistribution(painter, distribution, lightTheme(),
                   {0.0F, 0.0F, static_cast<float>(kPageWidth), height}, 1.0F);
  return finished(drawing, static_cast<int>(height), fmt::format("{} of all runs", measure.title),
                  id);
}

}  // namespace merge2d
