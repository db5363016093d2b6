#pragma once
/// The faults of a description, be it from a scene file, where the reader adds the place, or from a
/// program that fills in the structs itself.

#include <optional>
#include <string>
#include <string_view>

#include "src2d/scene/range.h"
#include "src2d/scene/scene.h"

namespace merge2d {

/// A fault: the key of a scene file that has it, and the sentence for the user.
struct Complaint {
  std::string_view key;
  std::string sentence;
};
using Verdict = std::optional<Complaint>;

/// "'mass' in [[body]] must be positive (1e-12 to 1e12), but is -1.0".
std::string mustBe(std::string_view key, std::string_view home, std::string_view what,
                   std::string_view is);
/// A number as a scene file may write it, with a point or an exponent.
std::string shownNumber(double number);

/// Motion, shapes and script have to fit each other.
Verdict judgeBody(const BodyDesc& body);
/// Times and places of key frames; a complaint's key is that of the row: "keyframes[3]".
Verdict judgeKey(const Keyframes::Key& key, const Keyframes::Key* before);
/// Length, limits and spring of a distance joint.
Verdict judgeDistance(const JointDesc& joint);
Verdict judgeLimits(const JointDesc::Limits& limits);
/// An end in time, after its beginning: "a force".
Verdict judgeTimes(std::string_view what, double from, double until);
/// An interval of a magnet, which follows the one before, if any.
Verdict judgeInterval(const MagnetDesc::Interval& on, const MagnetDesc::Interval* before);

bool moves(const BodyDesc& body);
/// Acting on a body that does not move has no effect: "an impulse".
Verdict judgeMoves(std::string_view what, const BodyDesc& body);
/// At least one of both ends must move; `b` may be null, which is the world.
Verdict judgeJoint(const BodyDesc& a, const BodyDesc* b);

/// The warning of settings under which one rule merges and another unmerges.
std::optional<std::string> doubtOfMixedRules(const Settings& settings);

}  // namespace merge2d
