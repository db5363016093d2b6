#ifndef MERGE2D_MERGE2D_HPP
#define MERGE2D_MERGE2D_HPP
/** @file
 * The C++ interface: classes over the functions of merge2d.h, which are documented there. Include
 * <merge2d/merge2d.h>.
 *
 * A Scene or a World owns its object and can be moved. A moved-from one may only be
 * assigned or destroyed: all else is an InputError. Spans into a world are valid until it is
 * stepped, changed or destroyed, but for the watched ones, which live as long as the world.
 * Failures are exceptions below; they are thrown in your code, so that the library and your program
 * may come from different compilers.
 */

#if __cplusplus <= 201703L
#error "merge2d/merge2d.hpp needs C++20: older C++ has the functions for C of merge2d/merge2d.h"
#endif

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace merge2d {
inline namespace v0 {

/** All errors of this library. */
class Error : public std::runtime_error {
  using std::runtime_error::runtime_error;
};
/** A scene, a value or a saved state that cannot be used; with its place, where there is one. */
class InputError : public Error {
  using Error::Error;
};
/** Reading, writing or drawing failed. */
class IoError : public Error {
  using Error::Error;
};
/** A number stopped being finite; the world cannot go on. */
class SimulationError : public Error {
  using Error::Error;
};

namespace detail {

inline void check(m2_status status) {
  switch (status) {
    case M2_OK:
      return;
    case M2_INPUT_ERROR:
      throw InputError(m2_error());
    case M2_IO_ERROR:
      throw IoError(m2_error());
    case M2_SIMULATION_ERROR:
      throw SimulationError(m2_error());
    case M2_MEMORY_ERROR:
      throw std::bad_alloc();
    case M2_INTERNAL_ERROR:
      break;
  }
  throw Error(m2_error());
}

inline constexpr double kForever = std::numeric_limits<double>::infinity();

/** Owns an object that `free` frees. */
template <class T, void (*free)(T*)>
class Owner {
 public:
  explicit Owner(T* object = nullptr) : object_(object) {}
  ~Owner() { free(object_); }
  Owner(Owner&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Owner& operator=(Owner&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  T* get() const { return object_; }

 private:
  T* object_;
};

/** Takes over a text that the library gave. */
inline std::string taken(char* text) {
  const Owner<char, m2_free> owner(text);
  return text;
}

inline std::string shortest(double number) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

inline std::vector<const char*> pointers(const std::vector<std::string>& texts) {
  std::vector<const char*> out;
  for (const std::string& text : texts) out.push_back(text.c_str());
  return out;
}

}  // namespace detail

/** The version of the library that runs. */
inline std::string version() { return m2_version(); }

/** See m2_vec. */
using Vec2 = m2_vec;
/** See m2_body. */
using Body = m2_body;
/** See m2_spring. */
using Spring = m2_spring;
/** See m2_joint. */
using Joint = m2_joint;
/** See m2_collection_id. */
using CollectionId = m2_collection_id;
/** See m2_contact. */
using Contact = m2_contact;
/** See m2_event. */
using Event = m2_event;
/** See m2_decision. */
using Decision = m2_decision;
/** See m2_counts. */
using Counts = m2_counts;
/** See m2_joint_state. */
using JointState = m2_joint_state;
/** See m2_spring_state. */
using SpringState = m2_spring_state;
/** See m2_sums. */
using Sums = m2_sums;
/** See m2_ray_hit. */
using RayHit = m2_ray_hit;
/** See m2_body_info. */
using BodyInfo = m2_body_info;
/** See m2_piece. */
using Piece = m2_piece;
using SpringDef = m2_spring_def;    ///< start from springDef()
using JointDef = m2_joint_def;      ///< start from jointDef()
using PictureDef = m2_picture_def;  ///< start from pictureDef()

/** See m2_spring_def_default(). */
inline SpringDef springDef() { return m2_spring_def_default(); }
/** See m2_joint_def_default(). */
inline JointDef jointDef() { return m2_joint_def_default(); }
/** See m2_picture_def_default(). */
inline PictureDef pictureDef() { return m2_picture_def_default(); }

/** See m2_mode. */
enum class Mode { Reference, Sleep, Merge, MergeSleep };
/** See m2_motion. */
enum class Motion { Dynamic, Pinned, Scripted };

/** A piece of a body, which owns its vertices. */
class Shape {
 public:
  /** See m2_circle(). */
  static Shape circle(double radius, Vec2 center = {0.0, 0.0}) {
    Shape shape(m2_circle(radius));
    shape.shape_.center = center;
    return shape;
  }
  /** See m2_box(). */
  static Shape box(double width, double height, Vec2 center = {0.0, 0.0}, double angle = 0.0) {
    Shape shape(m2_box(width, height));
    shape.shape_.center = center;
    shape.shape_.angle = angle;
    return shape;
  }
  /** Convex or not, in either direction. */
  static Shape polygon(std::vector<Vec2> vertices) {
    Shape shape(m2_polygon(nullptr, 0));
    shape.vertices_ = std::move(vertices);
    return shape;
  }

  /** For the functions of merge2d.h; valid while this lives. */
  m2_shape get() const {
    m2_shape shape = shape_;
    shape.vertices = vertices_.data();
    shape.vertex_count = vertices_.size();
    return shape;
  }

 private:
  explicit Shape(const m2_shape& shape) : shape_(shape) {}
  m2_shape shape_;
  std::vector<Vec2> vertices_;
};

/** The definition of a body; units as in m2_body_def. */
struct BodyDef {
  std::string name{};                               ///< see m2_body_def
  Motion motion = Motion::Dynamic;                  ///< see m2_body_def
  Vec2 position{0.0, 0.0};                          ///< see m2_body_def
  double angle = 0.0;                               ///< see m2_body_def
  Vec2 velocity{0.0, 0.0};                          ///< see m2_body_def
  double spin = 0.0;                                ///< see m2_body_def
  std::vector<Shape> shapes{};                      ///< see m2_body_def
  double mass = 0.0;                                ///< 0: area times density
  double density = 1.0;                             ///< see m2_body_def
  double friction = 0.6;                            ///< see m2_body_def
  double restitution = 0.0;                         ///< see m2_body_def
  double rolling = 0.0;                             ///< see m2_body_def
  double surface_velocity = 0.0;                    ///< see m2_body_def
  double pinned_until = 0.0;                        ///< see m2_body_def
  m2_script script = m2_body_def_default().script;  ///< see m2_body_def
};

namespace detail {

/** A definition as the functions of merge2d.h take it; valid while both live. */
struct PlainBodyDef {
  explicit PlainBodyDef(const BodyDef& def) : plain(m2_body_def_default()) {
    for (const Shape& shape : def.shapes) shapes.push_back(shape.get());
    plain.name = def.name.c_str();
    plain.motion = static_cast<m2_motion>(def.motion);
    plain.position = def.position;
    plain.angle = def.angle;
    plain.velocity = def.velocity;
    plain.spin = def.spin;
    plain.shapes = shapes.data();
    plain.shape_count = shapes.size();
    plain.mass = def.mass;
    plain.density = def.density;
    plain.friction = def.friction;
    plain.restitution = def.restitution;
    plain.rolling = def.rolling;
    plain.surface_velocity = def.surface_velocity;
    plain.pinned_until = def.pinned_until;
    plain.script = def.script;
  }
  m2_body_def plain;
  std::vector<m2_shape> shapes;
};

}  // namespace detail

/** Bodies, springs, joints and settings: the beginning of a world. */
class Scene {
 public:
  Scene() : scene_(m2_scene_new()) {
    if (get() == nullptr) throw std::bad_alloc();
  }
  /** See m2_scene_copy(). */
  Scene(const Scene& other) : scene_(m2_scene_copy(other.get())) {
    if (get() == nullptr) throw std::bad_alloc();
  }
  /** A moved-from scene may only be assigned or destroyed. */
  Scene(Scene&&) noexcept = default;
  /** See m2_scene_copy(). */
  Scene& operator=(const Scene& other) { return *this = Scene(other); }
  /** The object of this one is freed with the other. */
  Scene& operator=(Scene&&) noexcept = default;
  ~Scene() = default;

  /** A built-in name, a `.toml` or a `.png` file, with changes "key=value". */
  static Scene load(const std::string& name_or_path, const std::vector<std::string>& changes = {}) {
    m2_scene* scene = nullptr;
    const auto texts = detail::pointers(changes);
    detail::check(m2_scene_load(name_or_path.c_str(), texts.data(), texts.size(), &scene));
    return Scene(scene);
  }
  /** A text scene; `source` stands for a file's name in messages. */
  static Scene parse(std::string_view toml, const std::string& source = "scene",
                     const std::vector<std::string>& changes = {}) {
    m2_scene* scene = nullptr;
    const auto texts = detail::pointers(changes);
    detail::check(m2_scene_parse(toml.empty() ? "" : toml.data(), toml.size(), source.c_str(),
                                 texts.data(), texts.size(), &scene));
    return Scene(scene);
  }

  /** By names of scene files: set("merging.velocity", 0.02), set("step", 0.005). */
  void set(const std::string& key, const std::string& value) {
    detail::check(m2_scene_set(get(), key.c_str(), value.c_str()));
  }
  /** See m2_scene_set(). */
  void set(const std::string& key, double value) { set(key, detail::shortest(value)); }
  /** See m2_scene_get(). */
  std::string get(const std::string& key) const {
    char* text = nullptr;
    detail::check(m2_scene_get(get(), key.c_str(), &text));
    return detail::taken(text);
  }

  /** See m2_scene_add_body(). */
  Body add(const BodyDef& def) {
    const detail::PlainBodyDef plain(def);
    Body body = 0;
    detail::check(m2_scene_add_body(get(), &plain.plain, &body));
    return body;
  }
  /** See m2_scene_add_spring(). */
  Spring add(const SpringDef& def) {
    Spring spring = 0;
    detail::check(m2_scene_add_spring(get(), &def, &spring));
    return spring;
  }
  /** See m2_scene_add_joint(). */
  Joint add(const JointDef& def) {
    Joint joint = 0;
    detail::check(m2_scene_add_joint(get(), &def, &joint));
    return joint;
  }
  /** See m2_scene_add_impulse(). */
  void addImpulse(Body body, Vec2 at, Vec2 impulse, double time) {
    detail::check(m2_scene_add_impulse(get(), body, at, impulse, time));
  }
  /** See m2_scene_add_force(). */
  void addForce(Body body, Vec2 at, Vec2 force, double from = 0.0,
                double until = detail::kForever) {
    detail::check(m2_scene_add_force(get(), body, at, force, from, until));
  }
  /** See m2_scene_add_magnet(). */
  void addMagnet(Body body, double from = 0.0, double until = detail::kForever) {
    detail::check(m2_scene_add_magnet(get(), body, from, until));
  }

  /** See m2_scene_add_emitter(). */
  void addEmitter(const BodyDef& def, double every, std::uint32_t count, double start = 0.0,
                  Vec2 spread = {0.0, 0.0}, std::uint64_t seed = 1) {
    const detail::PlainBodyDef plain(def);
    detail::check(m2_scene_add_emitter(get(), &plain.plain, every, start, count, spread, seed));
  }
  /** See m2_scene_set_camera(). */
  void setCamera(Vec2 center, double height) {
    detail::check(m2_scene_set_camera(get(), center, height));
  }
  /** See m2_scene_follow(). */
  void follow(Body body) { detail::check(m2_scene_follow(get(), body)); }

  /** See m2_scene_body_count(). */
  std::size_t bodyCount() const {
    if (get() == nullptr) throw InputError("this scene was moved away");
    return m2_scene_body_count(get());
  }
  /** See m2_scene_find_body(). */
  Body find(const std::string& name) const {
    Body body = M2_NO_BODY;
    detail::check(m2_scene_find_body(get(), name.c_str(), &body));
    return body;
  }
  /** See m2_scene_to_toml(). */
  std::string toToml() const {
    char* text = nullptr;
    detail::check(m2_scene_to_toml(get(), &text));
    return detail::taken(text);
  }
  /** One a line. */
  std::string warnings() const {
    char* text = nullptr;
    detail::check(m2_scene_warnings(get(), &text));
    return detail::taken(text);
  }

  /** For the functions of merge2d.h. */
  m2_scene* get() const { return scene_.get(); }

 private:
  explicit Scene(m2_scene* scene) : scene_(scene) {}
  detail::Owner<m2_scene, m2_scene_free> scene_;
};

/** A collection, and its bodies in ascending order. */
struct Collection : m2_collection {
  /** Valid as long as the arrays of its world. */
  std::span<const Body> bodies;
};

/** A scene that moves on by time steps. */
class World {
 public:
  /** See m2_world_new(). */
  explicit World(const Scene& scene, Mode mode = Mode::MergeSleep) : world_(made(scene, mode)) {}

  /** See m2_world_step(). */
  void step(std::uint64_t count = 1) { detail::check(m2_world_step(get(), count)); }
  /** See m2_world_steps(). */
  std::int64_t steps() const { return m2_world_steps(here()); }
  double time() const { return m2_world_time(here()); }           ///< [s]
  double timeStep() const { return m2_world_time_step(here()); }  ///< h [s]
  /** See m2_world_set_time_step(). */
  void setTimeStep(double h) { detail::check(m2_world_set_time_step(get(), h)); }

  /** See m2_world_mode(). */
  Mode mode() const { return static_cast<Mode>(m2_world_mode(here())); }
  /** See m2_world_set_mode(). */
  void setMode(Mode mode) { detail::check(m2_world_set_mode(get(), static_cast<m2_mode>(mode))); }
  /** See m2_world_gravity(). */
  Vec2 gravity() const { return m2_world_gravity(here()); }
  /** See m2_world_set_gravity(). */
  void setGravity(Vec2 gravity) { detail::check(m2_world_set_gravity(get(), gravity)); }
  /** See m2_world_set(). */
  void set(const std::string& key, const std::string& value) {
    detail::check(m2_world_set(get(), key.c_str(), value.c_str()));
  }
  /** See m2_world_set(). */
  void set(const std::string& key, double value) { set(key, detail::shortest(value)); }
  /** See m2_world_get(). */
  std::string get(const std::string& key) const {
    char* text = nullptr;
    detail::check(m2_world_get(get(), key.c_str(), &text));
    return detail::taken(text);
  }

  /** A copy of everything that influences the steps to come. */
  std::string save() const {
    const void* bytes = nullptr;
    std::size_t size = 0;
    detail::check(m2_world_save(get(), &bytes, &size));
    return {static_cast<const char*>(bytes), size};
  }
  /** See m2_world_restore(). */
  void restore(std::string_view bytes, bool other_settings = false) {
    detail::check(m2_world_restore(get(), bytes.data(), bytes.size(), other_settings));
  }

  /** See m2_world_body_count(). */
  std::size_t bodyCount() const { return m2_world_body_count(here()); }
  /** See m2_world_body_info(). */
  BodyInfo info(Body body) const {
    BodyInfo info{};
    detail::check(m2_world_body_info(get(), body, &info));
    return info;
  }
  /** See m2_world_find_body(). */
  Body find(const std::string& name) const {
    Body body = M2_NO_BODY;
    detail::check(m2_world_find_body(get(), name.c_str(), &body));
    return body;
  }
  /** See m2_world_body_pieces(). */
  std::vector<Piece> pieces(Body body) const {
    std::size_t count = 0;
    detail::check(m2_world_body_pieces(get(), body, nullptr, 0, &count));
    std::vector<Piece> out(count);
    detail::check(m2_world_body_pieces(get(), body, out.data(), out.size(), &count));
    return out;
  }

  /** See m2_world_add_body(). */
  Body add(const BodyDef& def) {
    const detail::PlainBodyDef plain(def);
    Body body = 0;
    detail::check(m2_world_add_body(get(), &plain.plain, &body));
    return body;
  }
  /** See m2_world_add_spring(). */
  Spring add(const SpringDef& def) {
    Spring spring = 0;
    detail::check(m2_world_add_spring(get(), &def, &spring));
    return spring;
  }
  /** See m2_world_add_joint(). */
  Joint add(const JointDef& def) {
    Joint joint = 0;
    detail::check(m2_world_add_joint(get(), &def, &joint));
    return joint;
  }
  /** See m2_world_remove_body(). */
  void removeBody(Body body) { detail::check(m2_world_remove_body(get(), body)); }
  /** See m2_world_remove_spring(). */
  void removeSpring(Spring spring) { detail::check(m2_world_remove_spring(get(), spring)); }
  /** See m2_world_remove_joint(). */
  void removeJoint(Joint joint) { detail::check(m2_world_remove_joint(get(), joint)); }
  /** See m2_world_move_spring(). */
  void moveSpring(Spring spring, Vec2 to) {
    detail::check(m2_world_move_spring(get(), spring, to));
  }
  /** A spring that drags a body by its point at `grip`. */
  Spring drag(Body body, Vec2 grip) {
    Spring spring = 0;
    detail::check(m2_world_drag(get(), body, grip, &spring));
    return spring;
  }

  /** See m2_world_apply_impulse(). */
  void applyImpulse(Body body, Vec2 at, Vec2 impulse) {
    detail::check(m2_world_apply_impulse(get(), body, at, impulse));
  }
  /** See m2_world_apply_force(). */
  void applyForce(Body body, Vec2 at, Vec2 force) {
    detail::check(m2_world_apply_force(get(), body, at, force));
  }
  /** See m2_world_set_pose(). */
  void setPose(Body body, Vec2 center, double angle) {
    detail::check(m2_world_set_pose(get(), body, center, angle));
  }
  /** See m2_world_set_velocity(). */
  void setVelocity(Body body, Vec2 v, double omega) {
    detail::check(m2_world_set_velocity(get(), body, v, omega));
  }
  /** See m2_world_set_friction(). */
  void setFriction(Body body, double friction) {
    detail::check(m2_world_set_friction(get(), body, friction));
  }
  /** See m2_world_pin(). */
  void pin(Body body) { detail::check(m2_world_pin(get(), body)); }
  /** See m2_world_unpin(). */
  void unpin(Body body) { detail::check(m2_world_unpin(get(), body)); }
  /** See m2_world_release(). */
  void release(Body body) { detail::check(m2_world_release(get(), body)); }
  /** See m2_world_wake(). */
  void wake(Body body) { detail::check(m2_world_wake(get(), body)); }

  /** Rows of three: x, y [m], angle [rad]. Kept up to date from the first call on. */
  std::span<const double> poses() { return rows(m2_world_watch_poses(here()), 3); }
  /** Rows of three: vx, vy [m/s], omega [rad/s]. */
  std::span<const double> velocities() { return rows(m2_world_watch_velocities(here()), 3); }
  /** Ids of collections, or -1. */
  std::span<const std::int32_t> collectionIds() {
    return rows(m2_world_watch_collections(here()), 1);
  }

  /** See m2_world_contacts(). */
  std::span<const Contact> contacts() { return list<Contact>(m2_world_contacts); }
  /** See m2_world_joints(). */
  std::span<const JointState> joints() { return list<JointState>(m2_world_joints); }
  /** See m2_world_springs(). */
  std::span<const SpringState> springs() { return list<SpringState>(m2_world_springs); }
  /** See m2_world_events(). */
  std::span<const Event> events() { return list<Event>(m2_world_events); }
  /** For these and why(), the steps have to note them. */
  void noteDecisions(bool on = true) { detail::check(m2_world_note_decisions(get(), on)); }
  /** See m2_world_decisions(). */
  std::span<const Decision> decisions() { return list<Decision>(m2_world_decisions); }
  /** See m2_world_why(). */
  std::string why(Body a, Body b) {
    char* text = nullptr;
    detail::check(m2_world_why(get(), a, b, &text));
    return detail::taken(text);
  }
  /** See m2_world_collections(). */
  std::vector<Collection> collections() {
    const m2_collection* first = nullptr;
    const Body* members = nullptr;
    std::size_t count = 0;
    detail::check(m2_world_collections(get(), &first, &count, &members));
    std::vector<Collection> out;
    for (const m2_collection& c : std::span(first, count)) {
      out.push_back({c, std::span(members + c.first, c.count)});
    }
    return out;
  }
  /** See m2_world_counts(). */
  Counts counts() const {
    Counts counts{};
    detail::check(m2_world_counts(get(), &counts));
    return counts;
  }
  /** See m2_world_sums(). */
  Sums sums() {
    Sums sums{};
    detail::check(m2_world_sums(get(), &sums));
    return sums;
  }

  /** See m2_world_query_point(). */
  std::vector<Body> at(Vec2 point) {
    return found([&](Body* bodies, std::size_t capacity, std::size_t* count) {
      return m2_world_query_point(get(), point, bodies, capacity, count);
    });
  }
  /** See m2_world_query_box(). */
  std::vector<Body> inBox(Vec2 lower, Vec2 upper) {
    return found([&](Body* bodies, std::size_t capacity, std::size_t* count) {
      return m2_world_query_box(get(), lower, upper, bodies, capacity, count);
    });
  }
  /** See m2_world_query_shape(). */
  std::vector<Body> touching(const Shape& shape, Vec2 position, double angle = 0.0) {
    const m2_shape plain = shape.get();
    return found([&](Body* bodies, std::size_t capacity, std::size_t* count) {
      return m2_world_query_shape(get(), &plain, position, angle, bodies, capacity, count);
    });
  }
  /** Nothing where the way is free. */
  std::optional<RayHit> castRay(Vec2 from, Vec2 to) {
    RayHit hit{};
    detail::check(m2_world_cast_ray(get(), from, to, &hit));
    if (hit.body == M2_NO_BODY) return std::nullopt;
    return hit;
  }
  /** See m2_world_collection_of(). */
  CollectionId collectionOf(Body body) const {
    CollectionId id = M2_NO_COLLECTION;
    detail::check(m2_world_collection_of(get(), body, &id));
    return id;
  }

  /** RGBA, rows from the top. */
  std::vector<std::uint8_t> draw(const PictureDef& def = pictureDef()) {
    // Of sizes that the library refuses, nothing.
    const auto pixels = [](int n) { return n < 0 || n > 16384 ? 0 : static_cast<std::size_t>(n); };
    std::vector<std::uint8_t> rgba(4 * pixels(def.width) * pixels(def.height));
    detail::check(m2_world_draw(get(), &def, rgba.data(), rgba.size()));
    return rgba;
  }
  /** See m2_world_write_png(). */
  void writePng(const std::string& path, const PictureDef& def = pictureDef()) {
    detail::check(m2_world_write_png(get(), &def, path.c_str()));
  }

  /** For the functions of merge2d.h. */
  m2_world* get() const { return world_.get(); }

 private:
  /** For functions that have no status. */
  m2_world* here() const {
    if (get() == nullptr) throw InputError("this world was moved away");
    return get();
  }
  static m2_world* made(const Scene& scene, Mode mode) {
    m2_world* world = nullptr;
    detail::check(m2_world_new(scene.get(), static_cast<m2_mode>(mode), &world));
    return world;
  }
  template <class T>
  std::span<const T> rows(const T* first, std::size_t columns) const {
    if (first == nullptr) throw std::bad_alloc();
    return {first, columns * bodyCount()};
  }
  template <class T>
  std::span<const T> list(m2_status (*function)(m2_world*, const T**, std::size_t*)) {
    const T* first = nullptr;
    std::size_t count = 0;
    detail::check(function(get(), &first, &count));
    return {first, count};
  }
  template <class Query>
  static std::vector<Body> found(Query&& query) {
    std::vector<Body> bodies(16);
    std::size_t count = 0;
    detail::check(query(bodies.data(), bodies.size(), &count));
    const bool all = count <= bodies.size();
    bodies.resize(count);
    if (!all) detail::check(query(bodies.data(), bodies.size(), &count));
    return bodies;
  }

  detail::Owner<m2_world, m2_world_free> world_;
};

/** A page for a browser of a lesson, or of a scene by its name. */
inline std::string lessonPage(const std::string& name, bool live = true) {
  char* html = nullptr;
  detail::check(m2_lesson_page(name.c_str(), live, &html));
  return detail::taken(html);
}
/** Of a scene, run for its duration. */
inline std::string scenePage(const Scene& scene, Mode mode = Mode::MergeSleep, bool live = true) {
  char* html = nullptr;
  detail::check(m2_scene_page(scene.get(), static_cast<m2_mode>(mode), live, &html));
  return detail::taken(html);
}

}  // namespace v0
}  // namespace merge2d

#endif
