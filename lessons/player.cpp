#include "lessons/player.h"

#include <fmt/format.h>

#include "lessons/hand.h"
#include "lessons/player_words.h"
#include "src2d/core/error.h"
#include "src2d/core/suggest.h"

namespace merge2d {

struct Player::Command {
  std::string_view name, short_name, arguments, meaning;
  std::string (Player::*run)(const Arguments&);
  std::size_t most = 0;  ///< arguments
  bool motion = false;
};

const std::vector<Player::Command>& Player::commands() {
  static const std::vector<Command> kCommands = {
      {"step", "s", "[N]", "go on by N time steps", &Player::forward, 1, true},
      {"back", "b", "[N]", "go back by N time steps", &Player::back, 1, true},
      {"stage", ".", "[N]", "go on by N stages of the algorithm", &Player::forwardStage, 1, true},
      {"unstage", ",", "[N]", "go back by N stages", &Player::backStage, 1, true},
      {"event", "m", "[TYPE]",
       "go on to the next event (merge, unmerge, sleep, wake, impact, emit, break)",
       &Player::nextEvent, 1, true},
      {"unevent", "[", "[TYPE]", "go back to the last event", &Player::previousEvent, 1, true},
      {"jump", "j", "STEP [STAGE]", "go to a time step, and into it", &Player::jump, 2, false},
      {"here", "h", "", "where we are", &Player::here, 0, false},
      {"table", "t", "[STAGE|all]", "what the stage did, in numbers", &Player::table, 2, false},
      {"stages", "", "", "all eleven stages of this step, a line each", &Player::stages, 0, false},
      {"why", "w", "[A B]", "what this step decided, and why", &Player::why, 2, false},
      {"body", "", "NAME", "a body's numbers and contacts", &Player::body, 1, false},
      {"pair", "", "A B", "the contacts and tests of a pair", &Player::pair, 2, false},
      {"events", "e", "", "what happened in this step", &Player::events, 0, false},
      {"picture", "p", "FILE.png", "draw the stage, or as vector graphics into FILE.svg",
       &Player::picture, 1, false},
      {"changes", "", "", "what was changed by hand", &Player::changed, 0, false},
      {"undo", "u", "[N]", "take back the last N changes", &Player::undo, 1, false},
      {"help", "?", "", "this list", &Player::help, 0, false},
      {"quit", "q", "", "the end", &Player::quit, 0, false},
  };
  return kCommands;
}

const Player::Command& Player::find(std::string_view word) const {
  std::vector<std::string_view> names;
  for (const Command& command : commands()) {
    if (word == command.name || (word == command.short_name && !word.empty())) return command;
    names.push_back(command.name);
  }
  for (const HandCommand& command : handCommands()) names.push_back(command.name);
  throw Refusal(
      fmt::format("there is no command '{}'{}; 'help' lists them", word, didYouMean(word, names)));
}

Player::Player(const Scene& scene, Mode mode, std::int64_t last, PictureMaker draw)
    : timeline_(scene, mode, last), words_(timeline_.bodies()), draw_(std::move(draw)) {}

std::string Player::greeting() const {
  const Scene& scene = timeline_.scene();
  return fmt::format("{}: {}, {} of {:.6g} s, {}. 'help' lists the commands.\n",
                     scene.title.empty() ? scene.name : scene.title,
                     counted(timeline_.bodies().size(), "body", "bodies"),
                     counted(static_cast<std::size_t>(timeline_.last()), "step", "steps"),
                     scene.step, name(timeline_.mode()));
}

std::string Player::prompt() const {
  if (step_ == 0) return "start > ";
  return fmt::format("step {} {} > ", step_, name(stage_));
}

double Player::time() {
  // A stage is seen inside its step; at the end of the last one the step is over.
  return step_ > 0 && stage_ == Stage::Merge ? timeline_.step(step_).after.time : now().time;
}

Answer Player::run(std::string_view line) {
  Arguments words = wordsOf(line);
  try {
    if (words.empty()) {
      const bool comment = line.find('#') != std::string_view::npos;
      return comment ? Answer{} : Answer{.text = (this->*find(last_motion_).run)({}), .ok = true};
    }
    if (isHandCommand(words[0])) return {.text = byHand(words), .ok = true};
    const Command& command = find(words[0]);
    words.erase(words.begin());
    if (words.size() > command.most) {
      throw Refusal(fmt::format("'{}' takes {}", command.name,
                                command.arguments.empty() ? "nothing more" : command.arguments));
    }
    Answer answer{.text = (this->*command.run)(words), .ok = true};
    if (command.motion) last_motion_ = command.name;
    return answer;
  } catch (const Refusal& refusal) {
    return {.text = fmt::format("{}\n", refusal.what()), .ok = false};
  } catch (const SimulationError& error) {
    return {.text = fmt::format("{}\n", error.what()), .ok = false};
  } catch (const IoError& error) {
    return {.text = fmt::format("{}\n", error.what()), .ok = false};
  }
}

std::vector<std::string> Player::completions(std::string_view line) const {
  const std::size_t blank = line.find_last_of(" \t");
  const std::string_view word = blank == std::string_view::npos ? line : line.substr(blank + 1);
  std::vector<std::string> all;
  const auto offer = [&](std::string_view candidate) {
    if (candidate.starts_with(word)) all.emplace_back(candidate);
  };
  if (blank == std::string_view::npos) {
    for (const Command& command : commands()) offer(command.name);
    for (const HandCommand& command : handCommands()) offer(command.name);
    return all;
  }
  const std::string_view command = line.substr(0, line.find_first_of(" \t"));
  if (command == "event" || command == "m" || command == "unevent") {
    for (const std::string_view type : eventNames()) offer(type);
  } else if (command == "table" || command == "t" || command == "jump") {
    for (std::size_t i = 0; i < kStages; ++i) offer(name(static_cast<Stage>(i)));
  } else {
    for (const BodyInfo& body : timeline_.bodies()) offer(body.name);
  }
  return all;
}

std::string Player::picture(const Arguments& arguments) {
  if (arguments.empty()) throw Refusal("picture needs a file: picture FILE.png");
  if (!arguments[0].ends_with(".png") && !arguments[0].ends_with(".svg")) {
    throw Refusal("pictures are PNG or SVG files: picture FILE.png");
  }
  const StepRecord* record = step_ == 0 ? nullptr : &timeline_.step(step_);
  return fmt::format("{}: {}\n", arguments[0], draw_(record, stage_, arguments[0]));
}

std::string Player::help(const Arguments&) {
  std::string out;
  for (const Command& command : commands()) {
    const std::string usage = fmt::format("{} {}", command.name, command.arguments);
    out += fmt::format("  {:<22}{:<3} {}\n", usage, command.short_name, command.meaning);
  }
  out += "Changes by hand, before the next step:\n";
  for (const HandCommand& command : handCommands()) {
    out += fmt::format("  {:<25} {}\n", fmt::format("{} {}", command.name, command.arguments),
                       command.meaning);
  }
  return out + "An empty line repeats the last motion. Names with blanks stand in quotes.\n";
}

std::string Player::quit(const Arguments&) {
  done_ = true;
  return "";
}

}  // namespace merge2d
