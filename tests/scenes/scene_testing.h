#pragma once
/// Built-in scenes, and what is asked about them by the names of their bodies.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "src2d/scene/load.h"
#include "src2d/world.h"
#include "tests/support/anchored.h"

namespace merge2d {

/// A scene of the folder scenes/ that runs, with a record of its events.
class SceneRun {
 public:
  struct Logged {
    std::int64_t step = 0;
    EventType type = EventType::Merge;
    EventReason reason = EventReason::None;
    std::string a, b;
  };

  explicit SceneRun(const std::string& scene, Mode mode = Mode::MergeSleep,
                    const Overrides& overrides = {})
      : SceneRun(loadScene(scenePath(scene), overrides), mode) {}
  SceneRun(const Scene& scene, Mode mode) : world_(scene, {.mode = mode, .timings = false}) {
    for (const BodyInfo& body : world_.bodies()) {
      ids_.emplace(body.name, BodyId{static_cast<std::uint32_t>(ids_.size())});
    }
    world_.capture(now_);
  }

  static std::string scenePath(const std::string& scene) {
    return std::string(MERGE2D_SOURCE_DIR) + "/scenes/" + scene + ".toml";
  }

  const World& world() const { return world_; }
  World& world() { return world_; }
  const Snapshot& now() const { return now_; }
  const std::vector<Logged>& log() const { return log_; }

  void steps(std::int64_t n) {
    for (std::int64_t i = 0; i < n; ++i) {
      world_.step();
      for (const Event& e : world_.events()) {
        log_.push_back({world_.steps(), e.type, e.reason, world_.bodies()[index(e.a)].name,
                        world_.bodies()[index(e.b)].name});
      }
    }
    world_.capture(now_);
  }
  void until(double time) { steps(std::llround(time / world_.scene().step) - world_.steps()); }

  const BodyState& body(const std::string& name) const {
    const BodyId id = ids_.at(name);
    const auto at = std::ranges::find(now_.bodies, id, &BodyState::id);
    if (at == now_.bodies.end()) throw std::out_of_range(name + " is not alive");
    return *at;
  }
  bool merged(const std::string& name) const { return body(name).collection != kNoCollection; }
  bool together(const std::string& a, const std::string& b) const {
    return merged(a) && body(a).collection == body(b).collection;
  }
  /// Whether it is welded to what is pinned or scripted.
  bool anchored(const std::string& name) const { return isAnchored(now_, body(name)); }
  /// The place of one body in the frame of another.
  Vec2 seenFrom(const std::string& frame, const std::string& name) const {
    const BodyState& f = body(frame);
    return Pose::at(f.x, f.angle).toLocal(body(name).x);
  }

  bool dynamic(BodyId id) const { return world_.bodies()[index(id)].motion == Motion::Dynamic; }
  const std::string& nameOf(BodyId id) const { return world_.bodies()[index(id)].name; }

  int count(EventType type, std::int64_t after = 0) const {
    return static_cast<int>(std::ranges::count_if(
        log_, [&](const Logged& e) { return e.type == type && e.step > after; }));
  }
  /// The step of the first event of this type in which a body took part; −1 when there is none.
  std::int64_t first(EventType type, const std::string& name) const {
    for (const Logged& e : log_) {
      if (e.type == type && (e.a == name || e.b == name)) return e.step;
    }
    return -1;
  }
  int eventsAfter(std::int64_t step) const {
    return count(EventType::Merge, step) + count(EventType::Unmerge, step);
  }

 private:
  World world_;
  std::map<std::string, BodyId> ids_;
  Snapshot now_;
  std::vector<Logged> log_;
};

/// "domino[3,0]".
inline std::string cell(const std::string& name, int column, int row) {
  return name + "[" + std::to_string(column) + "," + std::to_string(row) + "]";
}

/// The largest distance of a body from where it is in the reference [m].
inline double farthest(const SceneRun& run, const SceneRun& reference) {
  double distance = 0.0;
  for (std::size_t i = 0; i < run.now().bodies.size(); ++i) {
    distance = std::max(distance, (run.now().bodies[i].x - reference.now().bodies[i].x).norm());
  }
  return distance;
}

/// What a disturbance does to a body.
struct Reaction {
  double way = 0.0;    ///< the farthest it gets in the reference within half a second, in sizes
  bool freed = false;  ///< in mode merge: left the collection that it had been in, or the ground
};

/// Runs a scene up to `time` [s], and looks at what moves in the reference and what comes free in
/// the other within half a second of it.
inline std::vector<Reaction> disturb(SceneRun& reference, SceneRun& merged, double time,
                                     double size) {
  reference.until(time), merged.until(time);
  std::map<BodyId, Vec2> before;
  std::map<BodyId, std::pair<CollectionId, bool>> belonged;
  const auto place = [&](const BodyState& b) {
    return std::pair(b.collection, merged.anchored(merged.nameOf(b.id)));
  };
  for (const BodyState& b : reference.now().bodies) before[b.id] = b.x;
  for (const BodyState& b : merged.now().bodies) belonged[b.id] = place(b);
  std::map<BodyId, Reaction> seen;
  const double end = time + 0.5;
  while (merged.world().time() < end - 1e-9) {
    merged.steps(1), reference.until(merged.world().time());
    for (const BodyState& b : reference.now().bodies) {
      double& way = seen[b.id].way;
      way = std::max(way, (b.x - before[b.id]).norm() / size);
    }
    for (const BodyState& b : merged.now().bodies) seen[b.id].freed |= place(b) != belonged[b.id];
  }
  std::vector<Reaction> out;
  for (const auto& [id, reaction] : seen) {
    if (merged.dynamic(id)) out.push_back(reaction);
  }
  return out;
}

/// How many of them moved farther than `least` and no farther than `most` [sizes], and how many of
/// those came free.
inline std::pair<int, int> movedAndFreed(const std::vector<Reaction>& seen, double least,
                                         double most = 1e9) {
  std::pair<int, int> out{0, 0};
  for (const Reaction& r : seen) {
    if (r.way <= least || r.way > most) continue;
    ++out.first;
    out.second += r.freed;
  }
  return out;
}

}  // namespace merge2d
