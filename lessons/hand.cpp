#include "lessons/hand.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "lessons/player_words.h"
#include "lessons/words.h"
#include "src2d/core/error.h"
#include "src2d/core/suggest.h"
#include "src2d/scene/load.h"
#include "src2d/scene/names.h"
#include "src2d/scene/settings_list.h"

namespace merge2d {
namespace {

using Arguments = std::vector<std::string>;

double numberIn(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw Refusal(fmt::format("'{}' is not a number", text));
  }
  return value;
}

double lengthIn(const std::string& text) {
  const double value = numberIn(text);
  if (!(value > 1e-4 && value < 1e4)) throw Refusal(fmt::format("'{}' is not a length", text));
  return value;
}

Vec2 vectorIn(const Arguments& words, std::size_t at) {
  return {numberIn(words.at(at)), numberIn(words.at(at + 1))};
}

std::string written(const Vec2& v) {
  return fmt::format("({}, {})", shortNumber(v.x()), shortNumber(v.y()));
}

std::string nameOfBody(const Live& live, BodyId id) {
  return Words(live.world().bodies()).name(id);
}

/// A body that is in the world now.
BodyId bodyIn(const Live& live, const std::string& word) {
  const auto& bodies = live.world().bodies();
  const Words words(bodies);
  std::optional<BodyId> found = words.find(word);
  if (!found && word.starts_with('@')) {
    const std::int64_t number = readCount(word.substr(1), 0);
    if (number < static_cast<std::int64_t>(bodies.size())) {
      found = BodyId{static_cast<std::uint32_t>(number)};
    }
  }
  if (!found) throw Refusal(fmt::format("there is no body '{}'{}", word, words.suggestion(word)));
  const Snapshot now = live.world().capture();
  if (!std::ranges::binary_search(now.bodies, *found, {}, &BodyState::id)) {
    throw Refusal(fmt::format("{} is not in the world now", words.name(*found)));
  }
  return *found;
}

Vec2 centerOf(const Live& live, BodyId id) {
  const Snapshot now = live.world().capture();
  return std::ranges::lower_bound(now.bodies, id, {}, &BodyState::id)->x;
}

std::string push(Live& live, const Arguments& words) {
  const BodyId body = bodyIn(live, words.at(1));
  const Vec2 impulse = vectorIn(words, 2);
  const Vec2 at = words.size() == 7 ? vectorIn(words, 5) : centerOf(live, body);
  live.world().applyImpulse(body, at, impulse);
  return fmt::format("pushed {} with {} N s", nameOfBody(live, body), written(impulse));
}

std::string drag(Live& live, const Arguments& words) {
  const BodyId body = bodyIn(live, words.at(1));
  Drag drag{.target = vectorIn(words, 3)};
  if (words.size() == 8) drag.grip = vectorIn(words, 6);
  live.drag(body, drag);
  return fmt::format("dragged {} to {} m", nameOfBody(live, body), written(drag.target));
}

std::string drop(Live& live, const Arguments& words) {
  const BodyId body = bodyIn(live, words.at(1));
  if (!live.drags().contains(body)) {
    throw Refusal(fmt::format("{} is not being dragged", nameOfBody(live, body)));
  }
  live.letGo(body);
  return fmt::format("let {} go", nameOfBody(live, body));
}

std::string pin(Live& live, const Arguments& words) {
  const BodyId body = bodyIn(live, words.at(1));
  live.world().pin(body);
  return fmt::format("pinned {}", nameOfBody(live, body));
}

std::string unpin(Live& live, const Arguments& words) {
  const BodyId body = bodyIn(live, words.at(1));
  live.world().unpin(body);
  return fmt::format("unpinned {}", nameOfBody(live, body));
}

std::string toss(Live& live, const Arguments& words) {
  const BodyId body = bodyIn(live, words.at(1));
  const Vec2 v = vectorIn(words, 2);
  live.world().setVelocity(body, v, 0.0);
  return fmt::format("threw {} with {} m/s", nameOfBody(live, body), written(v));
}

std::string remove(Live& live, const Arguments& words) {
  const BodyId body = bodyIn(live, words.at(1));
  const std::string name = nameOfBody(live, body);
  live.letGo(body);
  live.world().removeBody(body);
  return fmt::format("deleted {}", name);
}

std::string add(Live& live, const Arguments& words) {
  const Material& material = live.world().settings().material;
  BodyDesc desc;
  desc.at = vectorIn(words, 2);
  desc.density = material.density;
  desc.friction = material.friction;
  desc.restitution = material.restitution;
  if (words[1] == "box") {
    const double width = words.size() > 4 ? lengthIn(words[4]) : 0.5;
    const double height = words.size() > 5 ? lengthIn(words[5]) : width;
    desc.shapes.emplace_back(makeBox(width, height));
  } else if (words[1] == "disc") {
    if (words.size() > 5) throw Refusal("a disc has one size: add disc X Y [RADIUS]");
    desc.shapes.emplace_back(
        Circle{.center = Vec2::Zero(), .radius = words.size() > 4 ? lengthIn(words[4]) : 0.25});
  } else {
    throw Refusal(fmt::format("one can add a box or a disc, not '{}'", words[1]));
  }
  const BodyId id = live.world().addBody(desc);
  return fmt::format("added {}", nameOfBody(live, id));
}

std::string settingText(const Settings& settings, std::string_view wanted) {
  std::string text;
  forEachSetting(settings,
                 [&](std::string_view table, std::string_view key, const auto& value, const auto&) {
                   if (fmt::format("{}.{}", table, key) != wanted) return;
                   if constexpr (std::is_enum_v<std::remove_cvref_t<decltype(value)>>) {
                     text = nameOf(value);
                   } else {
                     text = fmt::format("{}", value);
                   }
                 });
  return text;
}

/// A value that a change of `key` would replace.
std::string inForce(const World& world, std::string_view key) {
  if (key == "gravity") return written(world.gravity());
  if (key == "step") return fmt::format("{} s", world.timeStep());
  return settingText(world.settings(), key);
}

/// Settings that are read in every step. The material of a body is not among them.
bool isChangeable(std::string_view key) {
  for (const char* table : {"solver.", "merging.", "unmerging.", "sleeping."}) {
    if (key.starts_with(table)) return true;
  }
  return key == "gravity" || key == "step";
}

/// Reads a value as a scene file would.
Scene withSetting(const World& world, const std::string& key, const std::string& value) {
  Scene scene;
  scene.settings = world.settings();
  scene.gravity = world.gravity();
  scene.step = world.timeStep();
  scene.bodies.emplace_back().shapes.emplace_back(Circle{.center = Vec2::Zero(), .radius = 1.0});
  try {
    return parseScene(toToml(scene), "settings", {{key, value}});
  } catch (const InputError& error) {
    throw Refusal(error.what());
  }
}

std::string setMode(Live& live, const std::string& value) {
  std::vector<std::string_view> names;
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    names.emplace_back(name(mode));
    if (value != name(mode)) continue;
    live.world().setMode(mode);
    return fmt::format("mode: {}", value);
  }
  throw Refusal(fmt::format("'{}' is no mode{}: reference, sleep, merge or merge+sleep", value,
                            didYouMean(value, names)));
}

