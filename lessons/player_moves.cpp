/// The player's motions: by steps, by stages, to events.

#include <fmt/format.h>

#include <algorithm>

#include "lessons/player.h"
#include "lessons/player_words.h"

namespace merge2d {

std::string Player::moveTo(std::int64_t step, Stage stage) {
  if (step > 0) timeline_.step(step);  // may throw: then we stay where we are
  step_ = step;
  stage_ = stage;
  return report();
}

std::string Player::forward(const Arguments& arguments) {
  const std::int64_t n = countIn(arguments);
  if (step_ == timeline_.last() && stage_ == Stage::Merge) {
    throw Refusal(fmt::format("this is the end: the run has {}",
                              counted(static_cast<std::size_t>(step_), "step", "steps")));
  }
  // From the middle of a step its end is one step away.
  const std::int64_t from = stage_ == Stage::Merge ? step_ : step_ - 1;
  return moveTo(std::min(from + n, timeline_.last()), Stage::Merge);
}

std::string Player::back(const Arguments& arguments) {
  if (step_ == 0) throw Refusal("this is the start");
  return moveTo(std::max<std::int64_t>(0, step_ - countIn(arguments)), Stage::Merge);
}

std::string Player::forwardStage(const Arguments& arguments) {
  const auto stages = static_cast<std::int64_t>(kStages);
  const std::int64_t at = (step_ - 1) * stages + static_cast<std::int64_t>(stage_);
  const std::int64_t to = at + countIn(arguments);
  if (to / stages + 1 > timeline_.last()) throw Refusal("this is the end of the run");
  return moveTo(to / stages + 1, static_cast<Stage>(to % stages));
}

std::string Player::backStage(const Arguments& arguments) {
  const auto stages = static_cast<std::int64_t>(kStages);
  const std::int64_t at = (step_ - 1) * stages + static_cast<std::int64_t>(stage_);
  const std::int64_t to = at - countIn(arguments);
  if (step_ == 0) throw Refusal("this is the start");
  if (to < 0) return moveTo(0, Stage::Merge);
  return moveTo(to / stages + 1, static_cast<Stage>(to % stages));
}

std::string Player::nextEvent(const Arguments& arguments) {
  // From the middle of a step its own events are still to come.
  const std::int64_t from = stage_ == Stage::Merge ? step_ : step_ - 1;
  const auto found = timeline_.nextEvent(from, eventFilter(arguments));
  if (!found) throw Refusal("no such event up to the end of the run");
  return moveTo(*found, Stage::Merge);
}

std::string Player::previousEvent(const Arguments& arguments) {
  const auto found = timeline_.previousEvent(step_, eventFilter(arguments));
  if (!found) throw Refusal("no such event since the start");
  return moveTo(*found, Stage::Merge);
}

std::string Player::jump(const Arguments& arguments) {
  if (arguments.empty()) throw Refusal("jump needs a step: jump STEP [STAGE]");
  const std::int64_t to = readCount(arguments[0], 0);
  if (to > timeline_.last()) {
    throw Refusal(
        fmt::format("the run ends at step {}; --steps makes it longer", timeline_.last()));
  }
  const Stage stage = arguments.size() > 1 ? stageNamed(arguments[1]) : Stage::Merge;
  if (to == 0 && arguments.size() > 1) throw Refusal("there is no stage before the first step");
  return moveTo(to, stage);
}

}  // namespace merge2d
