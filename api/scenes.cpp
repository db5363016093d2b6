#include <algorithm>
#include <cmath>

#include "api/handles.h"
#include "api/settings.h"
#include "src2d/scene/check.h"
#include "src2d/scene/load.h"
#include "src2d/scene/rules.h"

using merge2d::given;
using merge2d::guarded;

namespace merge2d {
namespace {

Overrides overridesOf(const char* const* changes, std::size_t count) {
  Overrides overrides;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string text = &given((&given(changes, "changes"))[i], "a change");
    const std::size_t at = text.find('=');
    if (at == std::string::npos) {
      throw InputError(fmt::format("'{}' should read key=value", text));
    }
    overrides.emplace_back(text.substr(0, at), text.substr(at + 1));
  }
  return overrides;
}

/// The number of the last entry.
void tellLast(std::size_t count, std::uint32_t* number) {
  if (number != nullptr) *number = static_cast<std::uint32_t>(count - 1);
}

void requireBody(const Scene& scene, std::size_t body) {
  if (body < scene.bodies.size()) return;
  throw InputError(fmt::format("there is no body {}: the scene has {}", body, scene.bodies.size()));
}

}  // namespace
}  // namespace merge2d

m2_scene* m2_scene_new() { return new (std::nothrow) m2_scene; }

m2_status m2_scene_load(const char* name_or_path, const char* const* changes, size_t change_count,
                        m2_scene** scene) {
  return guarded([&] {
    m2_scene*& out = given(scene, "scene");
    const std::string name = &given(name_or_path, "name_or_path");
    out = new m2_scene{merge2d::loadScene(name, merge2d::overridesOf(changes, change_count))};
  });
}

m2_status m2_scene_parse(const char* toml, size_t length, const char* source,
                         const char* const* changes, size_t change_count, m2_scene** scene) {
  return guarded([&] {
    m2_scene*& out = given(scene, "scene");
    const std::string_view text(&given(toml, "toml"), length);
    out = new m2_scene{merge2d::parseScene(text, source == nullptr ? "scene" : source,
                                           merge2d::overridesOf(changes, change_count))};
  });
}

m2_scene* m2_scene_copy(const m2_scene* scene) {
  m2_scene* copy = nullptr;
  guarded([&] { copy = new m2_scene(given(scene, "scene")); });
  return copy;
}

void m2_scene_free(m2_scene* scene) { delete scene; }

m2_status m2_scene_set(m2_scene* scene, const char* key, const char* value) {
  return guarded([&] {
    merge2d::setByName(given(scene, "scene").scene, &given(key, "key"), &given(value, "value"));
  });
}

m2_status m2_scene_get(const m2_scene* scene, const char* key, char** value) {
  return guarded([&] {
    given(value, "value") =
        merge2d::copyOf(merge2d::getByName(given(scene, "scene").scene, &given(key, "key")));
  });
}

m2_status m2_scene_add_body(m2_scene* scene, const m2_body_def* def, m2_body* body) {
  return guarded([&] {
    auto& bodies = given(scene, "scene").scene.bodies;
    bodies.push_back(merge2d::toDesc(given(def, "def")));
    merge2d::tellLast(bodies.size(), body);
  });
}

m2_status m2_scene_add_spring(m2_scene* scene, const m2_spring_def* def, m2_spring* spring) {
  return guarded([&] {
    merge2d::Scene& s = given(scene, "scene").scene;
    const merge2d::SpringDesc desc = merge2d::toDesc(given(def, "def"));
    merge2d::requireBody(s, desc.body);
    if (desc.to_body) merge2d::requireBody(s, *desc.to_body);
    merge2d::checkSpring(desc);
    s.springs.push_back(desc);
    merge2d::tellLast(s.springs.size(), spring);
  });
}

m2_status m2_scene_add_joint(m2_scene* scene, const m2_joint_def* def, m2_joint* joint) {
  return guarded([&] {
    merge2d::Scene& s = given(scene, "scene").scene;
    const merge2d::JointDesc desc = merge2d::toDesc(given(def, "def"));
    merge2d::requireBody(s, desc.a);
    if (desc.b) merge2d::requireBody(s, *desc.b);
    merge2d::checkJoint(desc);
    s.joints.push_back(desc);
    merge2d::tellLast(s.joints.size(), joint);
  });
}

