#include "app/study_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "app/output_file.h"
#include "app/provenance.h"
#include "app/simulation.h"
#include "app/usage_error.h"
#include "app/version.h"
#include "src2d/core/digest.h"
#include "src2d/core/error.h"
#include "src2d/scene/names.h"

namespace merge2d {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStudyFormat = "merge2d-study";

[[noreturn]] void failToAppend(const fs::path& file) {
  throw IoError(
      fmt::format("cannot write {}: {}", file.string(), std::generic_category().message(errno)));
}

bool isStudyFolder(const fs::path& folder) {
  std::ifstream in(folder / "study.json");
  const Json json = Json::parse(in, nullptr, false);
  return json.is_object() && json.value("format", Json()) == kStudyFormat;
}

/// Whether an axis has numbers only, so that it can be an axis of a chart.
bool isNumeric(const StudyAxis& axis) {
  for (const std::string& value : axis.values) {
    char* end = nullptr;
    std::strtod(value.c_str(), &end);
    if (end != value.c_str() + value.size()) return false;
  }
  return true;
}

/// Writes study.json.
void describeStudy(const fs::path& folder, const Study& study) {
  Json json;
  json["format"] = kStudyFormat;
  json["version"] = 1;
  json["title"] = study.title;
  json["program"] = "merge2d " MERGE2D_VERSION;
  json["git"] = *kGitDescribe == '\0' ? Json() : Json(kGitDescribe);
  json["scenes"] = study.scenes;
  json["modes"] = Json::array();
  for (const Mode mode : study.modes) json["modes"].push_back(nameOf(mode));
  json["axes"] = Json::array();
  for (const StudyAxis& axis : study.axes) {
    Json one;
    one["key"] = axis.key;
    one["numeric"] = isNumeric(axis);
    one["logarithmic"] = axis.range && axis.range->logarithmic;
    one["drawn"] = study.design != StudyDesign::Grid && axis.range.has_value();
    json["axes"].push_back(one);
  }
  writeFile((folder / "study.json").string(),
            json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n", {.everything = true});
}

/// A scene or a lesson's, as the runs load it.
Scene loadQuietly(const std::string& scene, const Overrides& changes = {}) {
  MessageOptions silent;
  silent.quiet = true;
  SceneOptions options;
  options.scene = scene;
  options.overrides = changes;
  return loadScene(options, Console(silent));
}

/// A scene as it is without changes.
Scene loaded(const Study& study, const std::string& scene) {
  try {
    return loadQuietly(scene);
  } catch (const InputError& error) {
    std::error_code ignored;
    if (fs::exists(scene, ignored)) throw;  // the mistake is in that file
    failAt(study, study.scenes_place, error.what());
  }
}

/// Throws an InputError at the first axis whose first value `scene` does not take.
void failWhereItStands(const Study& study, const std::string& scene, const Overrides& changes) {
  for (std::size_t i = 0; i < study.axes.size(); ++i) {
    try {
      loadQuietly(scene, {changes[i]});
    } catch (const InputError& error) {
      const std::string place = fmt::format("--set {}={}: ", changes[i].first, changes[i].second);
      std::string_view sentence = error.what();
      if (sentence.starts_with(place)) sentence.remove_prefix(place.size());
      failAt(study, study.axes[i].place, fmt::format("{}, in {}", sentence, scene));
    }
  }
}

}  // namespace

fs::path endsFolder(const fs::path& folder) { return folder / "ends"; }

RunKeys::RunKeys(const Study& study) : study_(study) {
  std::vector<std::string> first;
  for (const StudyAxis& axis : study.axes) {
    first.push_back(axis.values.empty() ? fmt::format("{}", axis.range->from) : axis.values[0]);
  }
  for (const std::string& scene : study.scenes) {
    digests_[scene] = digestOfScene(loaded(study, scene));
    const Overrides changes = overridesOf(study, {.scene = scene, .values = first});
    try {
      loadQuietly(scene, changes);
    } catch (const InputError& error) {
      failWhereItStands(study, scene, changes);
      throw InputError(fmt::format("{}: {}", scene, error.what()));  // only together
    }
  }
}

std::string RunKeys::of(const StudyRun& run) const {
  std::string text = digests_.at(run.scene);
  for (const std::string& word : argumentsOf(study_, run)) text += '\0' + word;
  return fmt::format("{:016x}", digestOf(text));
}

void prepareStudyFolder(const fs::path& folder, const Study& study, bool force) {
  makeFolder(folder);
  if (!force && !isStudyFolder(folder)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      if (entry.path().filename().string().starts_with(".merge2d")) continue;
      if (isStudyFolder(folder)) break;  // since a moment ago
      throw UsageError(
          fmt::format("{} has files in it and no study; choose another folder, or say --force",
                      folder.string()));
    }
  }
  describeStudy(folder, study);  // before the rest: from here on the folder is ours
  makeFolder(folder / "rows");
  makeFolder(endsFolder(folder));
}

GrowingTable::GrowingTable(fs::path file, const Study& study, const std::vector<StudyRun>& runs,
                           std::vector<StudyRow>& rows)
    : file_(std::move(file)), table_(study), runs_(runs), rows_(rows) {
  finish();
  descriptor_ = open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ < 0) failToAppend(file_);
}

GrowingTable::~GrowingTable() {
  if (descriptor_ >= 0) close(descriptor_);
}

void GrowingTable::add(std::size_t run) {
  const std::string line = table_.row(run + 1, runs_[run], rows_[run]);
  // In one call: a kill comes before it or after it.
  if (write(descriptor_, line.data(), line.size()) != static_cast<ssize_t>(line.size())) {
    failToAppend(file_);
  }
}

std::string GrowingTable::whole() const {
  std::string text = table_.head();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!rows_[i].key.empty()) text += table_.row(i + 1, runs_[i], rows_[i]);
  }
  return text;
}

void GrowingTable::finish() {
  writeFile(file_.string(), whole(), {.everything = true, .ours = kStudyCsvStart});
}

}  // namespace merge2d
