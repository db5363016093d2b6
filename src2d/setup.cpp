#include "src2d/setup.h"

#include <algorithm>
#include <map>
#include <random>

#include "src2d/contact/broadphase.h"
#include "src2d/contact/internal_edges.h"
#include "src2d/core/assert.h"
#include "src2d/core/memory.h"

namespace merge2d {
namespace {

class Builder {
 public:
  explicit Builder(Setup& setup) : setup_(setup) {}

  void build(const Scene& scene, Mode mode) {
    State& s = setup_.state;
    s.settings = scene.settings;
    s.mode = mode;
    s.h = scene.step;
    s.gravity = scene.gravity;
    for (const BodyDesc& desc : scene.bodies) addBody(desc, desc.at, true);
    for (const EmitterDesc& emitter : scene.emitters) addEmitter(emitter, scene.seed);
    for (const SpringDesc& spring : scene.springs) {
      const Vec2 other = spring.to_body ? centers_[*spring.to_body] : Vec2::Zero();
      appendSpring(setup_.actions, spring, centers_[spring.body], other);
    }
    for (const JointDesc& joint : scene.joints) appendJoint(s, joint);
    for (ForceDesc force : scene.forces) {
      force.at -= centers_[force.body];
      setup_.actions.forces.push_back(force);
    }
    setup_.actions.impulses = scene.impulses;
    for (ImpulseDesc& impulse : setup_.actions.impulses) impulse.at = placedOnGrid(impulse.at);
    std::stable_sort(setup_.actions.impulses.begin(), setup_.actions.impulses.end(),
                     [](const auto& x, const auto& y) { return x.time < y.time; });
    std::stable_sort(setup_.actions.emissions.begin(), setup_.actions.emissions.end(),
                     [](const auto& x, const auto& y) { return x.time < y.time; });
    setup_.actions.magnets = scene.magnets;
    enterWorld();
  }

  /// `alive` says whether it is there from the start.
  BodyId addBody(const BodyDesc& desc, const Vec2& at, bool alive) {
    State& s = setup_.state;
    const auto id = static_cast<std::uint32_t>(s.bodies.size());
    MERGE2D_ASSERT(!desc.shapes.empty(), "body '{}' has no shape", desc.name);
    const AreaProperties area = areaProperties(desc.shapes);

    Body body;
    body.mass = desc.mass.value_or(desc.density * area.area);
    body.inertia = body.mass * area.secondMoment / area.area;
    body.friction = desc.friction;
    body.restitution = desc.restitution;
    body.rolling = static_cast<float>(desc.rolling);
    body.surface_velocity = static_cast<float>(desc.surface_velocity);
    body.motion = desc.motion;
    body.alive = alive;
    body.rigid = RigidId{id};
    Rigid r;
    addShapes(desc, area.centroid, body, r);
    r.angle = desc.angle;
    r.rotation = r.previous_rotation = Rotation::of(desc.angle);
    r.x = placedOnGrid(at);
    r.moveBy(r.rotation * area.centroid);
    r.mass = body.mass;
    r.inertia = body.inertia;
    r.anchor = anchorOf(desc, id);
    if (r.floating()) {
      r.v = desc.velocity;
      r.omega = desc.spin;
      r.inv_mass = 1.0 / r.mass;
      r.inv_inertia = 1.0 / r.inertia;
    }
    if (desc.script) {
      auto script = *desc.script;
      if (auto* keyframes = std::get_if<Keyframes>(&script)) {
        for (Keyframes::Key& key : keyframes->keys) key.position = placedOnGrid(key.position);
      }
      setup_.actions.scripts.push_back({BodyId{id}, std::move(script),
                                        Pose::at(placedOnGrid(at), desc.angle), desc.angle,
                                        area.centroid});
    }
    s.bodies.push_back(body);
    s.rigids.push_back(r);
    centers_.push_back(area.centroid);
    if (desc.pinned_until > 0.0) {
      setup_.actions.launches.push_back({BodyId{id}, desc.pinned_until, desc.velocity, desc.spin});
    }
    return BodyId{id};
  }

