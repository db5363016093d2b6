#include "app/study_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "app/output_file.h"
#include "app/provenance.h"
#include "src2d/scene/names.h"
#include "src2d/trace/csv.h"

namespace merge2d {
namespace {

constexpr const char* kRowFormat = "merge2d-study-row";

/// A column of the table, and where its value is in the result of `run --json`.
struct ResultColumn {
  const char* name;
  const char* path;  ///< a JSON pointer
};

constexpr ResultColumn kResultColumns[] = {
    {"steps", "/steps"},
    {"time", "/time"},
    {"bodies", "/bodies"},
    {"active_bodies", "/active_bodies"},
    {"collections", "/collections"},
    {"asleep", "/asleep"},
    {"contacts", "/contacts"},
    {"internal_contacts", "/internal_contacts"},
    {"merges", "/merges"},
    {"unmerges", "/unmerges"},
    {"unmerges_broken", "/unmerges_by_reason/broken"},
    {"unmerges_sliding", "/unmerges_by_reason/sliding"},
    {"unmerges_relative_motion", "/unmerges_by_reason/relative-motion"},
    {"unmerges_user", "/unmerges_by_reason/user"},
    {"max_penetration", "/max_penetration"},
    {"kinetic_energy", "/kinetic_energy"},
    {"potential_energy", "/potential_energy"},
    {"reference_error_mean", "/reference_error/mean"},
    {"reference_error_max", "/reference_error/max"},
    {"ms_per_step_mean", "/ms_per_step/mean"},
    {"ms_per_step_median", "/ms_per_step/median"},
    {"cpu_seconds", "/provenance/cpu_seconds"},
    {"wall_seconds", "/provenance/wall_seconds"},
    {"program", "/provenance/program"},
    {"git", "/provenance/git"},
    {"digest", "/provenance/digest"},
};

/// As a field of CSV: nothing for null.
std::string fieldOf(const Json& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return csvField(value.get<std::string>());
  return csvField(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Json at(const Json& result, const std::string& path) {
  const Json::json_pointer pointer(path);
  return result.is_object() && result.contains(pointer) ? result[pointer] : Json();
}

/// "merging.velocity" as "/provenance/parameters/merging/velocity".
std::string pathOfParameter(const std::string& key) {
  std::string path = key;
  std::ranges::replace(path, '.', '/');
  return "/provenance/parameters/" + path;
}

/// Every parameter by its key.
std::vector<std::string> allParameters() {
  std::vector<std::string> keys;
  const Json parameters = parametersJson(Scene{});
  for (const auto& [name, value] : parameters.items()) {
    if (value.is_object()) {
      for (const auto& inner : value.items()) keys.push_back(name + "." + inner.key());
    } else {
      keys.push_back(name);
    }
  }
  return keys;
}

/// A value of an axis as the table shows it: a text without its quotes.
std::string shownValue(const std::string& text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return csvField(quoted ? text.substr(1, text.size() - 2) : text);
}

std::filesystem::path rowFile(const std::filesystem::path& folder, const std::string& key) {
  return folder / "rows" / (key + ".json");
}

}  // namespace

void writeRow(const std::filesystem::path& folder, const StudyRow& row) {
  Json json;
  json["format"] = kRowFormat;
  json["version"] = 1;
  json["key"] = row.key;
  json["command"] = row.command;
  json["exit_code"] = row.exit_code;
  json["message"] = row.message;
  json["process"] = {{"wall_seconds", row.wall_seconds},
                     {"cpu_seconds", row.cpu_seconds},
                     {"memory_bytes", row.memory_bytes}};
  json["result"] = row.result;
  writeFile(rowFile(folder, row.key).string(),
            json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n", {.everything = true});
}

std::optional<StudyRow> readRow(const std::filesystem::path& folder, const std::string& key) try {
  std::ifstream in(rowFile(folder, key));
  if (!in) return std::nullopt;
  const Json json = Json::parse(in);
  if (json.at("format") != kRowFormat || json.at("key") != key) return std::nullopt;
  StudyRow row{.key = key, .command = json.at("command"), .exit_code = json.at("exit_code")};
  row.message = json.at("message");
  row.wall_seconds = json.at("process").at("wall_seconds");
  row.cpu_seconds = json.at("process").at("cpu_seconds");
  row.memory_bytes = json.at("process").at("memory_bytes");
  row.result = json.at("result");
  return row;
} catch (const Json::exception&) {
  return std::nullopt;  // cut off, or of somebody else
}

StudyTable::StudyTable(const Study& study) : study_(study), parameters_(allParameters()) {
  for (const StudyAxis& axis : study.axes) std::erase(parameters_, axis.key);
}

std::string StudyTable::head() const {
  std::string line(kStudyCsvStart.substr(0, kStudyCsvStart.size() - 1));
  const auto add = [&](const std::string& name) { line += "," + csvField(name); };
  for (const StudyAxis& axis : study_.axes) add(axis.key);
  for (const ResultColumn& column : kResultColumns) add(column.name);
  for (const std::string& key : parameters_) add(key);
  for (const char* name : {"key", "process_cpu_seconds", "process_wall_seconds",
                           "process_memory_bytes", "exit_code", "message"}) {
    add(name);
  }
  return line + "\n";
}

std::string StudyTable::row(std::size_t number, const StudyRun& run, const StudyRow& row) const {
  std::string line = fmt::format("{},{},{}", number, csvField(run.scene), nameOf(run.mode));
  for (const std::string& value : run.values) line += "," + shownValue(value);
  for (const ResultColumn& column : kResultColumns) {
    line += "," + fieldOf(at(row.result, column.path));
  }
  for (const std::string& key : parameters_) {
    line += "," + fieldOf(at(row.result, pathOfParameter(key)));
  }
  return line + fmt::format(",{},{},{},{},{},{}\n", row.key, row.cpu_seconds, row.wall_seconds,
                            row.memory_bytes, row.exit_code, csvField(row.message));
}

}  // namespace merge2d
