#include "lessons/player.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "lessons/explain.h"
#include "src2d/core/error.h"
#include "src2d/core/suggest.h"

namespace merge2d {
namespace {

constexpr std::int64_t kMany = 1'000'000'000;

/// A line that cannot be done; the message says what would be right.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The words of a line; "…" and '…' hold blanks together.
std::vector<std::string> wordsOf(std::string_view line) {
  std::vector<std::string> words;
  std::string word;
  bool inside = false;
  char quote = 0;
  const auto finish = [&] {
    if (inside) words.push_back(word);
    word.clear();
    inside = false;
  };
  for (const char c : line) {
    if (quote != 0) {
      if (c == quote)
        quote = 0;
      else
        word += c;
    } else if (c == '"' || c == '\'') {
      quote = c;
      inside = true;
    } else if (c == '#' && !inside) {
      break;
    } else if (c == ' ' || c == '\t' || c == '\r') {
      finish();
    } else {
      word += c;
      inside = true;
    }
  }
  finish();
  return words;
}

std::int64_t readCount(const std::string& text, std::int64_t least) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least || value > kMany) {
    throw Refusal(fmt::format("'{}' is not a whole number of {} or more", text, least));
  }
  return value;
}

std::int64_t countIn(const std::vector<std::string>& arguments) {
  return arguments.empty() ? 1 : readCount(arguments[0], 1);
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

/// A stage by its number, its name, or the beginning of it.
Stage stageNamed(const std::string& text) {
  std::vector<std::string_view> names;
  std::vector<Stage> found;
  for (std::size_t i = 0; i < kStages; ++i) {
    const auto stage = static_cast<Stage>(i);
    names.emplace_back(name(stage));
    if (text == std::to_string(i + 1) || lower(name(stage)) == lower(text)) return stage;
    if (lower(name(stage)).starts_with(lower(text))) found.push_back(stage);
  }
  if (found.size() == 1) return found[0];
  throw Refusal(
      fmt::format("there is no stage '{}'{}; 'stages' lists them", text, didYouMean(text, names)));
}

Timeline::EventFilter eventFilter(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return [](const Event&) { return true; };
  std::vector<std::string_view> names;
  for (const EventType type : {EventType::Merge, EventType::Unmerge, EventType::Sleep,
                               EventType::Wake, EventType::Impact, EventType::Emit}) {
    names.emplace_back(name(type));
    if (arguments[0] == name(type)) return [type](const Event& e) { return e.type == type; };
  }
  throw Refusal(fmt::format("there is no event '{}'{}: merge, unmerge, sleep, wake, impact or emit",
                            arguments[0], didYouMean(arguments[0], names)));
}

}  // namespace

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
       "go on to the next event (merge, unmerge, sleep, wake, impact, emit)", &Player::nextEvent, 1,
       true},
      {"unevent", "[", "[TYPE]", "go back to the last event", &Player::previousEvent, 1, true},
      {"jump", "j", "STEP [STAGE]", "go to a time step, and into it", &Player::jump, 2, false},
      {"here", "h", "", "where we are", &Player::here, 0, false},
      {"table", "t", "[STAGE|all]", "what the stage did, in numbers", &Player::table, 2, false},
      {"stages", "", "", "all eleven stages of this step, a line each", &Player::stages, 0, false},
      {"why", "w", "[A B]", "what this step decided, and why", &Player::why, 2, false},
      {"body", "", "NAME", "a body's numbers and contacts", &Player::body, 1, false},
      {"pair", "", "A B", "the contacts and tests of a pair", &Player::pair, 2, false},
      {"events", "e", "", "what happened in this step", &Player::events, 0, false},
      {"picture", "p", "FILE.png", "draw the stage", &Player::picture, 1, false},
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

