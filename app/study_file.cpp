/// Reading study files.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <sstream>

#include "app/study_design.h"
#include "src2d/core/error.h"
#include "src2d/scene/file.h"
#include "src2d/scene/names.h"
#include "src2d/scene/toml_parse.h"
#include "src2d/scene/toml_reader.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostValues = 100'000;  // of one axis

/// A value as `--set` takes it: a word without quotes, everything else as TOML.
std::string overrideText(const Value& value, const toml::node& node) {
  if (const auto* text = node.as_string()) {
    const std::string& word = text->get();
    const bool plain = !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0 &&
                       std::ranges::all_of(word, [](char c) {
                         return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
                                c == '-' || c == '+';
                       });
    if (plain && word != "true" && word != "false" && word != "inf" && word != "nan") return word;
    std::string quoted = "\"";
    for (const char c : word) {
      if (c == '"' || c == '\\') quoted += '\\';
      if (std::iscntrl(static_cast<unsigned char>(c)) != 0) value.fail("a text here is one line");
      quoted += c;
    }
    return quoted + "\"";
  }
  if (node.is_integer()) return fmt::format("{}", value.integer(kAnyNumber));
  if (node.is_floating_point()) return fmt::format("{}", value.number());
  if (node.is_boolean()) return value.boolean() ? "true" : "false";
  if (const auto* array = node.as_array()) {
    std::string list;
    const std::vector<Value> elements = value.elements("a list");
    for (std::size_t i = 0; i < elements.size(); ++i) {
      list += (i == 0 ? "" : ", ") + overrideText(elements[i], (*array)[i]);
    }
    return "[" + list + "]";
  }
  value.failMustBe("a number, a text, true or false, or a list of these");
}

/// { from, to, count, scale } or { from, to, by }.
StudyAxis readRange(const std::string& key, const Value& value, const toml::node& node,
                    bool random) {
  StudyAxis axis{.key = key};
  TableReader table = value.table();
  const auto from = table.require("from"), to = table.require("to");
  std::string scale = "linear";
  table.read("scale", scale);
  if (scale != "linear" && scale != "log") {
    table.failAt("scale", "'scale' must be \"linear\" or \"log\"");
  }
  const auto count = table.get("count"), by = table.get("by");
  table.done();
  const toml::table& both = *node.as_table();
  StudyAxis::Range range{.from = from->number(),
                         .to = to->number(),
                         .logarithmic = scale == "log",
                         .whole = both.get("from")->is_integer() && both.get("to")->is_integer()};
  if (range.to < range.from) to->fail("'to' must not be less than 'from'");
  if (range.logarithmic && range.from <= 0.0) from->fail("on a log scale 'from' must be positive");
  axis.range = range;
  if (count && by) by->fail("give 'count' or 'by', not both");
  if (random) {
    if (by) by->fail("a random design has no 'by': it draws from the whole range");
    if (count) count->fail("a random design has no 'count': it draws 'samples' of [design]");
    return axis;
  }
  std::vector<double> numbers;
  if (count) {
    const auto n = count->integer({1.0, static_cast<double>(kMostValues), "from 1 to 100000"});
    for (std::int64_t i = 0; i < n; ++i) {
      const double part = n == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(n - 1);
      double number = range.from + part * (range.to - range.from);
      if (range.logarithmic) number = range.from * std::pow(range.to / range.from, part);
      if (i > 0 && i == n - 1) number = range.to;
      // Twelve digits: 0.3, not 0.30000000000000004.
      numbers.push_back(std::stod(fmt::format("{:.12g}", number)));
    }
  } else if (by || range.whole) {
    if (range.logarithmic) table.failAt("scale", "a log scale needs 'count'");
    const double step = by ? by->number() : 1.0;
    if (step <= 0.0) by->fail("'by' must be positive");
    const double n = std::floor((range.to - range.from) / step + 1e-9) + 1.0;
    if (n > static_cast<double>(kMostValues)) value.fail("these are more than 100000 values");
    for (double i = 0.0; i < n; i += 1.0) {
      numbers.push_back(std::stod(fmt::format("{:.12g}", range.from + i * step)));
    }
  } else {
    value.fail(fmt::format("the range of '{}' needs a 'count' or a 'by'", key));
  }
  for (const double number : numbers) {
    const bool whole = range.whole && number == std::round(number);
    axis.values.push_back(whole ? fmt::format("{}", static_cast<std::int64_t>(number))
                                : fmt::format("{}", number));
  }
  return axis;
}

