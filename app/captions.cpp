#include "app/captions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "app/web_vtt.h"
#include "lessons/words.h"

namespace merge2d {
namespace {

std::string happened(EventType type, bool collection, std::size_t number) {
  const std::string one = collection ? "collection" : "body";
  const std::string many = collection ? "collections" : "bodies";
  switch (type) {
    case EventType::Merge:
      return counted(number, "merge", "merges");
    case EventType::Unmerge:
      return counted(number, "unmerge", "unmerges");
    case EventType::Sleep:
      return counted(number, one + " falls asleep", many + " fall asleep");
    case EventType::Wake:
      return counted(number, one + " wakes up", many + " wake up");
    case EventType::Impact:
      return counted(number, "impact", "impacts");
    case EventType::Emit:
      return counted(number, "body appears", "bodies appear");
    case EventType::Break:
      return counted(number, "joint breaks", "joints break");
  }
  return {};
}

}  // namespace

void Captions::add(const Snapshot& snapshot) {
  if (snapshot.events.empty()) return;
  // The step that ends at a whole second belongs to the second before it.
  const auto number = static_cast<std::int64_t>(std::ceil(snapshot.time - 1e-9)) - 1;
  Second& second = seconds_[std::max<std::int64_t>(0, number)];
  for (const Event& event : snapshot.events) {
    const bool sleep = event.type == EventType::Sleep || event.type == EventType::Wake;
    ++second.events[{event.type, sleep && event.collection != kNoCollection}];
    if (event.type == EventType::Unmerge) ++second.reasons[event.reason];
  }
  second.bodies = snapshot.stats.bodies;
  second.collections = snapshot.stats.collections;
  second.asleep = snapshot.stats.asleep;
}

std::string Captions::describe(const Second& second) {
  std::vector<std::string> parts;
  for (const auto& [kind, number] : second.events) {
    const auto [type, collection] = kind;
    parts.push_back(happened(type, collection, static_cast<std::size_t>(number)));
    if (type != EventType::Unmerge) continue;
    std::vector<std::string> reasons;
    for (const auto& [reason, times] : second.reasons) {
      reasons.push_back(fmt::format("{} {}", times, name(reason)));
    }
    parts.back() += fmt::format(" ({})", fmt::join(reasons, ", "));
  }
  return fmt::format(
      "{}. Then {}, {} asleep, in {}.", fmt::join(parts, ", "),
      counted(static_cast<std::size_t>(second.bodies), "body", "bodies"), second.asleep,
      counted(static_cast<std::size_t>(second.collections), "collection", "collections"));
}

std::string Captions::text(const std::string& title) const {
  WebVtt out;
  if (!seconds_.contains(0)) out.add(0, title);
  for (const auto& [number, second] : seconds_) {
    out.add(number, (number == 0 ? title + "\n" : "") + describe(second));
  }
  return out.text();
}

}  // namespace merge2d
