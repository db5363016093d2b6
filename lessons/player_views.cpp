/// The views of the player: the place, tables, reasons, bodies, pairs.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "lessons/explain.h"
#include "lessons/player.h"
#include "lessons/player_words.h"

namespace merge2d {

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
      filter.most = std::numeric_limits<std::size_t>::max();
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

}  // namespace merge2d
