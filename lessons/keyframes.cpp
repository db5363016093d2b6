#include "lessons/keyframes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace merge2d {
namespace {

/// Of the reach of the smallest body: a third of a pixel where that body is 30 pixels wide.
constexpr double kTolerance = 0.02;

double reachOf(const BodyInfo& body) {
  double reach = 0.0;
  for (const ConvexShape& shape : body.shapes) {
    const Aabb box = bounds(shape);
    reach = std::max(reach, box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).norm());
  }
  return reach;
}

std::array<double, 3> placeOf(const BodyState& body) {
  return {body.x.x(), body.x.y(), body.angle};
}

}  // namespace

KeyframeFilter::KeyframeFilter(Recording& out) : out_(out) {
  double smallest = std::numeric_limits<double>::max();
  for (const BodyInfo& body : out.bodies) {
    doors_.emplace_back().reach = reachOf(body);
    if (body.motion == Motion::Dynamic) smallest = std::min(smallest, doors_.back().reach);
  }
  if (smallest < std::numeric_limits<double>::max()) tolerance_ = kTolerance * smallest;
}

void KeyframeFilter::add(std::int64_t step, const BodyState& body) {
  Door& door = doors_[index(body.id)];
  BodyTrack& track = out_.tracks[index(body.id)];
  const bool begins = track.at.empty();
  if (begins) track.first = step;
  if (!begins && !passes(door, step, body)) keep(door);
  const bool changes =
      begins || body.collection != door.newest.collection || body.asleep != door.newest.asleep;
  if (!changes) narrow(door, step, body);
  door.last = step;
  door.newest = body;
  if (changes) keep(door);
}

void KeyframeFilter::finish() {
  for (Door& door : doors_) {
    if (!out_.tracks[index(door.newest.id)].at.empty() && door.from < door.last) keep(door);
  }
}

/// Makes the newest sample a keyframe.
void KeyframeFilter::keep(Door& door) {
  const BodyState& body = door.newest;
  BodyTrack& track = out_.tracks[index(body.id)];
  track.at.push_back(static_cast<std::int32_t>(door.last));
  track.append(body);
  door.from = door.last;
  door.origin = placeOf(body);
  constexpr double kAny = std::numeric_limits<double>::infinity();
  door.slopes.fill({-kAny, kAny});
}

/// Whether the straight way to a sample stays close to the samples in between.
bool KeyframeFilter::passes(const Door& door, std::int64_t step, const BodyState& body) const {
  const std::array<double, 3> place = placeOf(body);
  const auto steps = static_cast<double>(step - door.from);
  for (std::size_t i = 0; i < place.size(); ++i) {
    const double slope = (place[i] - door.origin[i]) / steps;
    if (slope < door.slopes[i].least || slope > door.slopes[i].most) return false;
  }
  return true;
}

/// Later ways have to stay close to this sample too.
void KeyframeFilter::narrow(Door& door, std::int64_t step, const BodyState& body) const {
  const std::array<double, 3> place = placeOf(body);
  const auto steps = static_cast<double>(step - door.from);
  const double turn = door.reach > 0.0 ? tolerance_ / door.reach : tolerance_;
  const std::array<double, 3> tolerance = {tolerance_, tolerance_, turn};
  for (std::size_t i = 0; i < place.size(); ++i) {
    const double way = place[i] - door.origin[i];
    Range& range = door.slopes[i];
    range.least = std::max(range.least, (way - tolerance[i]) / steps);
    range.most = std::min(range.most, (way + tolerance[i]) / steps);
  }
}

}  // namespace merge2d
