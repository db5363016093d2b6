#ifndef MERGE2D_MERGE2D_H
#define MERGE2D_MERGE2D_H
/** @file
 * merge2d: 2D rigid bodies that touch and move as one are simulated as one.
 *
 * This is the whole public interface. In C it is what stands below; C++20 gets the classes of
 * merge2d/merge2d.hpp on top of it, by the same `#include <merge2d/merge2d.h>`.
 *
 * Units: metres, kilograms, seconds, radians; x to the right, y up, counter-clockwise positive.
 * Places and velocities of bodies are those of their centres of mass, unless something else is
 * said.
 *
 * Ownership: what `m2_…_new`, `_load`, `_parse` or `_copy` gives is freed by `m2_…_free`; a `char*`
 * result by `m2_free`. Arrays that a function fills belong to the caller. A `const` pointer into a
 * world belongs to the world. Nothing that is passed in is kept.
 *
 * Errors: a function that can fail returns an `m2_status`, and then changes nothing but what is
 * said there. `m2_error()` has the message. No exception leaves the library. A null pointer in
 * place of a scene or a world is such an error; the few functions without a status give NaN, -1, 0
 * or null for it.
 *
 * Threads: different worlds may be used by different threads at the same time. One world, or one
 * scene, may be used by one thread at a time, whether functions take it as const or not. A scene
 * may be freed or changed while worlds made from it live on: they have copies.
 *
 * Determinism: the same scene, settings and calls give the same bits, on any machine.
 */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** The version of this header. Before 1.0, a new minor version may break the interface. */
#define M2_VERSION_MAJOR 0
/** The same. */
#define M2_VERSION_MINOR 2
/** The same. */
#define M2_VERSION_PATCH 0

/** Marks the functions of the library. */
#if defined(MERGE2D_BUILDING) && defined(__GNUC__)
#define M2_API __attribute__((visibility("default")))
#else
#define M2_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Versions and errors
 */

/** The version of the library that runs: "0.2.0". */
M2_API const char* m2_version(void);

/** How a call ended. */
typedef enum m2_status {
  M2_OK = 0,               /**< success */
  M2_INPUT_ERROR = 1,      /**< a scene, a value or a saved state that cannot be used */
  M2_IO_ERROR = 2,         /**< reading, writing or drawing failed */
  M2_SIMULATION_ERROR = 3, /**< a number stopped being finite; the world cannot go on */
  M2_MEMORY_ERROR = 4,     /**< there is not enough memory */
  M2_INTERNAL_ERROR = 5    /**< a mistake of this library */
} m2_status;

/** The message of the last failed call of this thread, with the place in the file where there is
 * one; "" before any. Valid until this thread's next failed call. */
M2_API const char* m2_error(void);

/** Frees a text that this library gave. Null is fine. */
M2_API void m2_free(char* text);

/* ------------------------------------------------------------------------------------------------
 * Scenes
 */

/** A place [m], a velocity [m/s], a force [N], … */
typedef struct m2_vec {
  double x; /**< to the right */
  double y; /**< up */
} m2_vec;

/** A body's number: 0, 1, … in the order in which bodies are added; never used again. */
typedef uint32_t m2_body;
/** No body: the world, or nothing. */
#define M2_NO_BODY UINT32_MAX
/** Numbers of springs and joints, likewise. */
typedef uint32_t m2_spring;
/** The same. */
typedef uint32_t m2_joint;
/** Of a collection; never used again in a run. -1 stands for none. */
typedef int32_t m2_collection_id;
/** A free body has no collection. */
#define M2_NO_COLLECTION (-1)

/** Kinds of shapes. */
typedef enum m2_shape_kind { M2_CIRCLE = 0, M2_BOX = 1, M2_POLYGON = 2 } m2_shape_kind;

/** A piece of a body, in the body's frame. */
typedef struct m2_shape {
  m2_shape_kind kind; /**< which of the following count */
  m2_vec center;      /**< of a circle or box [m] */
  double angle;       /**< of a box [rad] */
  double radius;      /**< of a circle [m] */
  m2_vec size;        /**< width and height of a box [m] */
  /** Of a polygon, convex or not, in either direction, without a repeated last one [m]. */
  const m2_vec* vertices;
  size_t vertex_count; /**< of a polygon, 3 to 1000 */
} m2_shape;