StudyPlace placeOf(const toml::node& node) {
  return {node.source().begin.line, node.source().begin.column};
}

StudyAxis readAxis(const std::string& key, const Value& value, const toml::node& node,
                   bool random) {
  StudyAxis axis{.key = key};
  if (node.is_table()) axis = readRange(key, value, node, random);
  axis.place = placeOf(node);
  if (node.is_table()) return axis;
  const auto* array = node.as_array();
  if (array == nullptr) {
    axis.values.push_back(overrideText(value, node));
    return axis;
  }
  const std::vector<Value> elements = value.elements("a list of values");
  if (elements.empty()) value.fail(fmt::format("'{}' has no values", key));
  for (std::size_t i = 0; i < elements.size(); ++i) {
    axis.values.push_back(overrideText(elements[i], (*array)[i]));
    if (std::ranges::count(axis.values, axis.values.back()) > 1) {
      elements[i].fail(fmt::format("'{}' has this value twice", key));
    }
  }
  return axis;
}

/// [parameters]: a table inside it is a part of a key, unless it is a range.
void readParameters(const SourceText& source, const toml::table& table, const std::string& prefix,
                    bool random, std::vector<StudyAxis>& axes) {
  // In the order of the file, which tables of toml++ do not keep.
  std::vector<std::pair<std::string, const toml::node*>> entries;
  for (const auto& [key, node] : table) entries.emplace_back(key.str(), &node);
  std::ranges::stable_sort(entries, {}, [](const auto& entry) {
    const auto& at = entry.second->source().begin;
    return std::pair(at.line, at.column);
  });
  for (const auto& [name, node] : entries) {
    const std::string key = prefix + name;
    const toml::table* inner = node->as_table();
    if (inner != nullptr && !inner->contains("from") && !inner->contains("to")) {
      readParameters(source, *inner, key + ".", random, axes);
      continue;
    }
    const Value value(source, *node, key, "[parameters]");
    if (key == "seed") value.fail("seeds stand at the top: seeds = [1, 2, 3]");
    if (key == "duration") value.fail("a study's 'seconds' or 'steps' say how long runs are");
    axes.push_back(readAxis(key, value, *node, random));
  }
}

std::vector<std::string> readTexts(const Value& value) {
  std::vector<std::string> texts;
  for (const Value& element : value.elements("a list of texts")) texts.push_back(element.text());
  if (texts.empty()) value.fail("this list is empty");
  return texts;
}

/// A file is looked for beside the study; a name without a file there may be a built-in one.
std::string sceneFromHere(const std::string& scene, const fs::path& study) {
  const fs::path beside = study.parent_path() / scene;
  std::error_code ignored;
  const bool bare = !fs::path(scene).has_extension() && !fs::path(scene).has_parent_path();
  return !bare && fs::path(scene).is_relative() && fs::exists(beside, ignored) ? beside.string()
                                                                               : scene;
}

