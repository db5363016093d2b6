#include "src2d/scene/rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src2d/scene/names.h"

namespace merge2d {
namespace {

Verdict complain(std::string_view key, std::string_view sentence) {
  return Complaint{key, std::string(sentence)};
}

}  // namespace

std::string mustBe(std::string_view key, std::string_view home, std::string_view what,
                   std::string_view is) {
  return fmt::format("'{}' in {} must be {}, but is {}", key, home, what, is);
}

std::string shownNumber(double number) {
  const std::string digits = fmt::format("{}", number);
  return digits.find_first_of(".en") == std::string::npos ? digits + ".0" : digits;
}

Verdict judgeBody(const BodyDesc& body) {
  const bool dynamic = body.motion == Motion::Dynamic;
  const bool scripted = body.motion == Motion::Scripted;
  if (body.shapes.empty()) {
    return complain("", "a body needs a shape: box, circle, polygon or shapes");
  }
  if (scripted && !body.script) {
    return complain("motion",
                    "a scripted body needs a script, such as script = { velocity = [1, 0] }");
  }
  if (body.script && !scripted) return complain("script", "a script needs motion = \"scripted\"");
  const std::string_view instead =
      scripted ? "a scripted body moves by its script only" : "a pinned body does not move";
  if (!dynamic && body.velocity != Vec2::Zero()) return complain("velocity", instead);
  if (!dynamic && body.spin != 0.0) return complain("spin", instead);
  if (!dynamic && body.pinned_until > 0.0) {
    return complain("pinned_until", "only a dynamic body can be pinned for a while");
  }
  return {};
}

Verdict judgeKey(const Keyframes::Key& key, const Keyframes::Key* before) {
  if (!(key.time >= 0.0)) {
    return complain(
        "keyframes",
        fmt::format("key frames start at time 0 or later, but this one is at {} s", key.time));
  }
  if (!(key.position.cwiseAbs().maxCoeff() <= SceneLimits::kCoordinate)) {
    return complain("keyframes", "a key frame stands further than 1e6 m from the origin");
  }
  if (before != nullptr && key.time <= before->time) {
    return complain("keyframes", fmt::format("the times of key frames must increase, but {} "
                                             "follows {}",
                                             key.time, before->time));
  }
  return {};
}

Verdict judgeDistance(const JointDesc& joint) {
  if (joint.limits && joint.limits->lower < 0.0) {
    return complain("limits", "the limits of a distance joint are lengths: 0 or more");
  }
  if (joint.limits && joint.limits->upper < SceneLimits::kSmallest) {
    return complain("limits",
                    "the longest length must be positive; what shares a point is joined "
                    "by kind = \"revolute\"");
  }
  if (joint.limits && joint.length) {
    return complain("length", "a joint with 'limits' has no 'length' of its own");
  }
  if (joint.limits && joint.stiffness > 0.0) {
    return complain("stiffness", "a joint with 'limits' cannot be a spring too: add another joint");
  }
  if (joint.damping > 0.0 && joint.stiffness == 0.0) {
    return complain("damping", "'damping' belongs to a joint with 'stiffness'");
  }
  if ((joint.to - joint.at).norm() < SceneLimits::kSmallest && !joint.limits) {
    return complain("to",
                    "the ends of a distance joint must be apart: 'at' and 'to' are one point");
  }
  return {};
}

Verdict judgeLimits(const JointDesc::Limits& limits) {
  if (limits.lower <= limits.upper) return {};
  return complain("limits",
                  fmt::format("the lower limit must come first, but {0} is above {1}: write "
                              "[{1}, {0}]",
                              limits.lower, limits.upper));
}

Verdict judgeTimes(std::string_view what, double from, double until) {
  if (until > from) return {};
  return complain("until",
                  fmt::format("{} must end after it begins, but it begins at {} s and ends at {} s",
                              what, from, until));
}

Verdict judgeInterval(const MagnetDesc::Interval& on, const MagnetDesc::Interval* before) {
  if (!(on.from >= 0.0)) {
    return complain("on", fmt::format("time begins at 0, but this interval at {} s", on.from));
  }
  if (Verdict verdict = judgeTimes("an interval", on.from, on.until)) return verdict;
  if (before == nullptr || on.from >= before->until) return {};
  return complain("on", fmt::format("the intervals of a magnet must follow one another, but this "
                                    "one begins at {} s, and the one before ends at {} s",
                                    on.from, before->until));
}

bool moves(const BodyDesc& body) { return body.motion == Motion::Dynamic; }

Verdict judgeMoves(std::string_view what, const BodyDesc& body) {
  if (moves(body)) return {};
  return complain("body", fmt::format("{} has no effect on '{}', which is {}", what, body.name,
                                      nameOf(body.motion)));
}

Verdict judgeJoint(const BodyDesc& a, const BodyDesc* b) {
  if (moves(a) || (b != nullptr && moves(*b))) return {};
  if (b == nullptr) {
    return complain("bodies", fmt::format("a joint to the world has no effect on '{}', which is {}",
                                          a.name, nameOf(a.motion)));
  }
  return complain("bodies", fmt::format("a joint has no effect between '{}', which is {}, and "
                                        "'{}', which is {}",
                                        a.name, nameOf(a.motion), b->name, nameOf(b->motion)));
}

std::optional<std::string> doubtOfMixedRules(const Settings& settings) {
  const std::string_view merging = nameOf(settings.merging.rule);
  const std::string_view unmerging = nameOf(settings.unmerging.rule);
  if (merging == unmerging) return std::nullopt;
  return fmt::format(
      "merging.rule is \"{}\" and unmerging.rule is \"{}\": one cuts the welds of the other, so "
      "that pairs merge and come apart in turn; set both to one rule",
      merging, unmerging);
}

}  // namespace merge2d