/** Shapes about the origin of the body's frame. */
M2_API m2_shape m2_circle(double radius);
/** Likewise. */
M2_API m2_shape m2_box(double width, double height);
/** `vertices` is not copied: it must last until the body is added. */
M2_API m2_shape m2_polygon(const m2_vec* vertices, size_t count);

/** How a body moves. */
typedef enum m2_motion {
  M2_DYNAMIC = 0, /**< moves by forces */
  M2_PINNED = 1,  /**< stays where it is */
  M2_SCRIPTED = 2 /**< moves as its script says, whatever pushes it */
} m2_motion;

/** How a scripted body moves. */
typedef enum m2_script_kind {
  M2_SINUSOID = 0,  /**< offset = axis * amplitude * (1 - cos(2 pi t / period)) */
  M2_KEYFRAMES = 1, /**< smoothly through absolute poses */
  M2_STEADY = 2     /**< constant velocity and spin */
} m2_script_kind;

/** A place on a way. */
typedef struct m2_key {
  double time;     /**< [s], increasing */
  m2_vec position; /**< of the body's frame [m] */
  double angle;    /**< [rad] */
} m2_key;

/** The way of a scripted body. */
typedef struct m2_script {
  m2_script_kind kind; /**< which of the following count */
  m2_vec axis;         /**< of a sinusoid */
  double amplitude;    /**< of a sinusoid [m] */
  double period;       /**< of a sinusoid [s] */
  const m2_key* keys;  /**< of key frames */
  size_t key_count;    /**< of key frames, 1 or more */
  m2_vec velocity;     /**< of a steady motion [m/s] */
  double spin;         /**< of a steady motion [rad/s] */
} m2_script;

/** The definition of a body. Start from `m2_body_def_default()`. */
typedef struct m2_body_def {
  const char* name; /**< null: none */
  m2_motion motion; /**< how it moves */
  m2_vec position;  /**< of the body's frame, whose origin need not be the centre of mass [m] */
  double angle;     /**< [rad] */
  m2_vec velocity;  /**< of the centre of mass [m/s] */
  double spin;      /**< [rad/s] */
  const m2_shape* shapes;  /**< its pieces; they move as one */
  size_t shape_count;      /**< 1 or more */
  double mass;             /**< [kg]; 0: area times density */
  double density;          /**< [kg/m^2] */
  double friction;         /**< two bodies touch with the geometric mean */
  double restitution;      /**< 0 to 1; two bodies touch with the larger one */
  double rolling;          /**< lever arm of the rolling resistance [m] */
  double surface_velocity; /**< of a belt round the body, on top to the right [m/s] */
  double pinned_until;     /**< pinned before this time, then dynamic [s] */
  m2_script script;        /**< of a scripted body */
} m2_body_def;

/** Dynamic at the origin, density 1, friction 0.6, all else 0; without a shape and a script. */
M2_API m2_body_def m2_body_def_default(void);

/** From a point of a body to a point of the world or of another body. */
typedef struct m2_spring_def {
  m2_body body;       /**< where it begins */
  m2_vec anchor;      /**< in the frame of `body` [m] */
  m2_vec to;          /**< in the world, or in the frame of `to_body` [m] */
  m2_body to_body;    /**< M2_NO_BODY: the world */
  double stiffness;   /**< [N/m] */
  double damping;     /**< [N s/m] */
  double rest_length; /**< [m] */
} m2_spring_def;
/** A spring to the world, without stiffness. */
M2_API m2_spring_def m2_spring_def_default(void);

/** Kinds of joints, by their free motion. */
typedef enum m2_joint_kind {
  M2_REVOLUTE = 0, /**< the bodies share a point and turn about it */
  M2_WELD = 1,     /**< they do not move against each other */
  M2_DISTANCE = 2, /**< two points keep their distance */
  M2_PRISMATIC = 3 /**< `b` slides along an axis of `a` (or `a` along one of the world) */
} m2_joint_kind;