Answer Player::run(std::string_view line) {
  Arguments words = wordsOf(line);
  try {
    if (words.empty()) {
      const bool comment = line.find('#') != std::string_view::npos;
      return comment ? Answer{} : Answer{.text = (this->*find(last_motion_).run)({}), .ok = true};
    }
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
    return all;
  }
  const std::string_view command = line.substr(0, line.find_first_of(" \t"));
  if (command == "event" || command == "m" || command == "unevent") {
    for (const char* type : {"merge", "unmerge", "sleep", "wake", "impact", "emit"}) offer(type);
  } else if (command == "table" || command == "t" || command == "jump") {
    for (std::size_t i = 0; i < kStages; ++i) offer(name(static_cast<Stage>(i)));
  } else {
    for (const BodyInfo& body : timeline_.bodies()) offer(body.name);
  }
  return all;
}

// ---- motions ----

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

// ---- looking ----

const Snapshot& Player::now() {
  if (step_ == 0) return timeline_.initial();
  return timeline_.step(step_)[stage_].after;
}

std::string Player::here(const Arguments&) { return report(); }

std::string Player::report() {
  if (step_ == 0) {
    return fmt::format("start: t = 0 s, {}\n",
                       counted(timeline_.initial().bodies.size(), "body", "bodies"));
  }
  const StepRecord& record = timeline_.step(step_);
  if (stage_ != Stage::Merge) {
    return fmt::format("step {}, stage {} of {}, {}: {}\n{}", step_,
                       static_cast<std::size_t>(stage_) + 1, kStages, name(stage_),
                       summary(record, stage_), eventList(record[stage_].after));
  }
  const Stats& s = record.after.stats;
  return fmt::format("step {}, t = {:.6g} s: {} in B, {}, {} asleep, {} solved, {} inside\n{}",
                     step_, record.after.time, s.active_bodies,
                     counted(static_cast<std::size_t>(s.collections), "collection", "collections"),
                     s.asleep, counted(static_cast<std::size_t>(s.contacts), "contact", "contacts"),
                     s.internal_contacts, eventList(record.after));
}

std::string Player::eventList(const Snapshot& of) const {
  constexpr std::size_t kMost = 8;
  std::string out;
  for (std::size_t i = 0; i < std::min(kMost, of.events.size()); ++i) {
    out += fmt::format("  {}\n", words_.event(of.events[i]));
  }
  if (of.events.size() > kMost) out += fmt::format("  … and {} more\n", of.events.size() - kMost);
  return out;
}

std::string Player::events(const Arguments&) {
  if (step_ == 0) return "nothing has happened yet\n";
  const Snapshot& after = timeline_.step(step_).after;
  if (after.events.empty()) return "nothing happened in this step\n";
  std::string out;
  for (const Event& e : after.events) out += words_.event(e) + "\n";
  return out;
}

std::string Player::table(const Arguments& arguments) {
  if (step_ == 0) throw Refusal("there is no stage before the first step; 'step' goes on");
  RowFilter filter;
  Stage stage = stage_;
  for (const std::string& argument : arguments) {
    if (argument == "all") {
      filter.most = static_cast<std::size_t>(kMany);
    } else {
      stage = stageNamed(argument);
    }
  }
  return fmt::format("{}: {}\n{}", name(stage), purpose(stage),
                     stageTable(words_, timeline_.step(step_), stage, filter));
}

std::string Player::stages(const Arguments&) {
  if (step_ == 0) throw Refusal("there is no stage before the first step; 'step' goes on");
  const StepRecord& record = timeline_.step(step_);
  std::string out;
  for (std::size_t i = 0; i < kStages; ++i) {
    const auto stage = static_cast<Stage>(i);
    out += fmt::format("{:>2}  {:<24}  {}\n", i + 1, name(stage), summary(record, stage));
  }
  return out;
}

BodyId Player::bodyNamed(const std::string& name) const {
  const auto body = words_.find(name);
  if (body) return *body;
  throw Refusal(fmt::format("there is no body '{}'{}", name, words_.suggestion(name)));
}

