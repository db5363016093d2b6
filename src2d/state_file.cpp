#include "src2d/state_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "src2d/contact/broadphase.h"
#include "src2d/core/error.h"
#include "src2d/scene/check.h"
#include "src2d/scene/load.h"
#include "src2d/state_archive.h"
#include "src2d/state_check.h"

namespace merge2d {
namespace {

constexpr std::uint32_t kVersion = 9;

/// FNV-1a, 64 bits: finds damage, not malice.
std::uint64_t hashOf(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

/// All of a scene that the simulation sees, but for its settings.
std::uint64_t sceneHash(Scene scene) {
  scene.title.clear();
  scene.duration = 0.0;
  scene.camera.reset();
  scene.follow.reset();
  scene.margin = Scene{}.margin;
  scene.gravity = Scene{}.gravity;
  scene.step = Scene{}.step;
  scene.settings = {};
  return hashOf(toToml(scene));
}

/// The settings in force, which may have changed since the start.
std::uint64_t settingsHash(const State& state) {
  Scene scene;
  scene.gravity = state.gravity;
  scene.step = state.h;
  scene.settings = state.settings;
  return hashOf(toToml(scene));
}

/// Changes with the fields of a state.
std::uint64_t layoutHash() {
  static const std::uint64_t hash = [] {
    StateSignature signature;
    signature(std::vector<BodyDesc>{}, State{}, Actions{}, std::vector<Aabb>{});
    return hashOf(signature.text);
  }();
  return hash;
}

struct Header {
  std::uint32_t version = kVersion;
  std::uint64_t layout = layoutHash();
  std::uint64_t scene = 0, settings = 0;
  Mode mode = Mode::Reference;
};

template <class Ar>
void fields(Ar& ar, Some<Header> auto& header) {
  auto& [version, layout, scene, settings, mode] = header;
  ar(version, layout, scene, settings, mode);
}

/// The boxes that the broadphase keeps around everything, per rigid thing that is present.
std::vector<Aabb> fatBoxes(const State& state) {
  std::vector<Aabb> boxes;
  for (const Rigid& r : state.rigids) {
    if (r.present()) boxes.push_back(state.broadphase.tree.fatBox(r.leaf));
  }
  return boxes;
}

/// The header, after checking that the bytes fit.
Header readHeader(StateReader& read, const Scene& scene, const State& state, SavedUnder under) {
  Header header;
  read(header);
  if (header.version != kVersion || header.layout != layoutHash()) {
    read.fail("the snapshot was written by another version of merge2d; run the scene again");
  }
  const bool any = under == SavedUnder::AnySettings;
  if (header.scene != sceneHash(scene) || (!any && header.settings != settingsHash(state))) {
    read.fail(fmt::format("the snapshot is of another scene than '{}', or of other parameters",
                          scene.name));
  }
  if (!any && header.mode != state.mode) {
    read.fail(fmt::format("the snapshot was made with --mode {}, not {}", name(header.mode),
                          name(state.mode)));
  }
  return header;
}

/// The scene as at its start, with these bodies added to it and the settings that are in force.
void startOver(const Scene& scene, const std::vector<BodyDesc>& added, Setup& setup) {
  const Mode mode = setup.state.mode;
  const Settings settings = setup.state.settings;
  const Vec2 gravity = setup.state.gravity;
  const double h = setup.state.h;
  std::destroy_at(&setup);  // its tree cannot be assigned
  std::construct_at(&setup);
  setUp(scene, mode, setup);
  setup.state.settings = settings;
  setup.state.gravity = gravity;
  setup.state.h = h;
  for (const BodyDesc& desc : added) {
    checkBody(desc);
    appendBody(setup, desc);
  }
}

std::string_view checkedPayload(std::string_view bytes, const std::string& source) {
  const auto fail = [&](const char* sentence) {
    throw InputError(fmt::format("{}: {}", source, sentence));
  };
  std::uint64_t checksum = 0;
  if (!bytes.starts_with(kStateStart)) fail("this is no snapshot of merge2d");
  if (bytes.size() < kStateStart.size() + sizeof checksum) fail("the snapshot is incomplete");
  const std::string_view payload = bytes.substr(0, bytes.size() - sizeof checksum);
  std::memcpy(&checksum, bytes.data() + payload.size(), sizeof checksum);
  if (hashOf(payload) != checksum)
    fail("the snapshot is incomplete or damaged: its checksum differs");
  return payload.substr(kStateStart.size());
}

/// Everything leaves the broadphase, of a fresh setup or of one that has gone on.
void clearBroadphase(State& state) {
  for (std::uint32_t i = 0; i < state.rigids.size(); ++i) {
    if (state.rigids[i].present()) removeRigid(state, RigidId{i});
    dropShapeTree(state, RigidId{i});
  }
}

/// Trees with the boxes that they had: those of shapes follow from where these are.
void buildTrees(State& state, const std::vector<Aabb>& boxes) {
  auto& broadphase = state.broadphase;
  state.used_slots = 0;
  broadphase.shape_trees.resize(state.rigids.size());
  std::size_t box = 0;
  for (std::uint32_t i = 0; i < state.rigids.size(); ++i) {
    Rigid& r = state.rigids[i];
    if (r.present()) r.leaf = broadphase.tree.insertFat(boxes.at(box++), i);
  }
  for (std::uint32_t i = 0; i < state.bodies.size(); ++i) {
    const Body& body = state.bodies[i];
    const bool compound = body.alive && body.shape_count > 1;
    if (compound) addShapes(state, RigidId{i}, {BodyId{i}});
  }
  for (const Collection& c : state.collections) {
    if (c.id != kNoCollection) addShapes(state, c.rigid, c.members);
  }
}

/// All behind the header.
void readSetup(StateReader& read, const std::string& source, const Scene& scene, Setup& setup) {
  std::vector<BodyDesc> added;
  read(added);
  if (!added.empty() || !setup.added.empty()) startOver(scene, added, setup);
  const std::vector<Body> bodies = setup.state.bodies;
  const std::size_t extents = setup.state.extents.size() - setup.state.collections.size();
  const std::size_t launches = setup.actions.launches.size();
  clearBroadphase(setup.state);
  std::vector<Aabb> boxes;
  read(setup.state, setup.actions, boxes);
  if (read.rest() > 0) read.fail("the snapshot is damaged: it goes on after its end");
  setup.state.collections.relist();
  checkRestored({setup, bodies, extents, launches, boxes}, source);
  buildTrees(setup.state, boxes);
  listJoints(setup.state);
}

}  // namespace

std::string saveState(const Scene& scene, const Setup& setup) {
  StateWriter write;
  write.bytes = kStateStart;
  Header header;
  header.scene = sceneHash(scene);
  header.settings = settingsHash(setup.state);
  header.mode = setup.state.mode;
  write(header, setup.added, setup.state, setup.actions, fatBoxes(setup.state));
  const std::uint64_t checksum = hashOf(write.bytes);
  write(checksum);
  return std::move(write.bytes);
}

Mode restoreState(std::string_view bytes, const std::string& source, const Scene& scene,
                  Setup& setup, SavedUnder under) {
  StateReader read(checkedPayload(bytes, source), source);
  const Header header = readHeader(read, scene, setup.state, under);
  const double h = setup.state.h;
  try {
    readSetup(read, source, scene, setup);
  } catch (...) {  // half of it would be no state at all
    setup.state.h = h;
    startOver(scene, {}, setup);
    throw;
  }
  return header.mode;
}

}  // namespace merge2d
