#include <fmt/format.h>

#include <memory>

#include "app/commands.h"
#include "app/console.h"
#include "app/interrupt.h"
#include "app/json.h"
#include "app/progress.h"
#include "app/simulation.h"
#include "app/usage_error.h"
#include "lessons/explain.h"
#include "lessons/story.h"
#include "lessons/why.h"
#include "src2d/core/error.h"
#include "src2d/core/utf8.h"

namespace merge2d {
namespace {

constexpr const char* kExplainExamples = R"(Examples:
  merge2d explain tower-platform --at 599
  merge2d explain books --at 3 --pair diary notebook
  merge2d explain tower-platform --weld "brick[2,3]" "brick[2,4]"
  merge2d explain books --at 3 --json

Each sentence comes from the tests that the time step made, with value, threshold, source (an
equation of the paper, or a page of ours) and count. docs/records.md lists the tests. Without
--all, at most a dozen of a kind are told; --json always tells all.)";

struct ExplainOptions : SceneOptions {
  std::optional<std::int64_t> at;
  std::vector<std::string> pair, weld;  ///< two names, or none
  bool all = false;
};

void check(const ExplainOptions& options) {
  check(static_cast<const SceneOptions&>(options));
  if (!options.weld.empty() && (options.at || !options.pair.empty())) {
    throw UsageError("--weld tells of a whole run; --at and --pair of one step");
  }
  if (options.weld.empty() && !options.at) {
    throw UsageError("explain needs a step: --at STEP, or --weld A B for a whole run");
  }
  if (options.at && (options.steps || options.seconds)) {
    throw UsageError("--at says how far to simulate; --steps and --seconds go with --weld");
  }
}

/// The two bodies of that name.
std::pair<BodyId, BodyId> bodiesOf(const Words& words, const std::vector<std::string>& names) {
  std::vector<BodyId> found;
  for (const std::string& name : names) {
    const auto body = words.find(name);
    if (!body) {
      throw UsageError(fmt::format("the scene has no body '{}'{}", name, words.suggestion(name)));
    }
    found.push_back(*body);
  }
  if (found[0] == found[1]) {
    throw UsageError(fmt::format("'{}' and itself are no pair; name two bodies", names[0]));
  }
  return std::minmax(found[0], found[1]);
}

Json jsonOf(const Words& words, const Decision& d, const std::vector<Group>& groups) {
  Json out{{"stage", d.stage},    {"criterion", d.criterion}, {"equation", d.equation},
           {"value", d.value},    {"threshold", d.threshold}, {"margin", d.threshold - d.value},
           {"before", d.before},  {"count", d.count},         {"needed", d.needed},
           {"verdict", d.verdict}};
  if (!d.at.isZero()) out["at"] = {d.at.x(), d.at.y()};  // of one contact
  const auto members = static_cast<std::size_t>(d.members);
  if (d.members >= 0 && members < groups.size()) {
    for (const BodyId body : groups[members]) out["group"].push_back(words.name(body));
  }
  return out;
}

Json jsonOf(const Words& words, const Explanation& e) {
  Json tests = Json::array();
  for (const Decision& d : e.tests) tests.push_back(jsonOf(words, d, e.groups));
  Json out{{"a", words.name(e.a)},
           {"b", words.name(e.b)},
           {"outcome", name(e.outcome)},
           {"text", e.text},
           {"tests", tests}};
  if (e.reason != EventReason::None) out["reason"] = name(e.reason);
  return out;
}

Json jsonHead(const World& world) {
  return {{"scene", world.scene().name},
          {"mode", name(world.mode())},
          {"step", world.steps()},
          {"time", world.time()}};
}

void printJson(const Json& json) {
  print(json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
}

/// The decisions of one step.
class StepReport {
 public:
  StepReport(const ExplainOptions& options, const World& world)
      : options_(options), world_(world), words_(world.bodies()) {
    const Snapshot after = world.capture();
    all_ = explainStep(words_, after);
    if (options.pair.empty()) return;
    const auto [a, b] = bodiesOf(words_, options.pair);
    std::erase_if(all_, [a = a, b = b](const Explanation& e) { return e.a != a || e.b != b; });
    silence_ = whySilent(after, a, b);
  }

  void print() const {
    if (options_.json) {
      printAsJson();
    } else if (!options_.pair.empty()) {
      printPair();
    } else {
      printAll();
    }
  }

 private:
  void printAsJson() const {
    Json out = jsonHead(world_);
    out["explanations"] = Json::array();
    for (const Explanation& e : all_) out["explanations"].push_back(jsonOf(words_, e));
    if (!options_.pair.empty() && all_.empty()) out["note"] = silence_;
    printJson(out);
  }

  std::string head() const {
    return fmt::format("{}, step {} (t = {:.6g} s), {}\n", escaped(world_.scene().name),
                       world_.steps(), world_.time(), name(world_.mode()));
  }

  /// Every test of one pair.
  void printPair() const {
    merge2d::print(head());
    if (all_.empty()) merge2d::print(silence_ + "\n");
    for (const Explanation& e : all_) {
      merge2d::print(e.text + "\n");
      for (const Decision& d : e.tests) {
        merge2d::print(
            fmt::format("  {:<24}  {:<10}  {}\n", d.stage, d.verdict, words_.test(d, e.groups)));
      }
    }
  }

  void printAll() const {
    merge2d::print(head());
    if (all_.empty()) merge2d::print(stillness() + "\n");
    for (std::size_t i = 0; i < all_.size();) {
      const Outcome outcome = all_[i].outcome;
      std::size_t end = i;
      while (end < all_.size() && all_[end].outcome == outcome) ++end;
      merge2d::print(fmt::format("\n{} ({})\n", heading(outcome), end - i));
      const std::size_t most = options_.all ? end - i : kMost;
      for (std::size_t k = i; k < std::min(end, i + most); ++k) {
        merge2d::print(fmt::format("  {}\n", all_[k].text));
      }
      if (end - i > most) merge2d::print(fmt::format("  … and {} more\n", end - i - most));
      i = end;
    }
  }

  /// Why there is nothing to tell at all.
  std::string stillness() const {
    const Stats& stats = world_.stats();
    if (!merges(world_.mode())) {
      return fmt::format("In the mode {} nothing merges, so nothing was tested.",
                         name(world_.mode()));
    }
    return stats.asleep > 0 && stats.asleep == stats.bodies
               ? "Everything is asleep, so nothing was tested."
           : stats.internal_contacts > 0
               ? "No motion was found inside collections, so nothing was tested."
           : stats.contacts > 0 ? "No pair was about to merge, so nothing was tested."
                                : "No two bodies touch, so nothing was tested.";
  }

  /// Why there is nothing to tell of a pair.
  std::string whySilent(const Snapshot& after, BodyId a, BodyId b) const {
    const std::string who = words_.pair(a, b);
    const auto state = [&](BodyId id) {
      return std::ranges::find(after.bodies, id, &BodyState::id);
    };
    const auto sa = state(a), sb = state(b);
    if (sa == after.bodies.end() || sb == after.bodies.end()) {
      return fmt::format("{} is not in the world yet.",
                         words_.name(sa == after.bodies.end() ? a : b));
    }
    if (!merges(world_.mode())) {
      return fmt::format("In the mode {} nothing merges, so no pair is tested.",
                         name(world_.mode()));
    }
    const bool fixed = (sa->pinned || sa->asleep) && (sb->pinned || sb->asleep);
    const bool touch = std::ranges::any_of(
        after.contacts, [&](const ContactView& c) { return c.a == a && c.b == b; });
    if (!touch) return fmt::format("{} do not touch, so nothing was tested.", who);
    if (fixed) return fmt::format("{} are asleep or pinned, so nothing was tested.", who);
    const PairReason why = reasonFor(words_, after, a, b);
    if (why.outcome == "one") return fmt::format("{} {}", why.text, sentence(why.condition));
    return fmt::format("{} touch, but nothing was tested about them in this step.", who);
  }

  static constexpr std::size_t kMost = 12;  ///< of a kind

  const ExplainOptions& options_;
  const World& world_;
  Words words_;
  std::vector<Explanation> all_;
  std::string silence_;
};

void explainOneStep(const ExplainOptions& options, const Console& console) {
  World world(loadScene(options, console), {.mode = options.mode, .timings = false});
  const Words words(world.bodies());
  if (!options.pair.empty()) bodiesOf(words, options.pair);  // better now than after a long run
  requireStep(world.scene(), *options.at);
  Progress progress(console, "step", *options.at);
  while (world.steps() < *options.at) {
    stopIfInterrupted();
    world.takeNotes(world.steps() + 1 == *options.at);
    world.step();
    progress.update(world.steps());
  }
  StepReport(options, world).print();
}

void explainWeld(const ExplainOptions& options, const Console& console) {
  World world(loadScene(options, console),
              {.mode = options.mode, .timings = false, .decisions = true});
  const Words words(world.bodies());
  const auto [a, b] = bodiesOf(words, options.weld);
  WeldStory story(words, a, b);
  const std::int64_t steps = stepCount(world.scene());
  {
    Progress progress(console, "step", steps);
    Snapshot after;
    while (world.steps() < steps) {
      stopIfInterrupted();
      world.step();
      world.capture(after);
      story.add(after);
      progress.update(world.steps());
    }
  }
  if (options.json) {
    Json out = jsonHead(world);
    out["welded"] = story.welded();
    out["chapters"] = Json::array();
    for (const Chapter& chapter : story.chapters()) {
      Json one = jsonOf(words, chapter.what);
      one["step"] = chapter.step;
      out["chapters"].push_back(one);
    }
    out["ending"] = story.ending();
    return printJson(out);
  }
  for (const Chapter& chapter : story.chapters()) print(chapter.what.text + "\n");
  print(story.ending() + "\n");
}

void explain(const ExplainOptions& options) {
  check(options);
  const Console console(options);
  catchInterrupts();
  if (options.weld.empty()) {
    explainOneStep(options, console);
  } else {
    explainWeld(options, console);
  }
}

/// Two names after an option.
void addPairOption(CLI::App& command, const std::string& name, std::vector<std::string>& pair,
                   const std::string& help) {
  command
      .add_option_function<std::vector<std::string>>(
          name, [&pair](const std::vector<std::string>& names) { pair = names; }, help)
      ->expected(2)
      ->type_name("A B")
      ->group("What");
}

}  // namespace

void addExplainCommand(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("explain", "Say why a pair of bodies merged, came apart, or did not");
  command->footer(kExplainExamples);
  const auto options = std::make_shared<ExplainOptions>();
  addSceneOptions(*command, *options);
  addOption(
      *command, "--at", "STEP",
      [options](const std::string& s) { options->at = readInteger("--at", s, 1, kMostSteps); },
      "The time step to explain: 1 is the first")
      ->group("What");
  addPairOption(*command, "--pair", options->pair, "Only what concerns these two bodies, in full");
  addPairOption(*command, "--weld", options->weld,
                "The story of one weld over the run: why it broke, or what it waits for");
  command->add_flag("--all", options->all, "Tell everything, however much it is")->group("What");
  addGeneralOptions(*command, *options);
  command->callback([&action, options] { action = [options] { explain(*options); }; });
}

}  // namespace merge2d