std::string Player::why(const Arguments& arguments) {
  if (step_ == 0) return "nothing has been decided yet\n";
  if (arguments.size() == 1) throw Refusal("why takes two bodies, or none");
  std::vector<Explanation> all = explainStep(words_, timeline_.step(step_).after);
  if (!arguments.empty()) {
    const auto [a, b] = std::minmax({bodyNamed(arguments[0]), bodyNamed(arguments[1])});
    std::erase_if(all, [a = a, b = b](const Explanation& e) { return e.a != a || e.b != b; });
    if (all.empty()) {
      return fmt::format("nothing was tested about {} in this step\n", words_.pair(a, b));
    }
  }
  constexpr std::size_t kMost = 12;
  std::string out;
  for (std::size_t i = 0; i < std::min(kMost, all.size()); ++i) out += all[i].text + "\n";
  if (all.size() > kMost) out += fmt::format("… and {} more\n", all.size() - kMost);
  return all.empty() ? "nothing was decided in this step\n" : out;
}

std::string Player::contactsOf(const RowFilter& filter) {
  TextTable table({"a", "b", "at [m]", "gap [m]", "λ_n [N s]", "λ_t [N s]", "state", ""});
  for (const ContactView& c : now().contacts) {
    if (!filter.wants(c.a, c.b)) continue;
    table.add({words_.name(c.a), words_.name(c.b), fmt::format("{:.3f}, {:.3f}", c.x.x(), c.x.y()),
               shortNumber(c.gap), shortNumber(c.lambda_n), shortNumber(c.lambda_t),
               merge2d::name(c.state), c.internal ? "merged" : ""});
  }
  return table.text(filter.most);
}

std::string Player::body(const Arguments& arguments) {
  if (arguments.empty()) throw Refusal("body needs a name");
  const BodyId id = bodyNamed(arguments[0]);
  const auto found = std::ranges::find(now().bodies, id, &BodyState::id);
  if (found == now().bodies.end()) return fmt::format("{} is not there yet\n", arguments[0]);
  const BodyState& b = *found;
  const BodyInfo& info = timeline_.bodies()[index(id)];
  std::string where = b.pinned                          ? "pinned"
                      : info.motion == Motion::Scripted ? "scripted"
                      : b.collection != kNoCollection   ? "in " + collectionName(b.collection)
                                                        : "free";
  if (b.asleep) where += ", asleep";
  RowFilter filter;
  filter.body = id;
  return fmt::format(
      "{}: {}; mass {} kg, inertia {} kg m²\n"
      "  x = ({:.4f}, {:.4f}) m, angle {:.4f} rad; v = ({:.4f}, {:.4f}) m/s, ω = {:.4f} rad/s\n{}",
      words_.name(id), where, shortNumber(info.mass), shortNumber(info.inertia), b.x.x(), b.x.y(),
      b.angle, b.v.x(), b.v.y(), b.omega, contactsOf(filter));
}

std::string Player::pair(const Arguments& arguments) {
  if (arguments.size() < 2) throw Refusal("pair needs two names");
  RowFilter filter;
  filter.pair = std::minmax({bodyNamed(arguments[0]), bodyNamed(arguments[1])});
  std::string out = contactsOf(filter);
  return step_ == 0 ? out : out + why(arguments);
}

std::string Player::picture(const Arguments& arguments) {
  if (arguments.empty()) throw Refusal("picture needs a file: picture FILE.png");
  if (!arguments[0].ends_with(".png")) throw Refusal("pictures are PNG files: picture FILE.png");
  const StepRecord* record = step_ == 0 ? nullptr : &timeline_.step(step_);
  return fmt::format("{}: {}\n", arguments[0], draw_(record, stage_, arguments[0]));
}

std::string Player::help(const Arguments&) {
  std::string out;
  for (const Command& command : commands()) {
    const std::string usage = fmt::format("{} {}", command.name, command.arguments);
    out += fmt::format("  {:<22}{:<3} {}\n", usage, command.short_name, command.meaning);
  }
  return out + "An empty line repeats the last motion. Names with blanks stand in quotes.\n";
}

std::string Player::quit(const Arguments&) {
  done_ = true;
  return "";
}

}  // namespace merge2d