 private:
  /// Shapes are kept in the frame at the centre of mass.
  void addShapes(const BodyDesc& desc, const Vec2& centroid, Body& body, Rigid& r) {
    State& s = setup_.state;
    body.first_shape = static_cast<std::uint32_t>(s.shape_body.size());
    body.shape_count = static_cast<std::uint32_t>(desc.shapes.size());
    std::vector<Vec2> outline;
    Extent extent;
    for (const ConvexShape& shape : desc.shapes) {
      const ConvexShape centered = transformed(shape, {-centroid, {}});
      s.shape_collider.push_back(colliderFor(centered));
      s.shape_body.push_back(BodyId{static_cast<std::uint32_t>(body.rigid)});
      extent.bounds.include(s.collider_bounds[s.shape_collider.back()]);
      for (const Vec2& p : outlinePoints(centered)) outline.push_back(p);
    }
    extent.box = tightBox(outline);
    r.extent = extentFor(extent);
  }

  /// Bodies that reach equally far share an extent.
  std::uint32_t extentFor(const Extent& extent) {
    const Aabb& bounds = extent.bounds;
    const OrientedBox& box = extent.box;
    const std::array<double, 10> numbers{
        bounds.lower.x(),     bounds.lower.y(),    bounds.upper.x(),       bounds.upper.y(),
        box.half.x(),         box.half.y(),        box.frame.position.x(), box.frame.position.y(),
        box.frame.rotation.c, box.frame.rotation.s};
    State& s = setup_.state;
    const auto next = static_cast<std::uint32_t>(s.extents.size());
    const auto [at, is_new] = extents_.try_emplace(numbers, next);
    if (is_new) s.extents.push_back(extent);
    return at->second;
  }

  /// Bodies of one shape share its collider.
  std::uint32_t colliderFor(const ConvexShape& shape) {
    std::vector<double> numbers;
    for (const Vec2& p : outlinePoints(shape)) numbers.insert(numbers.end(), {p.x(), p.y()});
    if (std::holds_alternative<Circle>(shape)) numbers.push_back(0.0);  // not its bounding square
    State& s = setup_.state;
    const auto next = static_cast<std::uint32_t>(s.colliders.size());
    const auto [at, added] = known_.try_emplace(std::move(numbers), next);
    if (added) {
      s.colliders.emplace_back(shape);
      s.collider_bounds.push_back(bounds(shape));
    }
    return at->second;
  }

  static FrameId anchorOf(const BodyDesc& desc, std::uint32_t id) {
    if (desc.motion == Motion::Scripted) return static_cast<FrameId>(id) + 1;
    // A body that is merged with the ground must have contacts of its own with a belt beside it.
    const bool fixed = desc.motion == Motion::Pinned;
    if (fixed && desc.surface_velocity != 0.0) return static_cast<FrameId>(id) + 1;
    if (desc.motion == Motion::Pinned || desc.pinned_until > 0.0) return kWorldFrame;
    return kFloating;
  }

  void addEmitter(const EmitterDesc& emitter, std::uint64_t seed) {
    std::mt19937_64 random(seed * 0x9e3779b97f4a7c15u + emitter.seed);
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
    for (int i = 0; i < emitter.count; ++i) {
      const double dx = uniform(), dy = uniform();
      const Vec2 at = emitter.body.at + Vec2(dx * emitter.spread.x(), dy * emitter.spread.y());
      const BodyId id = addBody(emitter.body, at, false);
      setup_.actions.emissions.push_back({emitter.start + i * emitter.every, id});
    }
  }