/** Holds two bodies together, or one to the world, as they stand when it is made. */
typedef struct m2_joint_def {
  m2_joint_kind kind;    /**< its free motion */
  m2_body a;             /**< the first body */
  m2_body b;             /**< M2_NO_BODY: the world */
  m2_vec at;             /**< world point [m]; of a distance joint its end on `a` */
  m2_vec to;             /**< of a distance joint, its end on `b` [m] */
  m2_vec axis;           /**< of a prismatic joint */
  double length;         /**< of a distance joint [m]; 0: as at the start */
  double stiffness;      /**< of a distance joint that is a spring [N/m]; 0: it is rigid */
  double damping;        /**< of that spring [N s/m] */
  bool limited;          /**< turn [rad], way [m] or length [m] stays within `lower` and `upper` */
  double lower;          /**< of the limits */
  double upper;          /**< of the limits, not below `lower` */
  bool motor;            /**< drives with `motor_speed`, as strongly as `motor_strength` */
  double motor_speed;    /**< [rad/s] or [m/s] */
  double motor_strength; /**< [N m] or [N] */
  double compliance;     /**< [m/N] or [rad/(N m)] */
  double break_force;    /**< a larger force breaks it [N]; infinity: never */
  double break_torque;   /**< [N m] */
  bool collide;          /**< whether its bodies touch each other */
} m2_joint_def;
/** A revolute joint to the world at the origin, which never breaks. */
M2_API m2_joint_def m2_joint_def_default(void);

/** Bodies, springs, joints and settings: the beginning of a world. */
typedef struct m2_scene m2_scene;

/** An empty scene: gravity (0, -9.81) m/s^2, time step 0.01 s. Null when memory lacks. */
M2_API m2_scene* m2_scene_new(void);
/** A built-in name, a `.toml` or a `.png` file. `changes` are `change_count` texts "key=value" that
 * replace values of the file, as `--set` does: "merging.velocity=0.02"; null when there are none.
 */
M2_API m2_status m2_scene_load(const char* name_or_path, const char* const* changes,
                               size_t change_count, m2_scene** scene);
/** A text scene of `length` bytes; `source` stands for a file's name in messages. */
M2_API m2_status m2_scene_parse(const char* toml, size_t length, const char* source,
                                const char* const* changes, size_t change_count, m2_scene** scene);
/** A scene of its own; null when memory lacks. */
M2_API m2_scene* m2_scene_copy(const m2_scene* scene);
/** Frees a scene. Null is fine. */
M2_API void m2_scene_free(m2_scene* scene);

/** Sets a number or word by its name in scene files: "step", "duration", "seed", "gravity"
 * ("[0, -9.81]"), "title", or a setting, "merging.velocity" (docs/scene-format.md lists all). */
M2_API m2_status m2_scene_set(m2_scene* scene, const char* key, const char* value);
/** The value as `m2_scene_set` takes it. */
M2_API m2_status m2_scene_get(const m2_scene* scene, const char* key, char** value);

/** Adds a body; its number goes to `body` unless that is null. */
M2_API m2_status m2_scene_add_body(m2_scene* scene, const m2_body_def* def, m2_body* body);
/** Likewise a spring between bodies that are there. */
M2_API m2_status m2_scene_add_spring(m2_scene* scene, const m2_spring_def* def, m2_spring* spring);
/** Likewise a joint. */
M2_API m2_status m2_scene_add_joint(m2_scene* scene, const m2_joint_def* def, m2_joint* joint);
/** An impulse [N s] at a world point [m], in the step that covers `time` [s]. */
M2_API m2_status m2_scene_add_impulse(m2_scene* scene, m2_body body, m2_vec at, m2_vec impulse,
                                      double time);
/** A force [N] at a point of the body's frame [m], from `from` until `until` [s]. */
M2_API m2_status m2_scene_add_force(m2_scene* scene, m2_body body, m2_vec at, m2_vec force,
                                    double from, double until);
/** Makes a body a magnet from `from` until `until` [s]: its contacts, with all that comes within
 * solver.margin of it, pull too and do not slide, and draw a face flat that they touch. */
M2_API m2_status m2_scene_add_magnet(m2_scene* scene, m2_body body, double from, double until);

/** Adds copies of a body while the world runs: `count` of them, one every `every` seconds from
 * `start` on [s], each off `def->position` by at most `spread` in each direction [m], as `seed`
 * says. They are numbered behind all other bodies and named "name[k]". */
M2_API m2_status m2_scene_add_emitter(m2_scene* scene, const m2_body_def* def, double every,
                                      double start, uint32_t count, m2_vec spread, uint64_t seed);
/** The view of pictures: `height` metres about `center` [m]. Else all bodies over the whole run. */
M2_API m2_status m2_scene_set_camera(m2_scene* scene, m2_vec center, double height);
/** The view moves with a body; without a camera it begins with all bodies in it. M2_NO_BODY stops
 * that. */
M2_API m2_status m2_scene_follow(m2_scene* scene, m2_body body);

