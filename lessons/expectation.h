#pragma once
/// The predictions of a lesson, checked against its run.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lessons/lesson_trace.h"
#include "lessons/moment.h"

namespace merge2d {

/// A quantity of a recording at a step: "collections", "simulated", "contacts", "inside", "asleep",
/// "kinetic energy", or of one body ("x of a", "y", "angle" in degrees, "speed", "spin" in degrees
/// per second) or of a pair ("force of a and b", "friction", "gap", "points").
class Quantity {
 public:
  Quantity(const Value& place, const Scene& scene);
  double at(const Recording& recording, std::int64_t step) const;
  const std::string& text() const { return text_; }

 private:
  std::string text_, kind_;
  BodyId a_{}, b_{};
};

/// One [[expect]]: exactly one thing that can be true or false.
class Expectation {
 public:
  /// Throws InputError where it is not well formed.
  Expectation(TableReader table, const std::vector<LessonTrace>& traces);

  /// Index of the trace it is about.
  std::size_t trace() const { return trace_; }
  /// Nothing when it holds, else a sentence with its place.
  std::optional<std::string> failure(const Recording& recording) const;

 private:
  using Range = std::pair<double, double>;

  std::optional<std::string> look(const Recording& recording) const;
  std::optional<std::string> lookTogether(const Recording& recording, std::int64_t step) const;

  enum class What { Together, Apart, Free, Asleep, Happens, Never, Measure };
  What what_ = What::Measure;
  std::optional<Value> place_;
  std::size_t trace_ = 0;
  std::optional<Moment> at_, event_;
  std::vector<BodyId> bodies_;
  std::optional<Quantity> quantity_;
  std::optional<Range> between_;
};

}  // namespace merge2d
