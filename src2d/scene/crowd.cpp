#include "src2d/scene/crowd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "src2d/core/error.h"
#include "src2d/geometry/box.h"

namespace merge2d {
namespace {

/// One shape of a body that moves, where it starts.
struct CrowdPart {
  Aabb box;
  Vec2 center = Vec2::Zero();  ///< [m]
  std::uint32_t body = 0;
  const ConvexShape* shape = nullptr;
  Pose frame;  ///< of the body
};

/// Finds the boxes around a point: a balanced tree, each of whose nodes halves its parts.
class BoxTree {
 public:
  explicit BoxTree(std::vector<CrowdPart> parts) : parts_(std::move(parts)) {
    if (!parts_.empty()) boxes_.resize(nodesOf(parts_.size())), build(0, 0, parts_.size());
  }

  const std::vector<CrowdPart>& parts() const { return parts_; }

  template <class Visit>
  void around(const Vec2& point, Visit&& visit) const {
    if (!parts_.empty()) look(point, visit, 0, 0, parts_.size());
  }

 private:
  static constexpr std::size_t kLeaf = 8;

  /// The nodes of a tree are stored as one of the first half, then one of the second.
  static std::size_t nodesOf(std::size_t n) {
    return n <= kLeaf ? 1 : 1 + nodesOf(n / 2) + nodesOf(n - n / 2);
  }
  static bool covers(const Aabb& box, const Vec2& p) { return box.overlaps({p, p}); }

  void build(std::size_t node, std::size_t begin, std::size_t end) {
    const auto at = [&](std::size_t i) { return parts_.begin() + static_cast<std::ptrdiff_t>(i); };
    Aabb centers;
    for (std::size_t i = begin; i < end; ++i) {
      boxes_[node].include(parts_[i].box);
      centers.include(parts_[i].center);
    }
    if (end - begin <= kLeaf) return;
    const int axis = centers.extent().x() < centers.extent().y() ? 1 : 0;
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(middle), at(end), [axis](const auto& a, const auto& b) {
      return a.center[axis] < b.center[axis];
    });
    build(node + 1, begin, middle);
    build(node + 1 + nodesOf(middle - begin), middle, end);
  }

  template <class Visit>
  void look(const Vec2& point, Visit& visit, std::size_t node, std::size_t begin,
            std::size_t end) const {
    if (!covers(boxes_[node], point)) return;
    if (end - begin <= kLeaf) {
      for (std::size_t i = begin; i < end; ++i) {
        if (covers(parts_[i].box, point)) visit(parts_[i]);
      }
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    look(point, visit, node + 1, begin, middle);
    look(point, visit, node + 1 + nodesOf(middle - begin), middle, end);
  }

  std::vector<CrowdPart> parts_;
  std::vector<Aabb> boxes_;
};

/// Whether a part covers a point of the world.
bool coversPoint(const CrowdPart& part, const Vec2& point) {
  const ConvexShape& shape = *part.shape;
  const Vec2 p = part.frame.toLocal(point);
  if (const auto* circle = std::get_if<Circle>(&shape)) {
    return (p - circle->center).norm() <= circle->radius;
  }
  const std::vector<Vec2>& corners = std::get<Polygon>(shape).vertices;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2& corner = corners[i];
    if (cross(corners[(i + 1) % corners.size()] - corner, p - corner) < 0.0) return false;
  }
  return true;
}

/// All bodies of a scene that move.
class Places {
 public:
  explicit Places(const Scene& scene) : tree_(partsOf(scene)), joined_(scene.bodies.size()) {
    for (const JointDesc& joint : scene.joints) {
      joined_[joint.a].push_back(joint.b.value_or(joint.a));
      if (joint.b) joined_[*joint.b].push_back(joint.a);
    }
    first_.assign(scene.bodies.size() + 1, 0);
    order_.resize(tree_.parts().size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(tree_.parts()[a].body, a) < std::pair(tree_.parts()[b].body, b);
    });
    for (const CrowdPart& part : tree_.parts()) ++first_[part.body + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    seen_.assign(scene.bodies.size(), kNobody);
  }