/** How many bodies have been added. */
M2_API size_t m2_scene_body_count(const m2_scene* scene);
/** The body of that name; an unknown one is an error that suggests another. */
M2_API m2_status m2_scene_find_body(const m2_scene* scene, const char* name, m2_body* body);
/** The scene as a file that loads to the same scene again. */
M2_API m2_status m2_scene_to_toml(const m2_scene* scene, char** toml);
/** Warnings of loading, and of settings that do not go together, one a line; "" when there are
 * none. */
M2_API m2_status m2_scene_warnings(const m2_scene* scene, char** text);
/** Built-in scenes, one a line: name, a tab, title. */
M2_API m2_status m2_scene_list(char** text);

/* ------------------------------------------------------------------------------------------------
 * Worlds: time
 */

/** Which of the two savings are on. */
typedef enum m2_mode {
  M2_REFERENCE = 0,  /**< every body on its own */
  M2_SLEEP = 1,      /**< bodies at rest sleep */
  M2_MERGE = 2,      /**< bodies that move as one are simulated as one */
  M2_MERGE_SLEEP = 3 /**< both: the usual one */
} m2_mode;

/** "reference", "sleep", "merge" or "merge+sleep"; and back. */
M2_API const char* m2_mode_name(m2_mode mode);
/** The mode of that name. */
M2_API m2_status m2_mode_from_name(const char* name, m2_mode* mode);

/** A scene that moves on by time steps. */
typedef struct m2_world m2_world;

/** A world that begins as the scene says. The scene is copied. */
M2_API m2_status m2_world_new(const m2_scene* scene, m2_mode mode, m2_world** world);
/** Frees a world. Null is fine. */
M2_API void m2_world_free(m2_world* world);

/** Takes `count` time steps (Algorithm 1 of the paper). On an error those before it are done. */
M2_API m2_status m2_world_step(m2_world* world, uint64_t count);
M2_API int64_t m2_world_steps(const m2_world* world);    /**< taken so far */
M2_API double m2_world_time(const m2_world* world);      /**< [s] */
M2_API double m2_world_time_step(const m2_world* world); /**< h [s] */
/** The length of the steps to come, 1e-6 to 1 s. Wakes all bodies; collections stay, and forces at
 * rest last: impulses of the last step, which start the next solve, are scaled with it. */
M2_API m2_status m2_world_set_time_step(m2_world* world, double h);

/** The mode in force. */
M2_API m2_mode m2_world_mode(const m2_world* world);
/** Where the new mode does not merge, all collections are taken apart. */
M2_API m2_status m2_world_set_mode(m2_world* world, m2_mode mode);
M2_API m2_vec m2_world_gravity(const m2_world* world); /**< [m/s^2] */
/** Wakes all bodies. */
M2_API m2_status m2_world_set_gravity(m2_world* world, m2_vec gravity);
/** Settings between two steps: "merging.velocity", "0.02". Others keep their values. */
M2_API m2_status m2_world_set(m2_world* world, const char* key, const char* value);
/** A setting in force, as m2_world_set() takes it. */
M2_API m2_status m2_world_get(const m2_world* world, const char* key, char** value);

/** Everything that influences the steps to come, as bytes that belong to the world: valid until
 * the next save. A world of the same scene continues from them bit for bit. */
M2_API m2_status m2_world_save(m2_world* world, const void** bytes, size_t* size);
/** Takes saved bytes over. Settings, gravity, time step and mode stay those of this world; unless
 * `other_settings`, they must be those that the bytes were saved under. Only the version of the
 * library that saved them reads them. */
M2_API m2_status m2_world_restore(m2_world* world, const void* bytes, size_t size,
                                  bool other_settings);

/* ------------------------------------------------------------------------------------------------
 * Worlds: bodies
 */

/** Bodies of the run, also those that are not emitted yet or have been removed. */
M2_API size_t m2_world_body_count(const m2_world* world);

/** The constant properties of a body. */
typedef struct m2_body_info {
  const char* name; /**< valid until a body is added, or the world freed */
  m2_motion motion; /**< as it was described; it may have been pinned or let go since */
  double mass;      /**< [kg] */
  double inertia;   /**< about the centre of mass [kg m^2] */
  bool present;     /**< in the world now */
} m2_body_info;
/** Of any body of the run. */
M2_API m2_status m2_world_body_info(m2_world* world, m2_body body, m2_body_info* info);
/** The body of that name; an unknown one is an error that suggests another. */
M2_API m2_status m2_world_find_body(m2_world* world, const char* name, m2_body* body);

