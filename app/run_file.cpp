#include "app/run_file.h"

#include <fmt/format.h>

#include <fstream>

#include "app/output_file.h"
#include "app/provenance.h"
#include "app/version.h"
#include "render/sequence.h"
#include "src2d/trace/trace_writer.h"

namespace merge2d {
namespace {

constexpr const char* kFormat = "merge2d-run";
constexpr int kVersion = 1;

Json picture(const RenderOptions& options, const FrameStyle& style) {
  Json out;
  out["width"] = style.width;
  out["height"] = style.height;
  out["fps"] = options.framesPerSecond();
  out["theme"] = style.theme.name;
  out["transparent"] = style.transparent;
  if (style.format == FrameFormat::Svg) out["format"] = "svg";
  out["overlays"] = Json::array();
  for (const OverlayEntry& entry : kOverlayTable) {
    if (style.overlays.has(entry.overlay)) out["overlays"].push_back(entry.name);
  }
  return out;
}

/// The settings that two renderings of one film must share.
Json fixedPart(const Json& film) {
  Json fixed;
  for (const char* key : {"program", "scene", "mode", "parameters", "picture", "digest"}) {
    fixed[key] = film.value(key, Json());
  }
  return fixed;
}

}  // namespace

Json filmJson(const Scene& scene, const RenderOptions& options, const FrameStyle& style) {
  Json film;
  film["format"] = kFormat;
  film["version"] = kVersion;
  film["program"] = "merge2d " MERGE2D_VERSION;
  film["git"] = *kGitDescribe == '\0' ? Json() : Json(kGitDescribe);
  film["scene"] = scene.name;
  film["title"] = scene.title;
  film["digest"] = digestOfScene(scene);
  film["mode"] = name(options.mode);
  film["seed"] = scene.seed;
  film["h"] = scene.step;
  film["parameters"] = parametersJson(scene);
  film["picture"] = picture(options, style);
  return film;
}

std::optional<Json> readRunFile(const std::filesystem::path& folder) {
  std::error_code missing;
  if (!std::filesystem::is_regular_file(folder / "run.json", missing)) return std::nullopt;
  std::ifstream in(folder / "run.json");
  Json run = Json::parse(in, nullptr, false);
  if (!run.is_object() || run.value("format", Json()) != kFormat) return std::nullopt;
  return run;
}

std::string difference(const Json& film, const Json& run_file) {
  const Json changes = Json::diff(fixedPart(film), fixedPart(run_file));
  if (changes.empty()) return {};
  const std::string path = changes[0]["path"].get<std::string>().substr(1);
  return path == "digest" ? "the scene" : path;
}

FrameDigests::Map digestsOf(const Json& run_file) {
  FrameDigests::Map digests;
  const Json noted = run_file.value("digests", Json::object());
  for (const auto& [name, digest] : noted.items()) {
    const std::optional<std::int64_t> frame = frameNumber(name);
    if (frame && digest.is_string()) digests[*frame] = digest;
  }
  return digests;
}

void RunFile::add(const Snapshot& snapshot) {
  for (const Event& event : snapshot.events) {
    JsonText text;
    writeEvent(text, event, &snapshot);
    events_ += fmt::format("{}\n    {}", events_.empty() ? "" : ",", text.text());
  }
}

void RunFile::write(bool complete, const FrameDigests& digests, const std::string& description,
                    const std::string& failure) {
  Json out = film_;
  const bool vector = film_["picture"].contains("format");
  out["steps"] = frames_.steps;
  out["frames"] = {{"first", frames_.from},
                   {"last", frames_.to},
                   {"pattern", vector ? "frame_%06d.svg" : "frame_%06d.png"}};
  out["complete"] = complete;
  out["digests"] = Json::object();
  for (const auto& [frame, digest] : digests.all()) {
    out["digests"][frameName(frame, vector ? FrameFormat::Svg : FrameFormat::Png)] = digest;
  }
  if (!description.empty()) out["description"] = description;
  if (!failure.empty()) out["failure"] = failure;
  std::string text = out.dump(2, ' ', false, Json::error_handler_t::replace);
  text.erase(text.size() - 2);  // "\n}"
  text += fmt::format(",\n  \"events\": [{}\n  ]\n}}\n", events_);
  writeFile(folder_ / "run.json", text, {.everything = true});
}

}  // namespace merge2d
