#include "app/comparison_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "app/comparison_marks.h"
#include "app/comparison_report.h"
#include "app/output_file.h"
#include "render/canvas.h"
#include "render/chart.h"
#include "render/png.h"
#include "render/svg.h"

namespace merge2d {
namespace {

constexpr const char *kTime = "time", *kCounts = "counts", *kDistance = "distance";
constexpr std::size_t kBins = 400;       // along the time axis
constexpr double kLeastDistance = 1e-7;  // [m]; what is less cannot be told apart

/// Stages that are shown as one, from the bottom of the stack.
struct StageGroup {
  const char* name;
  std::vector<Stage> stages;
};
const std::vector<StageGroup>& stageGroups() {
  static const std::vector<StageGroup> groups = {
      {"detection", {Stage::ContactDetection, Stage::ContactOrdering}},
      {"full solve", {Stage::WarmStart, Stage::SolveLCP}},
      {"forces inside", {Stage::SingleIterationPGS}},
      {"merging, sleeping",
       {Stage::SleepAndWake, Stage::Unmerge, Stage::AccumulateRelativeMotion, Stage::Merge}},
      {"integration", {Stage::AdvanceVelocities, Stage::AdvancePositions}}};
  return groups;
}

/// The steps of a run in bins of about equal length.
class Bins {
 public:
  explicit Bins(const Comparison& comparison)
      : steps_(static_cast<std::size_t>(comparison.stepsDone())),
        size_(std::max<std::size_t>(1, (steps_ + kBins - 1) / kBins)),
        h_(comparison.scene().step) {}

  std::size_t stepsPerBin() const { return size_; }

  /// A point for each bin: `number` of its first step and the one past its last.
  Series series(const std::string& name,
                const std::function<double(std::size_t, std::size_t)>& number) const {
    Series out{name, {}, {}};
    for (std::size_t from = 0; from < steps_; from += size_) {
      const std::size_t to = std::min(steps_, from + size_);
      out.x.push_back(0.5 * h_ * static_cast<double>(from + to + 1));
      out.y.push_back(number(from, to));
    }
    return out;
  }

  /// The sum of a number of each step.
  Series sums(const std::string& name, const std::vector<StepRow>& rows,
              int StepRow::*number) const {
    return series(name, [&](std::size_t from, std::size_t to) {
      double sum = 0.0;
      for (std::size_t i = from; i < to; ++i) sum += rows[i].*number;
      return sum;
    });
  }

  Series means(const std::string& name, const std::vector<StepRow>& rows,
               int StepRow::*number) const {
    Series out = sums(name, rows, number);
    for (std::size_t k = 0; k < out.y.size(); ++k) {
      out.y[k] /= static_cast<double>(std::min(size_, steps_ - k * size_));
    }
    return out;
  }