/** A convex piece of a body about its centre of mass: a disc (`vertex_count` 0) or a polygon,
 * counter-clockwise. A body that was described by one polygon may have several pieces. */
typedef struct m2_piece {
  m2_vec center;       /**< centroid [m] */
  double radius;       /**< of a disc [m] */
  size_t vertex_count; /**< 0, or 3 to 8 */
  m2_vec vertices[8];  /**< [m] */
} m2_piece;
/** Writes at most `capacity` pieces and tells in `count` how many there are. */
M2_API m2_status m2_world_body_pieces(m2_world* world, m2_body body, m2_piece* pieces,
                                      size_t capacity, size_t* count);

/** Adds a dynamic or pinned body. Its name, if it has one, is new in this run. */
M2_API m2_status m2_world_add_body(m2_world* world, const m2_body_def* def, m2_body* body);
/** Removes a body with its joints and springs. */
M2_API m2_status m2_world_remove_body(m2_world* world, m2_body body);
/** Adds a spring; its number goes to `spring` unless that is null. */
M2_API m2_status m2_world_add_spring(m2_world* world, const m2_spring_def* def, m2_spring* spring);
/** Moves the end of a spring that holds to the world. */
M2_API m2_status m2_world_move_spring(m2_world* world, m2_spring spring, m2_vec to);
/** Removes a spring. */
M2_API m2_status m2_world_remove_spring(m2_world* world, m2_spring spring);
/** Joins bodies as they stand now; the number goes to `joint` unless that is null. */
M2_API m2_status m2_world_add_joint(m2_world* world, const m2_joint_def* def, m2_joint* joint);
/** Removes a joint. */
M2_API m2_status m2_world_remove_joint(m2_world* world, m2_joint joint);

/** A spring that drags a body by its point that is at `grip` now [m], critically damped: move its
 * end with `m2_world_move_spring`, let go with `m2_world_remove_spring`. */
M2_API m2_status m2_world_drag(m2_world* world, m2_body body, m2_vec grip, m2_spring* spring);

/** An impulse [N s] at a world point [m], at the start of the next step. */
M2_API m2_status m2_world_apply_impulse(m2_world* world, m2_body body, m2_vec at, m2_vec impulse);
/** A force [N] at a world point [m], during the next step. */
M2_API m2_status m2_world_apply_force(m2_world* world, m2_body body, m2_vec at, m2_vec force);
/** Places the centre of mass [m, rad]. The body leaves its collection; a scripted one cannot be
 * placed. */
M2_API m2_status m2_world_set_pose(m2_world* world, m2_body body, m2_vec center, double angle);
/** Of the centre of mass [m/s, rad/s]. The body leaves its collection; it must be dynamic. */
M2_API m2_status m2_world_set_velocity(m2_world* world, m2_body body, m2_vec v, double omega);
/** The coefficient of its surface, 0 or more; wakes what it touches. */
M2_API m2_status m2_world_set_friction(m2_world* world, m2_body body, double friction);
/** Holds a body where it is. */
M2_API m2_status m2_world_pin(m2_world* world, m2_body body);
/** Lets a pinned body go, at rest. */
M2_API m2_status m2_world_unpin(m2_world* world, m2_body body);
/** Takes a body out of its collection; it may merge again. */
M2_API m2_status m2_world_release(m2_world* world, m2_body body);
/** Neither it nor what touches it sleeps through the next step. */
M2_API m2_status m2_world_wake(m2_world* world, m2_body body);

/* ------------------------------------------------------------------------------------------------
 * Worlds: arrays. Row i is body i; a body that is not in the world has NaN, or -1.
 */

/** x, y [m], angle [rad] into `3 * m2_world_body_count` numbers; `count` must be that many. */
M2_API m2_status m2_world_poses(const m2_world* world, double* out, size_t count);
/** vx, vy [m/s], omega [rad/s], likewise. */
M2_API m2_status m2_world_velocities(const m2_world* world, double* out, size_t count);
/** Ids of collections, or -1, into `m2_world_body_count` numbers. */
M2_API m2_status m2_world_collections_of(const m2_world* world, int32_t* out, size_t count);

/** The same arrays as the world keeps them up to date, from the first call on: after each step and
 * each change. They stay where they are, and hold room for all bodies that may come, while the
 * world lives. Null when memory lacks. */
