#pragma once
/// Questions that a page asks before it shows. The simulation answers them, except for those whose
/// choices are words.

#include <string>
#include <vector>

#include "lessons/expectation.h"
#include "lessons/moment.h"

namespace merge2d {

class JsonText;

/// [part.question]. Exactly one of
///   choices = ["…", "…"], answer = 2     words; `because` tells why
///   threshold = "relative-motion"        is its value for the `pair` above or below the limit?
///   freed = true                         which bodies are in a collection no longer?
///   contact = true                       between which two bodies does it happen?
///   collections = true                   how many are there afterwards?
///   measure = "speed of a", tolerance    a number, in `unit`
/// and `reveal`, the moment at which the answer can be seen.
class Question {
 public:
  Question(TableReader table, const Scene& scene);

  /// Its text, options, the right ones, and the sentence that explains them.
  void write(JsonText& out, const Recording& recording, std::int64_t asked_at) const;
  /// When the answer can be seen.
  const Moment& reveal() const { return *reveal_; }

 private:
  enum class Kind { Words, Threshold, Freed, Contact, Collections, Number };
  struct Answer;
  Answer answered(const Recording& recording, std::int64_t asked_at, const Found& found) const;
  Answer ofChoices() const;
  Answer aboveOrBelow(const Recording& recording, std::int64_t step) const;
  static Answer freedBodies(const Recording& recording, std::int64_t asked_at, std::int64_t step);
  Answer contactOfEvent(const Recording& recording, std::int64_t asked_at,
                        const Found& found) const;
  static Answer numberOfCollections(const Recording& recording, std::int64_t step);
  void readNumber(TableReader& table, const Value& measure, const Scene& scene);
  Answer measured(const Recording& recording, std::int64_t step) const;

  std::string ask_, because_, criterion_;
  Kind kind_ = Kind::Words;
  std::vector<std::string> choices_;
  int answer_ = 0;
  std::vector<BodyId> pair_;
  std::optional<Quantity> quantity_;
  double tolerance_ = 0.0;
  std::string unit_;
  std::optional<Moment> reveal_;
  std::optional<Value> place_;
};

}  // namespace merge2d
