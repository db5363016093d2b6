#pragma once
/// Changes of a live run in words: what `merge2d step` and the lesson pages let a person do.

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

/// Does what the words say, as {"push", "brick[0,5]", "3", "0"}, before the next step. A body goes
/// by its name, or as @3 by its number. Returns what was done. Throws Refusal; then nothing was.
std::string doByHand(Live& live, const std::vector<std::string>& words);

}  // namespace merge2d
