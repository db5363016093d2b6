/// The parameters that the player lets one change by hand.

#include <fmt/format.h>

#include "lessons/player.h"
#include "lessons/player_words.h"

namespace merge2d {

/// After the step that one is in: a stage that was looked at is of the step's inside.
std::string Player::byHand(const Arguments& words) {
  const std::string told = timeline_.change(step_, words);
  stage_ = Stage::Merge;
  return fmt::format("{}, from step {} on\n", told, step_ + 1);
}

std::string Player::changed(const Arguments&) {
  std::string out;
  for (const HandChange& change : timeline_.changes()) {
    out += fmt::format("after step {}: {}\n", change.step, change.told);
  }
  return out.empty() ? "nothing was changed\n" : out;
}

std::string Player::undo(const Arguments& arguments) {
  const auto count = static_cast<std::size_t>(countIn(arguments));
  const std::size_t all = timeline_.changes().size();
  const auto step = timeline_.undo(count);
  if (!step) throw Refusal("nothing was changed");
  const std::string taken =
      counted(std::min(count, all), "change is taken back", "changes are taken back");
  return fmt::format("{}\n{}", taken, moveTo(*step, Stage::Merge));
}

}  // namespace merge2d