std::string setFriction(Live& live, const std::string& value) {
  const double mu = numberIn(value);
  if (mu < 0.0) throw Refusal("friction is 0 or more");
  const Snapshot now = live.world().capture();
  for (const BodyState& body : now.bodies) live.world().setFriction(body.id, mu);
  return fmt::format("friction of all bodies: {}", value);
}

std::string set(Live& live, const Arguments& words) {
  const std::string text = fmt::format("{}", fmt::join(words.begin() + 1, words.end(), " "));
  const std::size_t at = text.find('=');
  if (at == std::string::npos) throw Refusal("it should read: set key=value");
  const std::string key = text.substr(0, at), value = text.substr(at + 1);
  if (key == "mode") return setMode(live, value);
  if (key == "friction") return setFriction(live, value);
  if (!isChangeable(key)) {
    throw Refusal(fmt::format(
        "'{}' cannot be changed while it runs; one can set mode, friction, gravity, step and all "
        "that stands in solver, merging, unmerging and sleeping",
        key));
  }
  World& world = live.world();
  const Scene changed = withSetting(world, key, value);
  const std::string before = inForce(world, key);
  world.setGravity(changed.gravity);
  world.setTimeStep(changed.step);
  world.setSettings(changed.settings);
  return fmt::format("{}: {} → {}", key, before, inForce(world, key));
}

struct Known {
  HandCommand words;
  std::vector<std::size_t> sizes;  ///< how many words a line may have
  std::string (*run)(Live&, const Arguments&);
};

const std::vector<Known>& known() {
  static const std::vector<Known> kKnown = {
      {{"push", "BODY X Y [at X Y]", "an impulse [N s] at its centre, or at a point"},
       {4, 7},
       push},
      {{"drag", "BODY to X Y [grip X Y]", "a spring to a place [m], until drop"}, {5, 8}, drag},
      {{"drop", "BODY", "let go of what is dragged"}, {2}, drop},
      {{"throw", "BODY VX VY", "give it a velocity [m/s]"}, {4}, toss},
      {{"pin", "BODY", "hold it where it is"}, {2}, pin},
      {{"unpin", "BODY", "let a pinned body go"}, {2}, unpin},
      {{"set", "key=value", "a threshold, gravity=[X, Y], step=SECONDS, friction, mode"},
       {2, 3},
       set},
      {{"add", "box|disc X Y [SIZE]", "a new body; a box has a width and a height"},
       {4, 5, 6},
       add},
      {{"delete", "BODY", "take it out"}, {2}, remove},
  };
  return kKnown;
}

/// The small words of `drag BODY to X Y grip X Y` and `push BODY X Y at X Y`.
void checkSmallWords(const Arguments& words) {
  const auto expect = [&](std::size_t at, std::string_view word) {
    std::string lower = at < words.size() ? words[at] : std::string(word);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    if (lower != word) throw Refusal(fmt::format("'{}' is expected before '{}'", word, words[at]));
  };
  if (words[0] == "drag") {
    expect(2, "to");
    expect(5, "grip");
  } else if (words[0] == "push") {
    expect(4, "at");
  }
}

}  // namespace

const std::vector<HandCommand>& handCommands() {
  static const std::vector<HandCommand> kCommands = [] {
    std::vector<HandCommand> out;
    for (const Known& one : known()) out.push_back(one.words);
    return out;
  }();
  return kCommands;
}

bool isHandCommand(std::string_view word) {
  return std::ranges::any_of(known(), [&](const Known& one) { return one.words.name == word; });
}

std::string doByHand(Live& live, const std::vector<std::string>& words) {
  const auto found = std::ranges::find_if(
      known(), [&](const Known& one) { return !words.empty() && one.words.name == words[0]; });
  if (found == known().end()) {
    throw Refusal(fmt::format("nothing is called '{}'", words.empty() ? "" : words[0]));
  }
  if (std::ranges::find(found->sizes, words.size()) == found->sizes.end()) {
    throw Refusal(fmt::format("it should read: {} {}", found->words.name, found->words.arguments));
  }
  checkSmallWords(words);
  try {
    return found->run(live, words);
  } catch (const InputError& error) {
    throw Refusal(error.what());
  }
}

}  // namespace merge2d
