#pragma once
/// A study: the content of its file, and the runs that follow from it.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src2d/scene/load.h"
#include "src2d/scene/settings.h"

namespace merge2d {

/// A place in the text of a study.
struct StudyPlace {
  std::uint32_t line = 0, column = 0;  ///< from 1
};

/// A quantity that a study varies, and the values it takes: texts as `--set` understands them. A
/// random design draws from a range between its bounds instead.
struct StudyAxis {
  std::string key{};                  ///< "merging.velocity", "seed"
  std::vector<std::string> values{};  ///< of a list, or of a range with a count
  struct Range {
    double from = 0.0, to = 0.0;
    bool logarithmic = false;
    bool whole = false;  ///< whole numbers only
  };
  std::optional<Range> range{};
  StudyPlace place{};
};

/// How runs are chosen.
enum class StudyDesign {
  Grid,    ///< every combination
  Random,  ///< every axis of every sample by itself
  Latin,   ///< random, but each axis is covered evenly: a Latin hypercube
};

/// A study file, docs/studies.md.
struct Study {
  static constexpr std::size_t kMostRuns = 1'000'000;

  std::string title{};
  std::string name{}, text{};         ///< of its file
  std::vector<std::string> scenes{};  ///< names, or files as they are found from here
  StudyPlace scenes_place{};
  std::vector<Mode> modes{};
  std::vector<StudyAxis> axes{};  ///< [parameters], then the seed where it varies
  StudyDesign design = StudyDesign::Grid;
  std::size_t samples = 0;  ///< of designs other than a grid
  std::uint64_t design_seed = 1;
  bool crossed = true;  ///< every sample in every scene and mode; else drawn as well
  std::optional<std::int64_t> steps{};  ///< of each run; none: `seconds`, or as the scene says
  std::optional<double> seconds{};      ///< [s]
  bool reference_error = true;          ///< how far each run ends from the reference
  std::string memory_limit{};           ///< of each run: "1GB"; empty: the program's default
  double time_limit = 0.0;              ///< of each run [s]; 0: none
};

/// One run of a study.
struct StudyRun {
  std::string scene{};
  Mode mode = Mode::MergeSleep;
  std::vector<std::string> values{};  ///< one for each axis
};

/// Reads a study file. Throws InputError with the place of a mistake, IoError.
Study readStudy(const std::filesystem::path& file);

/// Throws the InputError `sentence` at a place of a study's file.
[[noreturn]] void failAt(const Study& study, const StudyPlace& place, std::string_view sentence);

/// The runs in their order: scene by scene, mode by mode, the last axis fastest; of samples, one
/// after another. More samples of one seed begin with the same ones, but for Latin hypercubes.
std::vector<StudyRun> runsOf(const Study& study);

/// The changes of the scene that a run makes.
Overrides overridesOf(const Study& study, const StudyRun& run);

/// The arguments of `merge2d` for a run, without the program's name: "run", "pile", "--mode", …
std::vector<std::string> argumentsOf(const Study& study, const StudyRun& run);

}  // namespace merge2d