  /// How many bodies lie in the place of one, where these are too many; else 0.
  std::size_t crowdAround(std::uint32_t body) {
    std::size_t all = 0, loose = 0;
    for (std::size_t i = first_[body]; i < first_[body + 1]; ++i) {
      const CrowdPart& part = tree_.parts()[order_[i]];
      tree_.around(part.center, [&](const CrowdPart& other) {
        if (other.body == body || seen_[other.body] == body) return;
        if (!share(part, other) || areJoined(body, other.body)) return;
        seen_[other.body] = body;
        ++all;
        if (joined_[body].empty() || joined_[other.body].empty()) ++loose;
      });
    }
    return loose > kInOnePlace || all > kHeldInOnePlace ? all : 0;
  }

 private:
  static constexpr std::uint32_t kNobody = 0xffffffffu;

  static std::vector<CrowdPart> partsOf(const Scene& scene) {
    std::vector<CrowdPart> parts;
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
      const BodyDesc& body = scene.bodies[i];
      if (body.motion != Motion::Dynamic) continue;
      const Pose pose = Pose::at(body.at, body.angle);
      for (const ConvexShape& shape : body.shapes) {
        const Vec2 center = pose.exactly(areaProperties(shape).centroid);
        parts.push_back({bounds(shape, pose), center, i, &shape, pose});
      }
    }
    return parts;
  }

  static bool share(const CrowdPart& a, const CrowdPart& b) {
    return coversPoint(a, b.center) && coversPoint(b, a.center);
  }

  bool areJoined(std::uint32_t a, std::uint32_t b) const {
    return std::find(joined_[a].begin(), joined_[a].end(), b) != joined_[a].end();
  }

  BoxTree tree_;
  std::vector<std::vector<BodyIndex>>
      joined_;                              ///< per body: those joined to it; the world as itself
  std::vector<std::size_t> first_, order_;  ///< per body: its parts
  std::vector<std::uint32_t> seen_;         ///< per body: for whom it was counted last
};

/// 2999 as "2,999".
std::string withCommas(std::size_t number) {
  std::string digits = std::to_string(number);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  }
  return digits;
}

/// The bodies that come out of an emitter within one step, before they can move away.
std::optional<Crowd> crowdOf(const EmitterDesc& emitter, double step) {
  const double at_once = std::min<double>(emitter.count, std::ceil(step / emitter.every));
  Aabb box;
  for (const ConvexShape& shape : emitter.body.shapes) box.include(bounds(shape));
  // A body lies in the place of one if it is nearer than half its size on either side.
  const Vec2 size = box.extent(), room = size + 2.0 * emitter.spread;
  const double share = size.prod() / room.prod();
  const double others = (at_once - 1.0) * share;
  if (!(others > static_cast<double>(kInOnePlace))) return {};
  return Crowd{
      "every", emitter.body.name,
      fmt::format("{} bodies come into the place of {}[0] within one step, but at most {} "
                  "may: are 'every' and 'spread' right?",
                  withCommas(static_cast<std::size_t>(others)), emitter.body.name, kInOnePlace)};
}

}  // namespace

std::optional<Crowd> findCrowd(const Scene& scene) {
  for (const EmitterDesc& emitter : scene.emitters) {
    if (auto crowd = crowdOf(emitter, scene.step)) return crowd;
  }
  if (scene.bodies.size() <= kInOnePlace) return {};
  Places places(scene);
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
    const std::size_t others = places.crowdAround(i);
    if (others == 0) continue;
    const std::string& name = scene.bodies[i].name;
    const bool copy = name.ends_with(']');
    return Crowd{copy ? "repeat" : "at", name,
                 fmt::format("{} bodies lie in the place of {}, but at most {} may; is '{}' right?",
                             withCommas(others), name.empty() ? fmt::format("body[{}]", i) : name,
                             kInOnePlace, copy ? "spacing" : "at")};
  }
  return {};
}

void refuseCrowds(const Scene& scene) {
  if (const auto crowd = findCrowd(scene)) throw InputError(crowd->sentence);
}

}  // namespace merge2d
