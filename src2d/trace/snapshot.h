#pragma once
/// What can be seen of a world after a step (or a stage of one), as plain data: the one source of
/// the trace, the pictures, the summaries and the lessons. A snapshot owns its numbers, so that it
/// can be drawn while the world goes on.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "src2d/core/ids.h"
#include "src2d/geometry/box.h"
#include "src2d/geometry/shape.h"
#include "src2d/scene/scene.h"

namespace merge2d {

/// What never changes about a body. All bodies of a run, also those not emitted yet, have their
/// entry from the start: `World::bodies()[index(id)]`.
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

struct SpringView {
  std::uint32_t number = 0;  ///< as the world counts them
  BodyId body{}, other{};
  bool to_world = true;      ///< there is no `other`
  Vec2 from = Vec2::Zero();  ///< world point on the body
  Vec2 to = Vec2::Zero();    ///< world point of the other end
  double force = 0.0;        ///< pulling positive [N]
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

enum class EventType { Merge, Unmerge, Sleep, Wake, Impact, Emit, Break };
enum class EventReason : std::uint8_t { None, Broken, Sliding, RelativeMotion, User };
inline constexpr std::array kEventReasons = {EventReason::None, EventReason::Broken,
                                             EventReason::Sliding, EventReason::RelativeMotion,
                                             EventReason::User};

/// What happened. A `Merge` is a join: of two things one was made, so that n bodies need n − 1 of
/// them, however many contacts hold them together afterwards. An `Unmerge` is the end of one weld,
/// with its reason: a body that leaves two neighbours gives two of them. An `Impact` is a pair that
/// meets faster than gravity could have made it in two steps. A `Break` is the end of a joint that
/// bore too much.
struct Event {
  EventType type = EventType::Merge;
  BodyId a{}, b{};  ///< the pair; equal where one body is meant
  CollectionId collection = kNoCollection;
  EventReason reason = EventReason::None;
};

/// The source of a criterion that is not the paper's: a page, and its section.
inline constexpr std::string_view kOwnMerging = "docs/decisions/cures.md#when-to-merge",
                                  kOwnSleeping = "docs/decisions/cures.md#when-to-sleep",
                                  kOwnDecided = "docs/decisions/decided.md#decision";

/// One test of one criterion about a pair: the number, the threshold, and what followed. The words
/// for it are in docs/records.md.
struct Decision {
  BodyId a{}, b{};           ///< the pair; in SleepAndWake both are the first body of what sleeps
  std::string_view stage{};  ///< as in Algorithm 1: "Merge", "Unmerge", …
  std::string_view criterion{};  ///< "relative-motion", "sliding", "breathing", …
  std::string_view equation{};   ///< "(17)", "Section 5.1", or kOwnMerging and its like
  double value = 0.0;
  double threshold = 0.0;
  int count = 0;  ///< consecutive steps, this one included; 0: starts anew
  int needed = 0;
  std::string_view verdict{};  ///< "merge", "wait", "apart", "keep", "unmerge", …
  int before = 0;              ///< the count up to the last step
  Vec2 at = Vec2::Zero();      ///< of tests of one contact: where it is, in the world [m]
  /// Of "cycle": the first body of the group that holds the pair; −1: none.
  std::int32_t group = -1;
  std::int32_t members = -1;  ///< all its bodies: an index of Snapshot::groups
};

/// The bodies of a rigid group: first those whose contacts make it one, ascending, then those that
/// are welded to them already, ascending.
using Group = std::vector<BodyId>;

/// The eleven stages of Algorithm 1, in order.
enum class Stage {
  ContactDetection,
  ContactOrdering,
  SleepAndWake,
  WarmStart,
  SingleIterationPGS,
  Unmerge,
  SolveLCP,
  AdvanceVelocities,
  AccumulateRelativeMotion,
  AdvancePositions,
  Merge,
};
inline constexpr std::size_t kStages = 11;

struct Stats {
  int bodies = 0;         ///< alive, dynamic
  int active_bodies = 0;  ///< |B|: free bodies and collections that are simulated, awake
  int collections = 0;
  int asleep = 0;                         ///< bodies asleep
  int contacts = 0;                       ///< contact points in the full solve
  int internal_contacts = 0;              ///< contact points swept once inside collections
  double residual = 0.0;                  ///< of the full solve after its last sweep: |Δλ| / |λ|
  double max_penetration = 0.0;           ///< [m]
  double kinetic_energy = 0.0;            ///< [J]
  double potential_energy = 0.0;          ///< of gravity about y = 0 and of springs [J]
  Vec2 momentum = Vec2::Zero();           ///< [N s]
  double angular_momentum = 0.0;          ///< about the world's origin [N m s]
  std::array<double, kStages> seconds{};  ///< wall time per stage
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

const char* name(Stage stage);
const char* name(EventType type);
const char* name(EventReason reason);
const char* name(ContactState state);
const char* name(Mode mode);
const char* name(Motion motion);

}  // namespace merge2d