  void enterWorld() {
    State& s = setup_.state;
    listJoints(s);
    s.broadphase.shape_trees.resize(s.rigids.size());
    s.present.ids().reserve(s.rigids.size());
    s.broadphase.shape_leaves.assign(s.shape_body.size(), -1);
    listSiblings(s);
    for (const Actions::Scripted& script : setup_.actions.scripts) {
      Rigid& r = s[rigidOf(script.body)];
      const ScriptPose pose = scriptPose(script, 0.0);
      r.angle = pose.angle;
      r.rotation = r.previous_rotation = Rotation::of(pose.angle);
      r.x = Pose{pose.position, r.rotation} * script.center;
    }
    for (std::uint32_t i = 0; i < s.bodies.size(); ++i) {
      if (s.bodies[i].alive) bringIn(s, BodyId{i});
    }
    tighten(s.bodies, s.rigids, s.extents, s.shape_collider, s.shape_body, s.first_sibling);
  }

  Setup& setup_;
  std::vector<Vec2> centers_;
  std::map<std::array<double, 10>, std::uint32_t> extents_;
  std::map<std::vector<double>, std::uint32_t> known_;  ///< colliders by their outline
};

}  // namespace

void setUp(const Scene& scene, Mode mode, Setup& out) { Builder(out).build(scene, mode); }

namespace {

/// Collections follow the bodies: one more body behind the first `bodies` moves each on by one.
void moveCollectionsOn(State& s, std::size_t bodies) {
  const auto moveOn = [&](auto& rigid) {
    if (static_cast<std::size_t>(rigid) < bodies) return;
    rigid = static_cast<std::remove_reference_t<decltype(rigid)>>(
        static_cast<std::uint32_t>(rigid) + 1);
  };
  for (std::size_t i = 0; i < bodies; ++i) moveOn(s.bodies[i].rigid);
  for (RigidId& r : s.present.ids()) moveOn(r);
  for (NearPair& pair : s.broadphase.near) {
    moveOn(pair.a);
    moveOn(pair.b);
  }
  for (Collection& c : s.collections) {
    moveOn(c.rigid);
    for (JointBlock& joint : c.joints) {  // the world stands behind the last body
      moveOn(joint.a);
      moveOn(joint.b);
    }
  }
}

}  // namespace

BodyId appendBody(Setup& setup, const BodyDesc& desc) {
  State& s = setup.state;
  const std::size_t bodies = s.bodies.size(), extents = s.extents.size() - s.collections.size();
  const auto split = [](auto& table, std::size_t at) {
    const auto middle = table.begin() + static_cast<std::ptrdiff_t>(at);
    auto behind = std::vector(middle, table.end());
    table.erase(middle, table.end());
    return behind;
  };
  std::vector<Rigid> rigids = split(s.rigids, bodies);
  const std::vector<Extent> of_collections = split(s.extents, extents);
  const BodyId id = Builder(setup).addBody(desc, desc.at, false);
  setup.added.push_back(desc);

  const auto more = static_cast<std::uint32_t>(s.extents.size() - extents);
  for (Rigid& r : rigids) r.extent += more;
  s.rigids.insert(s.rigids.end(), rigids.begin(), rigids.end());
  s.extents.insert(s.extents.end(), of_collections.begin(), of_collections.end());
  auto& trees = s.broadphase.shape_trees;
  trees.emplace(trees.begin() + static_cast<std::ptrdiff_t>(bodies));
  s.broadphase.shape_leaves.resize(s.shape_body.size(), -1);
  listSiblings(s);
  moveCollectionsOn(s, bodies);
  s.ready_before.clear();
  rebuildTree(s);
  return id;
}

namespace {

/// In a joint the second body moves against the first, but of one to the world the user sees the
/// body alone: its turn and its way are the opposite of the world's.
void turnRound(Joint& joint) {
  if (joint.motor) joint.motor->speed = -joint.motor->speed;
  const bool length = joint.kind == JointKind::Distance;  // the same from both ends
  if (joint.limits && !length) joint.limits = {-joint.limits->upper, -joint.limits->lower};
}

}  // namespace

void appendJoint(State& s, const JointDesc& desc) {
  const auto local = [&](BodyIndex body, const Vec2& at) {
    const Pose pose = s.pose(BodyId{static_cast<std::uint32_t>(body)});
    return pose.rotation.inverse() * (at - pose.position);
  };
  const auto angle = [&](BodyIndex body) {
    return s.angle(BodyId{static_cast<std::uint32_t>(body)});
  };
  Joint joint;
  joint.kind = desc.kind;
  joint.a = BodyId{static_cast<std::uint32_t>(desc.a)};
  joint.to_world = !desc.b;
  joint.anchor_a = local(desc.a, desc.at);
  joint.anchor_b = desc.kind == JointKind::Distance ? desc.to : desc.at;
  joint.reference = -angle(desc.a);
  if (desc.b) {
    joint.b = BodyId{static_cast<std::uint32_t>(*desc.b)};
    joint.anchor_b = local(*desc.b, joint.anchor_b);
    joint.reference += angle(*desc.b);
  }
  joint.axis = s.pose(joint.a).rotation.inverse() * desc.axis.normalized();
  joint.length = desc.length.value_or((desc.to - desc.at).norm());
  joint.stiffness = desc.stiffness;
  joint.damping = desc.damping;
  joint.compliance = desc.compliance;
  joint.limits = desc.limits;
  joint.motor = desc.motor;
  if (joint.to_world) turnRound(joint);
  joint.break_force = desc.break_force;
  joint.break_torque = desc.break_torque;
  joint.collide = desc.collide;
  s.joints.push_back(joint);
}

void appendSpring(Actions& actions, const SpringDesc& spring, const Vec2& center_of_body,
                  const Vec2& center_of_other) {
  TimedSpring t;
  t.body = spring.body;
  t.anchor = spring.anchor - center_of_body;
  t.to = placedOnGrid(spring.to);
  if (spring.to_body) {
    t.to_body = static_cast<std::int64_t>(*spring.to_body);
    t.to -= center_of_other;
  }
  t.stiffness = spring.stiffness;
  t.damping = spring.damping;
  t.rest_length = spring.rest_length;
  actions.springs.push_back(t);
}

std::vector<BodyInfo> describeBodies(const Scene& scene, const Setup& setup) {
  const State& state = setup.state;
  std::vector<BodyInfo> infos;
  infos.reserve(state.bodies.size());
  const auto describe = [&](const BodyDesc& desc, const std::string& name) {
    const Body& body = state.bodies[infos.size()];
    BodyInfo info{.name = name,
                  .motion = desc.motion,
                  .mass = body.mass,
                  .inertia = body.inertia,
                  .shapes = {}};
    for (std::uint32_t i = 0; i < body.shape_count; ++i) {
      info.shapes.push_back(state.collider(body.first_shape + i).shape());
    }
    infos.push_back(std::move(info));
  };
  for (const BodyDesc& desc : scene.bodies) describe(desc, desc.name);
  for (const EmitterDesc& emitter : scene.emitters) {
    for (int i = 0; i < emitter.count; ++i) {
      describe(emitter.body, emitter.body.name + "[" + std::to_string(i) + "]");
    }
  }
  for (const BodyDesc& desc : setup.added) describe(desc, desc.name);
  for (const MagnetDesc& magnet : scene.magnets) infos[magnet.body].magnet = true;
  return infos;
}

const BodyDesc& descriptionOf(const Scene& scene, const Setup& setup, BodyId body) {
  std::size_t i = index(body);
  if (i < scene.bodies.size()) return scene.bodies[i];
  i -= scene.bodies.size();
  for (const EmitterDesc& emitter : scene.emitters) {
    const auto count = static_cast<std::size_t>(emitter.count);
    if (i < count) return emitter.body;
    i -= count;
  }
  return setup.added[i];
}

void bringIn(State& state, BodyId body) {
  state[body].alive = true;
  if (state[body].shape_count > 1) addShapes(state, rigidOf(body), {body});
  insertRigid(state, rigidOf(body));
}

}  // namespace merge2d