M2_API const double* m2_world_watch_poses(m2_world* world);
/** Likewise the velocities. */
M2_API const double* m2_world_watch_velocities(m2_world* world);
/** Likewise the ids of collections. */
M2_API const int32_t* m2_world_watch_collections(m2_world* world);

/* ------------------------------------------------------------------------------------------------
 * Worlds: the results of the last step. The arrays belong to the world and are valid until it is
 * stepped, changed or freed.
 */

/** The state of a contact in this step: nothing, hold, or slide. */
typedef enum m2_contact_state { M2_BROKEN = 0, M2_STICKING = 1, M2_SLIDING = 2 } m2_contact_state;

/** A contact point: 0 <= w_n, lambda_n >= 0, one of them 0, and |lambda_t| <= mu lambda_n (Eqs. (4)
 * to (7) of the paper; an impulse is h times the force that it calls lambda). */
typedef struct m2_contact {
  m2_body a;        /**< the body with the lower number */
  m2_body b;        /**< the other one */
  uint32_t feature; /**< tells the points of a pair apart */
  uint8_t state;    /**< m2_contact_state */
  uint8_t internal; /**< inside a collection */
  uint8_t fresh;    /**< new in this step */
  uint8_t reserved; /**< 0 */
  double x;         /**< in the world [m] */
  double y;         /**< in the world [m] */
  double nx;        /**< unit normal from a to b */
  double ny;        /**< unit normal from a to b */
  double gap;       /**< below 0 they overlap [m] */
  double lambda_n;  /**< impulse of the step along the normal [N s] */
  double lambda_t;  /**< along the tangent, the normal turned by +90 degrees [N s] */
  double w_n;       /**< velocity of b against a along the normal [m/s] */
  double w_t;       /**< along the tangent [m/s] */
} m2_contact;
/** By a, b and feature. */
M2_API m2_status m2_world_contacts(m2_world* world, const m2_contact** contacts, size_t* count);

/** Bodies that are simulated as one: mass, velocity and inertia by Eqs. (10) to (14) of the paper.
 */
typedef struct m2_collection {
  m2_collection_id id; /**< never used again in a run */
  uint32_t first;      /**< of its members, in the array of members */
  uint32_t count;      /**< of its members */
  m2_body anchor;      /**< the pinned or scripted body it is welded to, or M2_NO_BODY */
  uint32_t asleep;     /**< 0 or 1 */
  double mass;         /**< of the members [kg] */
  double inertia;      /**< about the centre of mass [kg m^2] */
  double x;            /**< centre of mass [m] */
  double y;            /**< centre of mass [m] */
  double vx;           /**< its velocity [m/s] */
  double vy;           /**< its velocity [m/s] */
  double omega;        /**< [rad/s] */
} m2_collection;
/** By id. `members` (may be null) gets the bodies of all of them, ascending in each. */
M2_API m2_status m2_world_collections(m2_world* world, const m2_collection** collections,
                                      size_t* count, const m2_body** members);

/** A joint as it is now. */
typedef struct m2_joint_state {
  int32_t kind;      /**< m2_joint_kind */
  m2_body a;         /**< the first body */
  m2_body b;         /**< the other, or M2_NO_BODY: the world */
  uint8_t broken;    /**< it has borne too much, or was removed */
  uint8_t internal;  /**< inside a collection */
  uint16_t reserved; /**< 0 */
  double ax;         /**< its end on `a`, in the world [m] */
  double ay;         /**< its end on `a`, in the world [m] */
  double bx;         /**< its end on `b`, in the world [m] */
  double by;         /**< its end on `b`, in the world [m] */
  double fx;         /**< force on `b` in the last step [N] */
  double fy;         /**< force on `b` in the last step [N] */
  double torque;     /**< on `b`, about its end [N m] */
} m2_joint_state;
/** All joints, by their numbers. */
M2_API m2_status m2_world_joints(m2_world* world, const m2_joint_state** joints, size_t* count);

/** A spring in the last step. */
typedef struct m2_spring_state {
  uint32_t number;   /**< as m2_world_add_spring() gives it; those of the scene come first */
  m2_body a;         /**< its body */
  m2_body b;         /**< the other, or M2_NO_BODY: the world */
  uint32_t reserved; /**< 0 */
  double ax;         /**< its end on `a`, in the world [m] */
  double ay;         /**< its end on `a`, in the world [m] */
  double bx;         /**< the other end, in the world [m] */
  double by;         /**< the other end, in the world [m] */
  double force;      /**< along itself, with its damping; above 0 it pulls [N] */
} m2_spring_state;
/** The springs that acted in the last step, by their numbers; none before the first step. */
M2_API m2_status m2_world_springs(m2_world* world, const m2_spring_state** springs, size_t* count);