m2_status m2_scene_add_impulse(m2_scene* scene, m2_body body, m2_vec at, m2_vec impulse,
                               double time) {
  return guarded([&] {
    merge2d::Scene& s = given(scene, "scene").scene;
    merge2d::requireBody(s, body);
    s.impulses.push_back({body, merge2d::toVec(at), merge2d::toVec(impulse), time});
  });
}

m2_status m2_scene_add_force(m2_scene* scene, m2_body body, m2_vec at, m2_vec force, double from,
                             double until) {
  return guarded([&] {
    merge2d::Scene& s = given(scene, "scene").scene;
    merge2d::requireBody(s, body);
    s.forces.push_back({body, merge2d::toVec(at), merge2d::toVec(force), from, until});
  });
}

m2_status m2_scene_add_magnet(m2_scene* scene, m2_body body, double from, double until) {
  return guarded([&] {
    merge2d::Scene& s = given(scene, "scene").scene;
    merge2d::requireBody(s, body);
    for (merge2d::MagnetDesc& magnet : s.magnets) {
      if (magnet.body == body) return magnet.on.push_back({from, until});
    }
    s.magnets.push_back({body, {{from, until}}});
  });
}

m2_status m2_scene_add_emitter(m2_scene* scene, const m2_body_def* def, double every, double start,
                               uint32_t count, m2_vec spread, uint64_t seed) {
  return guarded([&] {
    merge2d::Scene& s = given(scene, "scene").scene;
    merge2d::EmitterDesc emitter;
    emitter.body = merge2d::toDesc(given(def, "def"));
    emitter.every = every;
    emitter.start = start;
    emitter.count = static_cast<int>(std::min<uint32_t>(count, INT32_MAX));
    emitter.spread = merge2d::toVec(spread);
    emitter.seed = seed;
    s.emitters.push_back(std::move(emitter));
  });
}

m2_status m2_scene_set_camera(m2_scene* scene, m2_vec center, double height) {
  return guarded([&] {
    if (!std::isfinite(center.x) || !std::isfinite(center.y) || !std::isfinite(height) ||
        height <= 0.0) {
      throw merge2d::InputError("a camera has a finite centre and a positive height");
    }
    given(scene, "scene").scene.camera = {merge2d::toVec(center), height};
  });
}

m2_status m2_scene_follow(m2_scene* scene, m2_body body) {
  return guarded([&] {
    merge2d::Scene& s = given(scene, "scene").scene;
    if (body == M2_NO_BODY) return s.follow.reset();
    merge2d::requireBody(s, body);
    s.follow = body;
  });
}

size_t m2_scene_body_count(const m2_scene* scene) {
  return scene == nullptr ? 0 : scene->scene.bodies.size();
}

m2_status m2_scene_find_body(const m2_scene* scene, const char* name, m2_body* body) {
  return guarded([&] {
    const auto& bodies = given(scene, "scene").scene.bodies;
    given(body, "body") = merge2d::bodyCalled(bodies, &given(name, "name"));
  });
}

m2_status m2_scene_to_toml(const m2_scene* scene, char** toml) {
  return guarded(
      [&] { given(toml, "toml") = merge2d::copyOf(merge2d::toToml(given(scene, "scene").scene)); });
}

m2_status m2_scene_warnings(const m2_scene* scene, char** text) {
  return guarded([&] {
    const merge2d::Scene& s = given(scene, "scene").scene;
    std::string lines;
    for (const std::string& warning : s.warnings) lines.append(warning).append("\n");
    if (const auto doubt = merge2d::doubtOfMixedRules(s.settings)) lines += *doubt + "\n";
    given(text, "text") = merge2d::copyOf(lines);
  });
}

m2_status m2_scene_list(char** text) {
  return guarded([&] {
    std::string lines;
    for (const auto& [name, title] : merge2d::builtinScenes())
      lines += fmt::format("{}\t{}\n", name, title);
    given(text, "text") = merge2d::copyOf(lines);
  });
}
