#pragma once
/// Changes of a world from outside, between two steps. Each takes the bodies concerned out of their
/// collections where these could not stay as they are, and wakes them and what touches them; the
/// next step does the rest. All of them are part of a saved state.

#include "src2d/setup.h"

namespace merge2d {

/// A body comes in, behind all others. Throws InputError for a scripted one.
BodyId addBody(Setup& setup, const BodyDesc& desc);
/// A body leaves for good, with its contacts, springs and joints. Its id is not used again.
void removeBody(Setup& setup, Scratch& scratch, BodyId body);

/// Places a body's centre of mass. A pinned body that was moved is a frame of its own from then on,
/// so that it meets what is merged with the world.
void setPose(Setup& setup, Scratch& scratch, BodyId body, const Vec2& x, double angle);
/// Of the centre of mass; no effect on a body that does not respond to forces.
void setVelocity(Setup& setup, Scratch& scratch, BodyId body, const Vec2& v, double omega);
/// Holds a body where it is.
void pin(Setup& setup, Scratch& scratch, BodyId body);
/// Lets a pinned body go, at rest.
void unpin(Setup& setup, Scratch& scratch, BodyId body);
/// Takes a body out of its collection; it may merge again.
void release(Setup& setup, Scratch& scratch, BodyId body);
/// Of its surface: contacts have the geometric mean of both.
void setFriction(Setup& setup, BodyId body, double friction);
/// Neither it nor what touches it sleeps through the next step.
void wake(Setup& setup, BodyId body);
void wakeAll(Setup& setup);

/// Replaces the settings. Another rule of unmerging finds no proofs, and all rows in their places.
void setSettings(State& state, const Settings& settings);

/// Takes all collections apart where the mode does not merge, wakes all where it does not sleep.
void setMode(Setup& setup, Scratch& scratch, Mode mode);

/// Joins two bodies, or one to the world, as they stand now. Returns its index.
std::uint32_t addJoint(Setup& setup, Scratch& scratch, const JointDesc& desc);
void removeJoint(Setup& setup, Scratch& scratch, std::uint32_t joint);

/// The centres of mass are in the frames of the bodies: anchors are kept from there.
std::uint32_t addSpring(Setup& setup, const SpringDesc& desc, const Vec2& center_of_body,
                        const Vec2& center_of_other);
void moveSpring(Setup& setup, std::uint32_t spring, const Vec2& to);
void removeSpring(Setup& setup, std::uint32_t spring);

}  // namespace merge2d