/** Kinds of events. */
typedef enum m2_event_type {
  M2_EVENT_MERGE = 0,   /**< of two things one was made (Section 5 of the paper) */
  M2_EVENT_UNMERGE = 1, /**< the end of a weld; `reason` says why (Section 6) */
  M2_EVENT_SLEEP = 2,   /**< at rest in the world (Section 7) */
  M2_EVENT_WAKE = 3,    /**< the end of that */
  M2_EVENT_IMPACT = 4,  /**< a pair met faster than gravity could have made it */
  M2_EVENT_EMIT = 5,    /**< a body came in */
  M2_EVENT_BREAK = 6    /**< a joint bore too much */
} m2_event_type;
/** Why a weld ended. */
typedef enum m2_reason {
  M2_REASON_NONE = 0,
  M2_REASON_BROKEN = 1,          /**< no contact of it presses (Section 6.3) */
  M2_REASON_SLIDING = 2,         /**< a contact slides, Eqs. (19) and (20) */
  M2_REASON_RELATIVE_MOTION = 3, /**< the bodies move against each other, Eqs. (15) to (17) */
  M2_REASON_USER = 4             /**< a change from outside */
} m2_reason;
/** An event of a step. */
typedef struct m2_event {
  int32_t type;                /**< m2_event_type */
  int32_t reason;              /**< m2_reason */
  m2_body a;                   /**< of the pair the lower number */
  m2_body b;                   /**< the other, or `a` where one body is meant */
  m2_collection_id collection; /**< that it is about, or M2_NO_COLLECTION */
} m2_event;
/** Of the last step, in the order in which they happened. */
M2_API m2_status m2_world_events(m2_world* world, const m2_event** events, size_t* count);
M2_API const char* m2_event_type_name(m2_event_type type); /**< "merge", … */
M2_API const char* m2_reason_name(m2_reason reason);       /**< "relative-motion", … */

/** One test of one criterion about a pair, or about a collection by its first body: Eqs. (15) to
 * (20) of the paper, and those of our own. docs/records.md lists them all, and which of them count
 * something else than steps. */
typedef struct m2_decision {
  m2_body a;          /**< of the pair the lower number */
  m2_body b;          /**< the other, or `a` where one thing is meant */
  double value;       /**< in the unit of the criterion */
  double threshold;   /**< in the same unit */
  int32_t count;      /**< consecutive steps, this one included; negative: still to wait */
  int32_t needed;     /**< how many it takes, or 0 */
  int32_t before;     /**< the count up to the last step */
  int32_t reserved;   /**< 0 */
  char stage[32];     /**< of Algorithm 1 */
  char criterion[24]; /**< "relative-motion", "sliding", … */
  char equation[48];  /**< of the paper, as "(17)", or the page of our own criterion */
  char verdict[16];   /**< "merge", "wait", "apart", "keep", "unmerge", … */
} m2_decision;
/** Whether the steps to come note their decisions: off at first, as it takes time. */
M2_API m2_status m2_world_note_decisions(m2_world* world, bool on);
/** Of the last step. An error when it did not note them. */
M2_API m2_status m2_world_decisions(m2_world* world, const m2_decision** decisions, size_t* count);
/** Why two bodies are one or not, after the last step, in words; and what would change it. An error
 * when the step did not note its decisions. */
M2_API m2_status m2_world_why(m2_world* world, m2_body a, m2_body b, char** text);

/** How much the last step had to do. */
typedef struct m2_counts {
  int32_t bodies;            /**< dynamic bodies in the world */
  int32_t active_bodies;     /**< simulated on their own: free bodies and collections, awake */
  int32_t collections;       /**< in the world */
  int32_t asleep;            /**< bodies */
  int32_t contacts;          /**< points in the full solve */
  int32_t internal_contacts; /**< points inside collections */
} m2_counts;
/** Of the last step; costs nothing. */
M2_API m2_status m2_world_counts(const m2_world* world, m2_counts* counts);

/** Sums over all bodies that respond to forces, computed
 * when they are asked for. */
