#pragma once
/// Names, numbers, tests and events in words that a student understands.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src2d/trace/snapshot.h"

namespace merge2d {

/// "0.023", "4.43", "2.3e-09": two digits below one, three above.
std::string shortNumber(double value);

/// Two numbers with as many digits as it takes to tell them apart.
struct NumberPair {
  std::string value, threshold;
};
NumberPair shortNumbers(double value, double threshold);

/// "Eq. 17", "Eqs. 19, 20", "Section 6.3" from what a record says: "(17)".
std::string equationName(std::string_view equation);

/// "1 body", "3 bodies".
std::string counted(std::size_t number, std::string_view one, std::string_view many);

/// "a, b and c".
std::string listed(const std::vector<std::string>& parts);

/// Speaks of the bodies of one run.
class Words {
 public:
  /// `bodies` must outlive the words.
  explicit Words(const std::vector<BodyInfo>& bodies) : bodies_(bodies) {}

  /// The body's name, or "body 12" when it has none.
  std::string name(BodyId body) const;
  /// "brick[2,3] and brick[2,4]".
  std::string pair(BodyId a, BodyId b) const;
  /// The body of that name.
  std::optional<BodyId> find(std::string_view name) const;
  /// " (did you mean 'brick[2,3]'?)", or nothing.
  std::string suggestion(std::string_view name) const;

  /// One test: "relative motion 0.023 m/s is above 0.010 m/s (2.3 times; Eq. 17)".
  /// With the `groups` of its snapshot it names all bodies of a group, or the first of many.
  std::string test(const Decision& test, const std::vector<Group>& groups = {}) const;

  /// "brick[2,3], brick[2,4] and post", "a, b, c, d and 37 others".
  std::string group(const Group& group) const;

  /// "brick[2,3] and brick[2,4] merged into C3", …
  std::string event(const Event& event) const;

 private:
  const std::vector<BodyInfo>& bodies_;
};

/// "C3".
std::string collectionName(CollectionId id);

}  // namespace merge2d
