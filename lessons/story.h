#pragma once
/// The story of one weld over a run: when it formed, why it broke, or what keeps it from forming.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lessons/explain.h"

namespace merge2d {

/// Something that happened to the pair.
struct Chapter {
  std::int64_t step = 0;
  Explanation what;
};

class WeldStory {
 public:
  /// `words` must outlive the story.
  WeldStory(const Words& words, BodyId a, BodyId b);

  /// Takes note of a step; steps in order, with their decisions.
  void add(const Snapshot& after);

  const std::vector<Chapter>& chapters() const { return chapters_; }
  bool welded() const { return welded_; }
  /// How it stands after the last step, and what it waits for: a sentence or two.
  std::string ending() const;

 private:
  /// How often a criterion kept the pair apart, and how near it came.
  struct Obstacle {
    int steps = 0;
    Decision nearest;
    std::int64_t nearest_step = 0;
  };

  /// The tests of the pair since it was welded last.
  struct Tests {
    bool touched = false;
    int steps = 0;
    int best_count = 0, needed = 0;
    std::int64_t best_step = 0;
    std::map<std::string, Obstacle> obstacles{};  ///< by criterion
  };

  void remember(const Explanation& e, std::int64_t step);
  std::string whyUntested() const;
  std::string mainObstacle() const;
  bool concerns(BodyId a, BodyId b) const;

  const Words& words_;
  BodyId a_, b_;
  std::vector<Chapter> chapters_;
  bool welded_ = false;
  std::int64_t last_step_ = 0;
  Explanation last_;  ///< of the last step that decided something
  std::int64_t last_decided_ = 0;
  std::int64_t apart_since_ = 0;
  Tests tests_;
};

}  // namespace merge2d