void readDesign(TableReader& root, Study& study) {
  auto table = root.table("design");
  if (!table) return;
  std::string kind = "grid";
  table->read("kind", kind);
  if (kind == "random") study.design = StudyDesign::Random;
  if (kind == "latin") study.design = StudyDesign::Latin;
  if (study.design == StudyDesign::Grid && kind != "grid") {
    table->failAt("kind", fmt::format("'kind' must be \"grid\", \"random\" or \"latin\", but is "
                                      "\"{}\"",
                                      kind));
  }
  if (study.design != StudyDesign::Grid) {
    const auto samples = table->require("samples");
    if (samples) {
      study.samples = static_cast<std::size_t>(
          samples->integer({1.0, static_cast<double>(Study::kMostRuns), "from 1 to 1000000"}));
    }
    table->read("seed", study.design_seed,
                Range{0.0, static_cast<double>(1LL << 53), "a whole number of 0 or more"});
    table->read("crossed", study.crossed);
  }
  table->done();
}

void readLength(TableReader& root, Study& study) {
  if (const auto steps = root.get("steps")) {
    study.steps = steps->integer({0.0, 1e9, "from 0 to 1000000000"});
  }
  if (const auto seconds = root.get("seconds")) {
    study.seconds = seconds->number({0.0, 1e12, "0 or more"});
  }
  if (study.steps && study.seconds) {
    root.failAt("seconds", "'steps' and 'seconds' both say how long runs are; give one of them");
  }
}

/// The number of runs of a grid; a wrong file must not fill the memory.
void requireFewRuns(TableReader& root, const Study& study) {
  double runs = study.crossed || study.design == StudyDesign::Grid
                    ? static_cast<double>(study.scenes.size() * study.modes.size())
                    : 1.0;
  if (study.design != StudyDesign::Grid) runs *= static_cast<double>(study.samples);
  for (const StudyAxis& axis : study.axes) {
    if (study.design == StudyDesign::Grid) runs *= static_cast<double>(axis.values.size());
  }
  if (runs <= static_cast<double>(Study::kMostRuns)) return;
  root.fail(fmt::format("these are {:.0f} runs; a study has at most {}", runs, Study::kMostRuns));
}

void readModes(TableReader& root, Study& study) {
  const auto modes = root.get("modes");
  if (!modes) {
    study.modes = {Mode::MergeSleep};
    return;
  }
  for (const Value& mode : modes->elements("a list of modes")) {
    study.modes.push_back(mode.named<Mode>());
    if (std::ranges::count(study.modes, study.modes.back()) > 1)
      mode.fail("this mode is there twice");
  }
  if (study.modes.empty()) modes->fail("'modes' is empty");
}

}  // namespace

void failAt(const Study& study, const StudyPlace& place, std::string_view sentence) {
  const SourceText source(study.name, study.text);
  throw InputError(source.message({place.line, place.column}, sentence));
}

Study readStudy(const fs::path& file) {
  const std::string bytes = readFile(file, {.what = "a study file"});
  const SourceText source(nameOfFile(file), bytes);
  const toml::table table = parseToml(source);
  TableReader root(source, table, "the study");
  if (table.contains("body")) root.failAt("body", "this is a scene; a study names its 'scenes'");
  Study study;
  study.name = source.name();
  study.text = bytes;
  study.title = file.stem().string();
  std::int64_t format = 1;
  root.read("format", format, Range{1.0, 1.0, "1, the one version there is"});
  root.read("title", study.title);
  if (const auto scenes = root.require("scenes")) {
    study.scenes = readTexts(*scenes);
    study.scenes_place = placeOf(*table.get("scenes"));
  }
  for (std::string& scene : study.scenes) scene = sceneFromHere(scene, file);
  readModes(root, study);
  readLength(root, study);
  root.read("reference_error", study.reference_error);
  root.read("memory_limit", study.memory_limit);
  root.read("time_limit", study.time_limit, Range{0.0, 1e9, "0 or more"});
  readDesign(root, study);
  const bool random = study.design != StudyDesign::Grid;
  if (root.table("parameters")) {
    readParameters(source, *table.get_as<toml::table>("parameters"), "", random, study.axes);
  }
  if (const auto seeds = root.get("seeds")) {
    study.axes.push_back(readAxis("seed", *seeds, *table.get("seeds"), random));
  }
  root.done();
  requireFewRuns(root, study);
  return study;
}

}  // namespace merge2d
