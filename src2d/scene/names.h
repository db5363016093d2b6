#pragma once
/// The words that stand for enumerators in scene files, on the command line and in traces.

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "src2d/scene/scene.h"

namespace merge2d {

template <class E>
using Named = std::pair<std::string_view, E>;

/// The words of an enumeration, in its order.
template <class E>
inline constexpr std::array<Named<E>, 0> kNames{};
template <>
inline constexpr std::array<Named<Motion>, 3> kNames<Motion>{
    {{"dynamic", Motion::Dynamic}, {"pinned", Motion::Pinned}, {"scripted", Motion::Scripted}}};
template <>
inline constexpr std::array<Named<Mode>, 4> kNames<Mode>{{{"reference", Mode::Reference},
                                                          {"sleep", Mode::Sleep},
                                                          {"merge", Mode::Merge},
                                                          {"merge+sleep", Mode::MergeSleep}}};
template <>
inline constexpr std::array<Named<MergingRule>, 2> kNames<MergingRule>{
    {{"default", MergingRule::Default}, {"paper", MergingRule::Paper}}};
template <>
inline constexpr std::array<Named<UnmergingRule>, 2> kNames<UnmergingRule>{
    {{"default", UnmergingRule::Default}, {"paper", UnmergingRule::Paper}}};
template <>
inline constexpr std::array<Named<SolverMethod>, 4> kNames<SolverMethod>{
    {{"nncg", SolverMethod::Nncg},
     {"block", SolverMethod::Block},
     {"pgs", SolverMethod::Pgs},
     {"newton", SolverMethod::Newton}}};
template <>
inline constexpr std::array<Named<Stabilisation>, 2> kNames<Stabilisation>{
    {{"baumgarte", Stabilisation::Baumgarte}, {"post", Stabilisation::Post}}};
template <>
inline constexpr std::array<Named<CycleCriterion>, 3> kNames<CycleCriterion>{
    {{"off", CycleCriterion::Off},
     {"triangle", CycleCriterion::Triangle},
     {"rigid", CycleCriterion::Rigid}}};
template <>
inline constexpr std::array<Named<Metric>, 2> kNames<Metric>{
    {{"corners", Metric::Corners}, {"naive", Metric::Naive}}};

template <>
inline constexpr std::array<Named<JointKind>, 4> kNames<JointKind>{
    {{"revolute", JointKind::Revolute},
     {"weld", JointKind::Weld},
     {"distance", JointKind::Distance},
     {"prismatic", JointKind::Prismatic}}};

template <class E>
concept HasNames = !kNames<E>.empty();

/// "nncg" for SolverMethod::Nncg.
template <HasNames E>
constexpr std::string_view nameOf(E value) {
  for (const auto& [name, candidate] : kNames<E>) {
    if (candidate == value) return name;
  }
  return "?";
}

/// SolverMethod::Nncg for "nncg".
template <HasNames E>
constexpr std::optional<E> valueOf(std::string_view name) {
  for (const auto& [candidate, value] : kNames<E>) {
    if (candidate == name) return value;
  }
  return std::nullopt;
}

/// All words of an enumeration.
template <HasNames E>
constexpr auto namesOf() {
  std::array<std::string_view, kNames<E>.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kNames<E>[i].first;
  return names;
}

}  // namespace merge2d
