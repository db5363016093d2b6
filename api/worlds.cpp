#include <limits>

#include "api/handles.h"
#include "api/settings.h"
#include "src2d/scene/check.h"

using merge2d::change;
using merge2d::given;
using merge2d::guarded;
using merge2d::toVec;

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();  // of no world

}  // namespace

m2_status m2_world_new(const m2_scene* scene, m2_mode mode, m2_world** world) {
  return guarded([&] {
    m2_world*& out = given(world, "world");
    auto copy = std::make_shared<const merge2d::Scene>(given(scene, "scene").scene);
    out = new m2_world(std::move(copy), merge2d::toMode(mode));
  });
}

void m2_world_free(m2_world* world) { delete world; }

m2_status m2_world_step(m2_world* world, uint64_t count) {
  return change(world, [&](m2_world& w) {
    for (; count > 0; --count) w.world.step();
    w.noted = w.noting;
  });
}

int64_t m2_world_steps(const m2_world* world) {
  return world == nullptr ? -1 : world->world.steps();
}
double m2_world_time(const m2_world* world) {
  return world == nullptr ? kNothing : world->world.time();
}
double m2_world_time_step(const m2_world* world) {
  return world == nullptr ? kNothing : world->world.timeStep();
}

m2_status m2_world_set_time_step(m2_world* world, double h) {
  return change(world, [&](m2_world& w) { w.world.setTimeStep(h); });
}

m2_mode m2_world_mode(const m2_world* world) {
  return world == nullptr ? M2_REFERENCE : static_cast<m2_mode>(world->world.mode());
}

m2_status m2_world_set_mode(m2_world* world, m2_mode mode) {
  return change(world, [&](m2_world& w) { w.world.setMode(merge2d::toMode(mode)); });
}

m2_vec m2_world_gravity(const m2_world* world) {
  if (world == nullptr) return {kNothing, kNothing};
  return merge2d::fromVec(world->world.gravity());
}

m2_status m2_world_set_gravity(m2_world* world, m2_vec gravity) {
  return change(world, [&](m2_world& w) { w.world.setGravity(toVec(gravity)); });
}

m2_status m2_world_set(m2_world* world, const char* key, const char* value) {
  return change(world, [&](m2_world& w) {
    merge2d::Settings settings = w.world.settings();
    merge2d::setByName(settings, &given(key, "key"), &given(value, "value"));
    w.world.setSettings(settings);
  });
}

m2_status m2_world_get(const m2_world* world, const char* key, char** value) {
  return guarded([&] {
    given(value, "value") = merge2d::copyOf(
        merge2d::getByName(given(world, "world").world.settings(), &given(key, "key")));
  });
}

m2_status m2_world_save(m2_world* world, const void** bytes, size_t* size) {
  return guarded([&] {
    m2_world& w = given(world, "world");
    const void*& out = given(bytes, "bytes");
    size_t& out_size = given(size, "size");
    w.saved = w.world.save();
    out = w.saved.data();
    out_size = w.saved.size();
  });
}

m2_status m2_world_restore(m2_world* world, const void* bytes, size_t size, bool other_settings) {
  return change(world, [&](m2_world& w) {
    const auto* text = static_cast<const char*>(&given(static_cast<const char*>(bytes), "bytes"));
    // A copy: they may be those that this world saved.
    const std::string state(text, size);
    w.world.restore(
        state, "the saved state",
        other_settings ? merge2d::SavedUnder::AnySettings : merge2d::SavedUnder::SameSettings);
    w.noted = false;
  });
}
