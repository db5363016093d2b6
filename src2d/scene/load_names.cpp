/// Names of bodies: what may be one, and which body is meant.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "src2d/core/utf8.h"
#include "src2d/scene/interpret.h"

namespace merge2d {
namespace {

/// "brick" of the copy "brick[3,4]" and of the emitted body "brick[7]".
std::string_view stem(std::string_view name) {
  return name.ends_with(']') ? name.substr(0, name.find('[')) : name;
}

/// A body, or all copies of one, in the order of the scene.
struct Group {
  std::string_view stem, first, last;
};

std::vector<Group> groupsOf(const std::vector<BodyDesc>& bodies) {
  std::vector<Group> groups;
  for (const BodyDesc& body : bodies) {
    const bool copy = stem(body.name) != body.name;
    if (copy && !groups.empty() && groups.back().stem == stem(body.name)) {
      groups.back().last = body.name;
    } else {
      groups.push_back({stem(body.name), body.name, body.name});
    }
  }
  return groups;
}

std::string shown(const Group& group) {
  if (group.first == group.last) return fmt::format("'{}'", group.first);
  return fmt::format("'{}' to '{}'", group.first, group.last);
}

/// Whether one of two words, upper and lower case being the same, is part of the other.
bool contains(std::string_view a, std::string_view b) {
  constexpr std::size_t kTelling = 3;  // shorter parts occur anywhere
  if (a.size() < b.size()) std::swap(a, b);
  const auto same = [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  };
  const auto found = std::search(a.begin(), a.end(), b.begin(), b.end(), same);
  return b.size() >= kTelling && found != a.end();
}

/// The first body of the group that `name` may be meant for, or nothing.
std::string_view similar(std::string_view name, const std::vector<Group>& groups) {
  std::vector<std::string_view> stems;
  for (const Group& group : groups) stems.push_back(group.stem);
  const std::string_view near = nearest(stem(name), stems);
  for (const Group& group : groups) {
    if (!near.empty() ? group.stem == near : contains(group.stem, stem(name))) return group.first;
  }
  return {};
}

/// The end of "no body is called 'brik'": which one may be meant, or else which there are.
std::string suggestion(const std::string& name, const Scene& scene) {
  constexpr std::size_t kFew = 8;
  if (scene.bodies.empty()) return ": the scene has no [[body]]";
  std::vector<std::string_view> all;
  for (const BodyDesc& body : scene.bodies) all.push_back(body.name);
  const std::vector<Group> groups = groupsOf(scene.bodies);
  for (const Group& group : groups) {
    const bool copies = group.first != group.last && group.stem == stem(name);
    if (copies) return fmt::format(": the copies of '{}' are {}", group.stem, shown(group));
  }
  if (const std::string whole = didYouMean(name, all); !whole.empty()) return whole;
  if (const std::string_view meant = similar(name, groups); !meant.empty()) {
    return fmt::format(" (did you mean '{}'?)", meant);
  }
  if (groups.size() > kFew) return "";
  std::string list;
  for (const Group& group : groups) list += (list.empty() ? "" : ", ") + shown(group);
  return fmt::format(": {} {}", groups.size() == 1 ? "there is only" : "there are", list);
}

}  // namespace

void checkName(const Value& value, const std::string& name) {
  constexpr std::size_t kLongest = 100;
  if (name.empty()) value.fail("a name must not be empty");
  if (name.size() > kLongest) value.fail("a name has at most 100 characters");
  if (hasControl(name)) value.fail("a name is one line without control characters");
}

BodyIndex bodyNamed(const Value& value, const Scene& scene, const BodyNames& names) {
  const std::string name = value.text();
  const auto found = names.find(name);
  if (found != names.end()) return found->second;
  if (names.contains(name + "[0,0]")) {
    value.fail(fmt::format("'{0}' is repeated: say which copy, such as '{0}[0,0]'", name));
  }
  for (const EmitterDesc& emitter : scene.emitters) {
    if (stem(name) != emitter.body.name) continue;
    value.fail(
        fmt::format("'{}' is emitted while the scene runs: joints, springs, impulses, "
                    "forces and magnets need a [[body]]",
                    name));
  }
  value.fail(fmt::format("no body is called '{}'{}", name, suggestion(name, scene)));
}

}  // namespace merge2d
