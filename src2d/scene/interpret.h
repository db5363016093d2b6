#pragma once
/// The parts of reading a scene file, one function for each noun.

#include <string>
#include <unordered_map>

#include "src2d/scene/rules.h"
#include "src2d/scene/toml_reader.h"

namespace merge2d {

/// Finds bodies by name.
using BodyNames = std::unordered_map<std::string, BodyIndex>;

/// title, gravity, step, duration and seed.
void readWorld(TableReader& root, Scene& scene);

/// [camera], which may name a body.
void readCamera(TableReader& root, Scene& scene, const BodyNames& names);

/// [solver], [merging], [unmerging], [sleeping], [material] and [drawing].
void readSettings(TableReader& root, Settings& settings);

/// [[body]], with `repeat` written out.
BodyNames readBodies(TableReader& root, Scene& scene);

/// A body's keys, also of an emitter's template. Material and name come from `defaults`.
BodyDesc readBody(TableReader& table, const BodyDesc& defaults);
/// Checks of a whole table: a scripted body needs a script. Call after `done`.
void checkBody(const TableReader& table, const BodyDesc& body);
/// Throws the complaint, if there is one, at its key.
void obey(const TableReader& table, const Verdict& verdict);

/// box, circle, polygon or shapes.
std::vector<ConvexShape> readShapes(TableReader& table);

/// script = { … }
std::optional<Script> readScript(TableReader& table);

/// [[emitter]]; comes before what refers to bodies, as emitted ones cannot be meant there.
void readEmitters(TableReader& root, Scene& scene);

/// [[spring]], [[impulse]], [[force]] and [[magnet]]; [[joint]].
void readActions(TableReader& root, Scene& scene, const BodyNames& names);
void readJoints(TableReader& root, Scene& scene, const BodyNames& names);

/// A body without settings of its own.
BodyDesc defaultBody(const Material& material);

/// The body that the value names, or an error with a suggestion.
BodyIndex bodyNamed(const Value& value, const Scene& scene, const BodyNames& names);

/// A name that can be written in messages and files: not empty, no control characters.
void checkName(const Value& value, const std::string& name);

}  // namespace merge2d
