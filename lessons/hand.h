#pragma once
/// Changes of a live run in words: the commands of `merge2d step` and of the lesson pages.

#include <string>
#include <string_view>
#include <vector>

#include "lessons/live.h"

namespace merge2d {

struct HandCommand {
  std::string_view name, arguments, meaning;
};
/// In the order in which help lists them.
const std::vector<HandCommand>& handCommands();
bool isHandCommand(std::string_view word);

/// Executes a command, as {"push", "brick[0,5]", "3", "0"}, before the next step. A body goes by
/// its name, or as @3 by its number. Returns a sentence about the change. Throws Refusal; then
/// nothing has changed.
std::string doByHand(Live& live, const std::vector<std::string>& words);

}  // namespace merge2d
