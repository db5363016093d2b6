#pragma once
/// run.json: what the frames beside it show, and by which parameters they were made.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/film.h"
#include "app/json.h"
#include "render/frame_digests.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

/// Everything that decides what a frame looks like: program, scene, parameters, picture. Two
/// renderings of one film give the same frames.
Json filmJson(const Scene& scene, const RenderOptions& options, const FrameStyle& style);

/// The run.json of a folder, if there is one and it is ours.
std::optional<Json> readRunFile(const std::filesystem::path& folder);

/// Where a film first differs from the one in a run.json: "parameters/merging/velocity"; empty when
/// they are the same.
std::string difference(const Json& film, const Json& run_file);

/// The digests of the frames that it tells of.
FrameDigests::Map digestsOf(const Json& run_file);

/// Gathers what run.json says and writes it.
class RunFile {
 public:
  RunFile(std::filesystem::path folder, Json film, const Film& frames)
      : folder_(std::move(folder)), film_(std::move(film)), frames_(frames) {}

  /// Takes note of the events of the step that just ended.
  void add(const Snapshot& snapshot);

  /// `description` says in words what is to be seen; `failure` why the rendering ended too early.
  /// Throws IoError.
  void write(bool complete, const FrameDigests& digests, const std::string& description = {},
             const std::string& failure = {});

 private:
  std::filesystem::path folder_;
  Json film_;
  Film frames_;
  std::string events_;  ///< one in each line
};

}  // namespace merge2d
