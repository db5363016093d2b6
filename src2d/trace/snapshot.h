#pragma once
/// The visible state of a world after a step (or a stage of one), as plain data: the one source of
/// the trace, the pictures, the summaries and the lessons. A snapshot owns its numbers, so that it
/// can be drawn while the world goes on.

#include <cstdint>
#include <string>
#include <vector>

#include "src2d/core/decisions.h"
#include "src2d/core/events.h"
#include "src2d/core/ids.h"
#include "src2d/core/springs.h"
#include "src2d/core/stats.h"
#include "src2d/geometry/box.h"
#include "src2d/geometry/shape.h"
#include "src2d/scene/scene.h"

namespace merge2d {

/// The constant data of a body. All bodies of a run, also those not emitted yet, have their entry
/// from the start: `World::bodies()[index(id)]`.
struct BodyInfo {
  std::string name;
  Motion motion = Motion::Dynamic;
  double mass = 0.0;                ///< [kg]; of pinned and scripted bodies too
  double inertia = 0.0;             ///< about the centre of mass [kg m²]
  std::vector<ConvexShape> shapes;  ///< in the frame at the centre of mass [m]
  bool magnet = false;
};

struct BodyState {
  BodyId id{};
  Vec2 x = Vec2::Zero();  ///< centre of mass [m]
  double angle = 0.0;     ///< [rad]
  Vec2 v = Vec2::Zero();  ///< [m/s]
  double omega = 0.0;     ///< [rad/s]
  CollectionId collection = kNoCollection;
  bool asleep = false;
  bool pinned = false;  ///< does not move now (motion pinned, or before its `pinned_until`)
  bool magnet_on = false;

  Pose pose() const { return Pose::at(x, angle); }
};

enum class ContactState { Broken, Sticking, Sliding };

struct ContactView {
  BodyId a{}, b{};
  std::uint32_t feature = 0;
  Vec2 x = Vec2::Zero();        ///< world point [m]
  Vec2 normal = Vec2::UnitX();  ///< from a to b
  double gap = 0.0;             ///< [m]
  double lambda_n = 0.0;        ///< impulse of this step along the normal [N s]
  double lambda_t = 0.0;        ///< along the tangent, the normal turned by +90° [N s]
  double w_n = 0.0;             ///< relative velocity of b against a along the normal [m/s]
  double w_t = 0.0;             ///< the same along the tangent [m/s]
  double mu = 0.0;
  ContactState state = ContactState::Broken;
  bool internal = false;  ///< inside a collection
  bool fresh = false;     ///< new in this step
};

struct CollectionView {
  CollectionId id{};
  std::vector<BodyId> bodies;  ///< ascending
  bool anchored = false;       ///< welded to a pinned or scripted body
  BodyId anchor{};             ///< that body, when anchored
  double mass = 0.0;           ///< of the members [kg]
  double inertia = 0.0;        ///< about the centre of mass [kg m²]
  Vec2 x = Vec2::Zero();
  Vec2 v = Vec2::Zero();
  double omega = 0.0;
  OrientedBox box;  ///< in the world
  bool asleep = false;
};

struct JointView {
  JointKind kind = JointKind::Revolute;
  BodyId a{}, b{};
  bool to_world = false;                        ///< there is no `b`
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< the ends on a and b, in the world [m]
  Vec2 axis = Vec2::UnitX();                    ///< of a prismatic joint, in the world
  Vec2 force = Vec2::Zero();                    ///< on b, in this step [N]
  double torque = 0.0;                          ///< on b, about `to` [N m]
  bool broken = false;
  bool internal = false;  ///< inside a collection
};

/// A weld: a pair of bodies inside one collection (or a member and its anchor).
struct WeldView {
  BodyId a{}, b{};
  int contacts = 0;
};

struct Snapshot {
  std::int64_t step = 0;          ///< 0: before the first step
  double time = 0.0;              ///< [s]
  std::vector<BodyState> bodies;  ///< those alive, ascending ids
  std::vector<ContactView> contacts;
  std::vector<CollectionView> collections;  ///< ascending ids
  std::vector<WeldView> welds;
  std::vector<SpringView> springs;
  std::vector<JointView> joints;    ///< of the scene, in its order; also broken ones
  std::vector<Event> events;        ///< of this step, in the order they happened
  std::vector<Decision> decisions;  ///< of this step, when they were asked for
  std::vector<Group> groups;        ///< those that the decisions tell of
  Stats stats;
};

const char* name(EventType type);
const char* name(EventReason reason);
const char* name(ContactState state);
const char* name(Mode mode);
const char* name(Motion motion);

}  // namespace merge2d
