#include "app/study_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src2d/core/digest.h"
#include "src2d/core/error.h"
#include "src2d/scene/names.h"

namespace merge2d {
namespace {

/// Random numbers that depend on their axis and sample alone, so that one more axis or sample
/// leaves the others as they are. Source of the mixing: SplitMix64 (Steele, Lea, Flood 2014).
class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t sample, const std::string& axis)
      : state_(mixed(mixed(seed) ^ sample * 0x9e3779b97f4a7c15U) ^ digestOf(axis)) {}

  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    return mixed(state_);
  }
  /// From 0 up to, and without, 1.
  double fraction() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(fraction() * static_cast<double>(count)));
  }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

/// The value at a fraction of a range.
std::string valueAt(const StudyAxis::Range& range, double fraction) {
  if (range.whole) {
    const double count = range.to - range.from + 1.0;
    const double value = range.from + std::floor(fraction * count);
    return fmt::format("{}", static_cast<std::int64_t>(std::min(value, range.to)));
  }
  const double value =
      range.logarithmic
          ? std::exp(std::log(range.from) + fraction * (std::log(range.to) - std::log(range.from)))
          : range.from + fraction * (range.to - range.from);
  // Twelve digits are the same with every mathematical library.
  return fmt::format("{}", std::stod(fmt::format("{:.12g}", value)));
}

/// The value of an axis at a fraction of all that it may be.
std::string valueAt(const StudyAxis& axis, double fraction) {
  if (axis.range) return valueAt(*axis.range, fraction);
  const auto count = static_cast<double>(axis.values.size());
  const auto i = static_cast<std::size_t>(fraction * count);
  return axis.values[std::min(i, axis.values.size() - 1)];
}

/// Where each sample lies on an axis, as fractions of it.
std::vector<double> samplesOf(const Study& study, const StudyAxis& axis) {
  std::vector<double> fractions;
  for (std::size_t i = 0; i < study.samples; ++i) {
    fractions.push_back(Draw(study.design_seed, i, axis.key).fraction());
  }
  if (study.design != StudyDesign::Latin) return fractions;
  std::vector<std::size_t> strata(study.samples);
  std::iota(strata.begin(), strata.end(), std::size_t{0});
  for (std::size_t i = strata.size(); i > 1; --i) {
    std::swap(strata[i - 1], strata[Draw(study.design_seed, i, "strata of " + axis.key).below(i)]);
  }
  for (std::size_t i = 0; i < strata.size(); ++i) {
    fractions[i] =
        (static_cast<double>(strata[i]) + fractions[i]) / static_cast<double>(study.samples);
  }
  return fractions;
}

/// The values of all axes, sample by sample.
std::vector<std::vector<std::string>> sampledValues(const Study& study) {
  std::vector<std::vector<std::string>> all(study.samples);
  for (const StudyAxis& axis : study.axes) {
    const std::vector<double> fractions = samplesOf(study, axis);
    for (std::size_t i = 0; i < all.size(); ++i) all[i].push_back(valueAt(axis, fractions[i]));
  }
  return all;
}

/// All combinations of the values, the last axis fastest.
std::vector<std::vector<std::string>> crossedValues(const Study& study) {
  std::vector<std::vector<std::string>> all{{}};
  for (const StudyAxis& axis : study.axes) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& combination : all) {
      for (const std::string& value : axis.values) {
        longer.push_back(combination);
        longer.back().push_back(value);
      }
    }
    all = std::move(longer);
  }
  return all;
}

/// Each sample in a scene and a mode that are drawn, too.
std::vector<StudyRun> drawnRuns(const Study& study) {
  std::vector<StudyRun> runs;
  for (auto& values : sampledValues(study)) {
    const std::size_t i = runs.size();
    const auto& scene =
        study.scenes[Draw(study.design_seed, i, "scene").below(study.scenes.size())];
    const Mode mode = study.modes[Draw(study.design_seed, i, "mode").below(study.modes.size())];
    runs.push_back({scene, mode, std::move(values)});
  }
  return runs;
}

}  // namespace

std::vector<StudyRun> runsOf(const Study& study) {
  const bool grid = study.design == StudyDesign::Grid;
  if (!grid && !study.crossed) return drawnRuns(study);
  const auto combinations = grid ? crossedValues(study) : sampledValues(study);
  std::vector<StudyRun> runs;
  for (const std::string& scene : study.scenes) {
    for (const Mode mode : study.modes) {
      for (const auto& values : combinations) runs.push_back({scene, mode, values});
    }
  }
  return runs;
}

Overrides overridesOf(const Study& study, const StudyRun& run) {
  Overrides overrides;
  for (std::size_t i = 0; i < study.axes.size(); ++i) {
    overrides.emplace_back(study.axes[i].key, run.values[i]);
  }
  return overrides;
}

std::vector<std::string> argumentsOf(const Study& study, const StudyRun& run) {
  std::vector<std::string> words = {"run", run.scene, "--mode", std::string(nameOf(run.mode))};
  for (std::size_t i = 0; i < study.axes.size(); ++i) {
    const std::string& key = study.axes[i].key;
    if (key == "seed") {
      words.insert(words.end(), {"--seed", run.values[i]});
    } else {
      words.insert(words.end(), {"--set", fmt::format("{}={}", key, run.values[i])});
    }
  }
  if (study.steps) words.insert(words.end(), {"--steps", fmt::format("{}", *study.steps)});
  if (study.seconds) words.insert(words.end(), {"--seconds", fmt::format("{}", *study.seconds)});
  if (!study.memory_limit.empty()) {
    words.insert(words.end(), {"--memory-limit", study.memory_limit});
  }
  if (study.reference_error) words.emplace_back("--reference-error");
  words.emplace_back("--json");
  return words;
}

}  // namespace merge2d
