/// The engine as a lesson page calls it, compiled to WebAssembly by scripts/build-web. Worlds have
/// handles; texts and bytes go through one buffer; a failure gives 0 and leaves its sentence there.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>

#include "lessons/body_text.h"
#include "lessons/player_words.h"
#include "lessons/step_text.h"
#include "lessons/timeline.h"
#include "lessons/why.h"
#include "src2d/scene/load.h"
#include "src2d/scene/settings_list.h"
#include "src2d/trace/trace_writer.h"

#define MERGE2D_EXPORT extern "C" __attribute__((used, visibility("default")))

namespace {

using namespace merge2d;

constexpr std::int64_t kNoEnd = 1'000'000'000;

std::map<int, std::unique_ptr<Timeline>> worlds;
std::map<int, std::unique_ptr<World>> traced;
int last_handle = 0;
std::string buffer;  ///< the result of the last call

/// Runs `work`, which gives a number above 0; 0 when it throws.
template <class Work>
int guarded(Work&& work) {
  try {
    return work();
  } catch (const std::exception& e) {
    buffer = e.what();
    return 0;
  }
}

/// Leaves the JSON that `write` writes.
template <class Write>
int leave(Write&& write) {
  return guarded([&] {
    JsonText out;
    write(out);
    buffer = std::string(out.text());
    return 1;
  });
}

Timeline& at(int handle) { return *worlds.at(handle); }
BodyId id(int body) { return BodyId{static_cast<std::uint32_t>(body)}; }

Mode modeNamed(std::string_view text) {
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge}) {
    if (text == name(mode)) return mode;
  }
  return Mode::MergeSleep;
}

/// The scene in the buffer: the mode's name, a line break, TOML.
template <class Make>
int openScene(Make&& make) {
  return guarded([&] {
    const std::string text = buffer;
    const std::size_t line = text.find('\n');
    const Scene scene = parseScene(std::string_view(text).substr(line + 1), "scene.toml");
    make(++last_handle, scene, modeNamed(text.substr(0, line)));
    return last_handle;
  });
}

void writeSettings(JsonText& out, const World& world) {
  out.open('{').field("mode", name(world.mode())).key("gravity").value(world.gravity());
  out.field("step", world.timeStep());
  forEachSetting(world.settings(),
                 [&](std::string_view table, std::string_view key, const auto& value, const auto&) {
                   if constexpr (!std::is_enum_v<std::remove_cvref_t<decltype(value)>>) {
                     out.field(std::string(table) + "." + std::string(key), value);
                   }
                 });
  out.close('}');
}

}  // namespace

/// Room for `size` bytes that the page writes before it calls; its address.
MERGE2D_EXPORT char* reserve(int size) {
  buffer.assign(static_cast<std::size_t>(size), '\0');
  return buffer.data();
}
MERGE2D_EXPORT const char* result() { return buffer.data(); }
MERGE2D_EXPORT int resultSize() { return static_cast<int>(buffer.size()); }

/// A run of the scene in the buffer. Gives its handle.
MERGE2D_EXPORT int openWorld() {
  return openScene([](int handle, const Scene& scene, Mode mode) {
    worlds[handle] = std::make_unique<Timeline>(scene, mode, kNoEnd);
  });
}
MERGE2D_EXPORT void closeWorld(int handle) { worlds.erase(handle); }

/// Leaves the text of step `k` = 1, 2, …
MERGE2D_EXPORT int stepWorld(int handle, int k) {
  return guarded([&] {
    Timeline& run = at(handle);
    const StepRecord& record = run.step(k);
    buffer = stepText(record, run.bodies(), run.colors(k));
    return 1;
  });
}
/// Leaves the text of the state after step `k` and the changes made there.
MERGE2D_EXPORT int seeWorld(int handle, int k) {
  return guarded([&] {
    const Live& live = at(handle).at(k);
    buffer = stateText(live.world().capture(), at(handle).bodies(), live.colors());
    return 1;
  });
}
/// Changes the run after step `k` by the command in the buffer (lessons/hand.h), and leaves a
/// sentence about the change.
MERGE2D_EXPORT int changeWorld(int handle, int k) {
  return guarded([&] {
    const std::string line = buffer;
    buffer = at(handle).change(k, wordsOf(line));
    return 1;
  });
}
/// Takes back the last changes; gives 1 more than the step of the first of them.
MERGE2D_EXPORT int undoWorld(int handle, int count) {
  return guarded([&] {
    const auto step = at(handle).undo(static_cast<std::size_t>(count));
    return step ? static_cast<int>(*step) + 1 : 0;
  });
}
/// Leaves the bodies, also those that were added.
MERGE2D_EXPORT int bodiesOfWorld(int handle) {
  return leave([&](JsonText& out) {
    out.open('[');
    for (const BodyInfo& body : at(handle).bodies()) writeBody(out, body);
    out.close(']');
  });
}
/// Leaves the settings in force after step `k`.
MERGE2D_EXPORT int settingsOfWorld(int handle, int k) {
  return leave([&](JsonText& out) { writeSettings(out, at(handle).at(k).world()); });
}
/// Leaves why two bodies are one, or not, in step `k`.
MERGE2D_EXPORT int whyInWorld(int handle, int k, int a, int b) {
  return leave([&](JsonText& out) {
    Timeline& run = at(handle);
    const Words words(run.bodies());
    writeReason(out, words, reasonFor(words, run.state(k), id(a), id(b)));
  });
}
/// Leaves the forces of the hands after step `k`: body, grip and target in the world, force.
MERGE2D_EXPORT int handsOnWorld(int handle, int k) {
  return leave([&](JsonText& out) {
    const Live& live = at(handle).at(k);
    const Snapshot now = live.world().capture();
    out.open('[');
    for (const auto& [body, drag] : live.drags()) {
      for (const BodyState& seen : now.bodies) {
        if (seen.id != body) continue;
        const Vec2 grip = seen.pose() * drag.grip, force = live.force(body);
        out.row(body, grip.x(), grip.y(), drag.target.x(), drag.target.y(), force.x(), force.y());
      }
    }
    out.close(']');
  });
}

/// A world of the scene in the buffer whose trace is wanted. Gives its handle.
MERGE2D_EXPORT int openTraced() {
  return openScene([](int handle, const Scene& scene, Mode mode) {
    traced[handle] = std::make_unique<World>(scene, WorldOptions{.mode = mode, .timings = false});
  });
}
MERGE2D_EXPORT void closeTraced(int handle) { traced.erase(handle); }
/// Takes steps until `step` are done and leaves their lines of the trace.
MERGE2D_EXPORT int traceWorld(int handle, int step) {
  return guarded([&] {
    World& world = *traced.at(handle);
    std::ostringstream out;
    TraceWriter writer(out, world.scene(), world.mode(), world.bodies(), {.timings = false});
    out.str({});  // without the header
    while (world.steps() < step) {
      world.step();
      writer.add(world.capture());
    }
    buffer = out.str();
    return 1;
  });
}
