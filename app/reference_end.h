#pragma once
/// Where bodies are at the end of a run in reference mode, which other modes are judged by.

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "app/simulation.h"

namespace merge2d {

/// The centres of mass of the dynamic bodies after the last step.
struct BodyCenters {
  struct One {
    BodyId id{};
    Vec2 x = Vec2::Zero();  ///< [m]
  };
  std::vector<One> bodies{};  ///< ascending ids
};

BodyCenters centersOf(const World& world);

/// How far bodies are from where they are in the reference [m].
struct ReferenceError {
  double mean = 0.0, max = 0.0;
};

/// Over the bodies that are in both; zero where there are none.
ReferenceError errorBetween(const BodyCenters& reference, const BodyCenters& run);

/// The ends of reference runs in a folder, one file each. Thresholds of merging and sleep do not
/// change the reference, so that the runs of a study share most of its ends. Several processes may
/// use one folder at once.
class ReferenceFolder {
 public:
  /// An empty path keeps nothing.
  explicit ReferenceFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// From the folder; else simulates `steps` steps and keeps the end. Throws SimulationError,
  /// Interrupted or IoError.
  BodyCenters endOf(const std::shared_ptr<const Scene>& scene, std::int64_t steps) const;

  /// Keeps an end that is known already.
  void keep(const Scene& scene, std::int64_t steps, const BodyCenters& end) const;

 private:
  std::filesystem::path fileOf(const Scene& scene, std::int64_t steps) const;

  std::filesystem::path folder_;
};

}  // namespace merge2d