 private:
  std::size_t steps_, size_;
  double h_;
};

/// Of the steps of a bin the one that took the median time: a pause of the machine is no matter.
const StepRow& medianStep(const std::vector<StepRow>& rows, std::size_t from, std::size_t to) {
  std::vector<std::size_t> order;
  for (std::size_t i = from; i < to; ++i) order.push_back(i);
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
  std::ranges::nth_element(order, middle, {}, [&](std::size_t i) { return rows[i].time.ms; });
  return rows[*middle];
}

/// A chart of the whole run.
Chart emptyChart(const Comparison& comparison, std::string title, std::string y_label) {
  Chart chart{.title = std::move(title), .x_label = "time [s]", .y_label = std::move(y_label)};
  chart.x_low = 0.0;
  chart.x_high = static_cast<double>(comparison.stepsDone()) * comparison.scene().step;
  chart.marks = marksOf(comparison);
  return chart;
}

std::vector<double> sortedTotals(const Chart& chart) {
  std::vector<double> totals(chart.series.front().x.size());
  for (const Series& series : chart.series) {
    std::ranges::transform(totals, series.y, totals.begin(), std::plus());
  }
  std::ranges::sort(totals);
  return totals;
}

/// Ends the axis of a chart of times, and says of what goes on how far it goes.
void endAt(Chart& chart, double high) {
  chart.y_high = high;
  const std::vector<double> totals = sortedTotals(chart);
  if (totals.empty() || totals.back() <= high) return;
  chart.y_label +=
      fmt::format("; bars with a tip are cut off, the highest at {:.2g} ms", totals.back());
}

/// Stacked time per stage in each mode, on one scale. The slowest hundredth is cut off rather than
/// making all else look small.
std::vector<Chart> timeCharts(const Comparison& comparison) {
  const Bins bins(comparison);
  std::vector<Chart> charts;
  double high = 0.0;
  for (const ModeRun& run : comparison.runs()) {
    Chart chart = emptyChart(comparison, name(run.mode), "ms per step");
    if (bins.stepsPerBin() > 1) {
      chart.y_label += fmt::format(", median of {} steps", bins.stepsPerBin());
    }
    chart.stacked = true;
    for (const StageGroup& group : stageGroups()) {
      chart.series.push_back(bins.series(group.name, [&](std::size_t from, std::size_t to) {
        const StepTime& time = medianStep(run.steps, from, to).time;
        double ms = 0.0;
        for (const Stage stage : group.stages) ms += time.stage_ms[static_cast<std::size_t>(stage)];
        return ms;
      }));
    }
    const std::vector<double> totals = sortedTotals(chart);
    if (!totals.empty()) high = std::max(high, totals[totals.size() * 99 / 100]);
    charts.push_back(std::move(chart));
  }
  for (Chart& chart : charts) endAt(chart, high > 0.0 ? 1.2 * high : 1.0);
  return charts;
}

Chart numberChart(const Comparison& comparison, const char* title, const char* label,
                  int StepRow::*number) {
  const Bins bins(comparison);
  Chart chart = emptyChart(comparison, title, label);
  for (const ModeRun& run : comparison.runs()) {
    chart.series.push_back(bins.means(name(run.mode), run.steps, number));
  }
  return chart;
}

Chart eventChart(const Comparison& comparison) {
  const Bins bins(comparison);
  Chart chart = emptyChart(
      comparison, "Merges and unmerges in merge+sleep",
      bins.stepsPerBin() == 1
          ? "events in a step, one kind on the other"
          : fmt::format("events in {} steps, one kind on the other", bins.stepsPerBin()));
  chart.stacked = chart.whole = true;
  const std::vector<StepRow>& rows = comparison.runs().back().steps;
  chart.series = {bins.sums("unmerges", rows, &StepRow::unmerges),
                  bins.sums("merges", rows, &StepRow::merges)};
  return chart;
}

Chart distanceChart(const Comparison& comparison, const char* title, double Distance::*number) {
  Chart chart = emptyChart(comparison, title, "distance, on a logarithmic scale");
  chart.log_y = true;
  chart.y_floor = kLeastDistance;
  chart.y_text = lengthText;
  for (const ModeRun& run : comparison.runs()) {
    Series& series = chart.series.emplace_back(Series{name(run.mode), {}, {}});
    if (run.mode == Mode::Reference) {
      series.name.clear();  // nothing to draw, but the others keep their colours
      continue;
    }
    for (const Distance& distance : run.distances) {
      series.x.push_back(distance.time);
      series.y.push_back(distance.*number);
    }
  }
  return chart;
}

/// Those of one picture.
std::vector<Chart> chartsOf(const Comparison& comparison, std::string_view file) {
  if (file == kTime) return timeCharts(comparison);
  if (file == kCounts) {
    return {
        numberChart(comparison, "Bodies that are simulated", "free bodies and collections, awake",
                    &StepRow::active_bodies),
        numberChart(comparison, "Contacts in the full solve", "contact points", &StepRow::contacts),
        eventChart(comparison)};
  }
  return {
      distanceChart(comparison, "Mean distance of the bodies from the reference", &Distance::mean),
      distanceChart(comparison, "Largest distance of a body from the reference",
                    &Distance::largest)};
}

}  // namespace

std::vector<std::filesystem::path> chartFiles(const std::filesystem::path& folder, bool timings,
                                              bool vector) {
  std::vector<std::filesystem::path> files;
  for (const char* file : {kTime, kCounts, kDistance}) {
    if (file == kTime && !timings) continue;
    files.push_back(folder / (std::string(file) + (vector ? ".svg" : ".png")));
  }
  return files;
}

std::vector<std::string> drawComparison(const Comparison& comparison,
                                        const std::filesystem::path& folder,
                                        const ChartStyle& style) {
  std::vector<std::string> files;
  for (const std::filesystem::path& file : chartFiles(folder, comparison.timings(), style.vector)) {
    const std::vector<Chart> charts = chartsOf(comparison, file.stem().string());
    const int height = style.height * static_cast<int>(charts.size());
    const std::string description =
        fmt::format("{}: {}", comparison.scene().title, file.filename().string());
    if (style.vector) {
      Text text;
      const Drawing drawing = composeCharts(text, charts, 1, style.width, height, style.theme);
      writeFile(file.string(),
                toSvg(drawing, {.width = style.width, .height = height, .title = description}),
                {.everything = true});
    } else {
      Canvas canvas(style.width, height);
      savePng(file, drawCharts(canvas, charts, 1, style.theme),
              {.description = description, .dots_per_inch = kDotsPerInch});
    }
    files.push_back(file.string());
  }
  return files;
}

}  // namespace merge2d
