#include "app/study_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/statistics.h"
#include "app/study_charts.h"
#include "lessons/page.h"

namespace merge2d {
namespace {

constexpr const char* kStyle = R"(
body { font: 16px/1.5 "DejaVu Sans", Verdana, sans-serif; color: #16202a; background: #fff;
       max-width: 1120px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; } h2 { font-size: 1.25em; margin-top: 2.2em; } h3 { font-size: 1em; }
svg { width: 100%; height: auto; display: block; }
.table { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.9em; }
th, td { padding: 0.25em 0.8em; text-align: right; border-bottom: 1px solid #d5dce3; }
th[scope=row], td.text, th.text { text-align: left; }
p.scale { display: flex; align-items: center; gap: 0.5em; font-size: 0.85em; }
p.scale span.ramp { width: 12em; height: 0.9em; display: inline-block;
  background: linear-gradient(to right, #f2f6fb, #bcd4ea, #74a9d3, #2f78b3, #0b3d73); }
)";

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

/// The number of runs, and their program.
std::string introduction(const StudyData& data) {
  std::size_t failed = 0;
  double seconds = 0.0;
  for (std::size_t row = 0; row < data.rows(); ++row) {
    failed += data.failed(row) ? 1 : 0;
    seconds += data.number(row, "process_cpu_seconds").value_or(0.0);
  }
  std::string out = fmt::format("<p>{} runs, {} of them failed; {:.3g} s of processor time.</p>\n",
                                data.rows(), failed, seconds);
  const auto programs = data.valuesOf("program"), states = data.valuesOf("git");
  out +=
      fmt::format("<p>Made by {}{}. Every number is in <a href=\"study.csv\">study.csv</a>.</p>\n",
                  escapedHtml(joined(programs)),
                  states.empty() ? "" : ", sources " + escapedHtml(joined(states)));
  if (programs.size() > 1 || states.size() > 1) {
    out += "<p><strong>Not all runs are of one version of the program.</strong></p>\n";
  }
  return out;
}

/// Means and medians by scene and mode.
std::string summaryTable(const StudyData& data, const std::vector<Measure>& measures) {
  std::string out =
      "<div class=\"table\"><table><caption>Medians</caption>\n<thead><tr>"
      "<th scope=\"col\" class=\"text\">scene</th>"
      "<th scope=\"col\" class=\"text\">mode</th><th scope=\"col\">runs</th>";
  for (const Measure& measure : measures) {
    out += fmt::format("<th scope=\"col\">{}</th>", escapedHtml(measure.title));
  }
  out += "</tr></thead>\n<tbody>\n";
  for (const StudyGroup& group : groupsOf(data)) {
    out += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"text\">{}</td><td>{}</td>",
                       escapedHtml(group.scene), escapedHtml(group.mode), group.rows.size());
    for (const Measure& measure : measures) {
      std::vector<double> values;
      for (const std::size_t row : group.rows) {
        if (const auto value = data.number(row, measure.column)) {
          values.push_back(*value * measure.scale);
        }
      }
      out += values.empty() ? "<td></td>" : fmt::format("<td>{:.4g}</td>", median(values));
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string failures(const StudyData& data) {
  constexpr std::size_t kMost = 50;
  std::string rows;
  std::size_t count = 0;
  for (std::size_t row = 0; row < data.rows(); ++row) {
    if (!data.failed(row) || ++count > kMost) continue;
    rows += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"text\">{}</td><td class=\"text\">{}</td>"
        "<td>{}</td><td class=\"text\">{}</td></tr>\n",
        escapedHtml(data.text(row, "run")), escapedHtml(data.text(row, "scene")),
        escapedHtml(data.text(row, "mode")), escapedHtml(data.text(row, "exit_code")),
        escapedHtml(data.text(row, "message")));
  }
  if (count == 0) return "";
  std::string out =
      "<h2>Runs that failed</h2>\n<div class=\"table\"><table><thead><tr>"
      "<th scope=\"col\" class=\"text\">run</th><th scope=\"col\" "
      "class=\"text\">scene</th><th scope=\"col\" class=\"text\">mode</th>"
      "<th scope=\"col\">exit code</th><th scope=\"col\" class=\"text\">message</th>"
      "</tr></thead><tbody>\n" +
      rows + "</tbody></table></div>\n";
  if (count > kMost) out += fmt::format("<p>… and {} more.</p>\n", count - kMost);
  return out;
}

/// Pairs of axes, the first ones first.
std::vector<std::pair<std::size_t, std::size_t>> pairsOf(std::size_t axes) {
  constexpr std::size_t kMost = 3;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < axes; ++i) {
    for (std::size_t k = i + 1; k < axes; ++k) pairs.emplace_back(i, k);
  }
  pairs.resize(std::min(pairs.size(), kMost));
  return pairs;
}

std::string chartsOf(const StudyData& data, const Measure& measure, std::size_t number) {
  std::string out = fmt::format("<h2>{}</h2>\n", escapedHtml(measure.title));
  int charts = 0;
  const auto id = [&] { return fmt::format("m{}c{}", number, charts++); };
  const auto& axes = data.axes();
  for (const auto& [x, y] : pairsOf(axes.size())) {
    out += fmt::format("<h3>Over {} and {}, means</h3>\n", escapedHtml(axes[x].key),
                       escapedHtml(axes[y].key));
    out += "<p class=\"scale\">less <span class=\"ramp\"></span> more</p>\n";
    out += heatMapsSvg(data, measure, axes[x], axes[y], id());
  }
  for (const StudyPlaces& axis : axes) {
    out += fmt::format("<h3>Over {}, means</h3>\n", escapedHtml(axis.key));
    out += linesSvg(data, measure, axis, id());
  }
  out += "<h3>Distribution</h3>\n";
  return out + distributionSvg(data, measure, id());
}

}  // namespace

std::string studyReport(const StudyData& data) {
  const std::vector<Measure> measures = measuresOf(data);
  std::string out = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"generator\" content=\"merge2d study\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
      escapedHtml(data.title()), kStyle);
  out += introduction(data);
  out += summaryTable(data, measures);
  for (std::size_t i = 0; i < measures.size(); ++i) out += chartsOf(data, measures[i], i);
  return out + failures(data) + "</body>\n</html>\n";
}

}  // namespace merge2d