typedef struct m2_sums {
  double residual;         /**< of the full solve */
  double max_penetration;  /**< [m] */
  double kinetic_energy;   /**< [J] */
  double potential_energy; /**< of gravity about y = 0 and of springs [J] */
  double momentum_x;       /**< [N s] */
  double momentum_y;       /**< [N s] */
  double angular_momentum; /**< about the origin [N m s] */
} m2_sums;
/** Of the world as it is now. */
M2_API m2_status m2_world_sums(m2_world* world, m2_sums* sums);

/* ------------------------------------------------------------------------------------------------
 * Worlds: queries. They see bodies where they are now. Bodies are written in ascending order, at
 * most `capacity` of them; `count` gets how many there are.
 */

/** The bodies of which `point` is a part. */
M2_API m2_status m2_world_query_point(m2_world* world, m2_vec point, m2_body* bodies,
                                      size_t capacity, size_t* count);
/** The bodies that touch or overlap an upright box. */
M2_API m2_status m2_world_query_box(m2_world* world, m2_vec lower, m2_vec upper, m2_body* bodies,
                                    size_t capacity, size_t* count);
/** The bodies that touch or overlap a shape whose frame is at `position`, turned by `angle`. */
M2_API m2_status m2_world_query_shape(m2_world* world, const m2_shape* shape, m2_vec position,
                                      double angle, m2_body* bodies, size_t capacity,
                                      size_t* count);

/** Where a ray meets a body first. */
typedef struct m2_ray_hit {
  m2_body body;                /**< M2_NO_BODY: nothing was hit */
  m2_collection_id collection; /**< of that body */
  double fraction;             /**< of the way: 0 at `from`, 1 at `to` */
  m2_vec point;                /**< [m] */
  m2_vec normal;               /**< of the surface, outwards; 0 where the ray begins inside */
} m2_ray_hit;
/** The first body on the way; of several in one place, the one with the lowest number. */
M2_API m2_status m2_world_cast_ray(m2_world* world, m2_vec from, m2_vec to, m2_ray_hit* hit);
/** The collection of a body, or M2_NO_COLLECTION. */
M2_API m2_status m2_world_collection_of(const m2_world* world, m2_body body, m2_collection_id* id);

/* ------------------------------------------------------------------------------------------------
 * Pictures and pages
 */

/** How a picture is to look. Start from `m2_picture_def_default()`. */
typedef struct m2_picture_def {
  int32_t width;        /**< [px] */
  int32_t height;       /**< [px] */
  const char* overlays; /**< "contacts,forces", "none"; docs/scenarios.md; null: the usual ones */
  const char* theme;    /**< "light", "dark" or "print"; null: light */
  bool transparent;     /**< no background */
  bool has_camera;      /**< whether the next two count; else all bodies fit at the start */
  m2_vec camera_center; /**< [m] */
  double camera_height; /**< [m] */
} m2_picture_def;
/** 960 by 540 pixels, as the program draws them. */
M2_API m2_picture_def m2_picture_def_default(void);

/** Draws the world into `4 * width * height` bytes: RGBA, rows from the top. Collections keep their
 * colours from picture to picture. */
M2_API m2_status m2_world_draw(m2_world* world, const m2_picture_def* def, uint8_t* rgba,
                               size_t size);
/** The same as a PNG file. It appears complete or not at all, and replaces one that is there. */
M2_API m2_status m2_world_write_png(m2_world* world, const m2_picture_def* def, const char* path);

/** A page for a browser, without a network: of a built-in lesson, of a lesson's folder, or of a
 * scene by its name or file. With `live` it carries the engine, so that one can take over the run.
 */
M2_API m2_status m2_lesson_page(const char* name, bool live, char** html);
/** The same for a scene, run for its duration in this mode and as reference. */
M2_API m2_status m2_scene_page(const m2_scene* scene, m2_mode mode, bool live, char** html);

#ifdef __cplusplus
}  // extern "C"
#if __cplusplus <= 201703L && defined(__GNUC__)
/** Older C++ has none of the classes, and is told so where it uses them. */
namespace merge2d {
class __attribute__((deprecated("the classes of merge2d need C++20"))) Scene;
class __attribute__((deprecated("the classes of merge2d need C++20"))) World;
}  // namespace merge2d
#elif __cplusplus > 201703L && !defined(MERGE2D_BUILDING)
#include "merge2d/merge2d.hpp"
#endif
#endif

#endif
