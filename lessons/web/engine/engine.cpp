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

#include "lessons/live.h"
#include "lessons/step_text.h"
#include "src2d/scene/load.h"
#include "src2d/trace/trace_writer.h"

#define MERGE2D_EXPORT extern "C" __attribute__((used, visibility("default")))

namespace {

using namespace merge2d;

std::map<int, std::unique_ptr<Live>> worlds;
int last_handle = 0;
std::string buffer;  ///< what the last call gave

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

Live& at(int handle) { return *worlds.at(handle); }
BodyId id(int body) { return BodyId{static_cast<std::uint32_t>(body)}; }

Mode modeNamed(std::string_view text) {
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge}) {
    if (text == name(mode)) return mode;
  }
  return Mode::MergeSleep;
}

}  // namespace

/// Room for `size` bytes that the page writes before it calls; its address.
MERGE2D_EXPORT char* reserve(int size) {
  buffer.assign(static_cast<std::size_t>(size), '\0');
  return buffer.data();
}
MERGE2D_EXPORT const char* result() { return buffer.data(); }
MERGE2D_EXPORT int resultSize() { return static_cast<int>(buffer.size()); }

/// A world of the scene in the buffer: the mode's name, a line break, TOML. Gives its handle.
MERGE2D_EXPORT int openWorld() {
  return guarded([] {
    const std::string text = buffer;
    const std::size_t line = text.find('\n');
    const Scene scene = parseScene(std::string_view(text).substr(line + 1), "scene.toml");
    worlds[++last_handle] = std::make_unique<Live>(scene, modeNamed(text.substr(0, line)));
    return last_handle;
  });
}
MERGE2D_EXPORT void closeWorld(int handle) { worlds.erase(handle); }

/// Takes steps without looking inside until `step` are done.
MERGE2D_EXPORT int skipTo(int handle, int step) {
  return guarded([&] {
    at(handle).skipTo(step);
    return 1;
  });
}
/// Takes a step and leaves its text.
MERGE2D_EXPORT int stepWorld(int handle) {
  return guarded([&] {
    Live& live = at(handle);
    const StepRecord record = live.step();
    buffer = stepText(record, live.world().bodies());
    return 1;
  });
}
/// Takes steps until `step` are done and leaves their lines of the trace.
MERGE2D_EXPORT int traceWorld(int handle, int step) {
  return guarded([&] {
    World& world = at(handle).world();
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
/// Leaves the text of the state.
MERGE2D_EXPORT int seeWorld(int handle) {
  return guarded([&] {
    buffer = stateText(at(handle).world().capture(), at(handle).world().bodies());
    return 1;
  });
}

MERGE2D_EXPORT int saveWorld(int handle) {
  return guarded([&] {
    buffer = at(handle).world().save();
    return 1;
  });
}
/// Takes over the bytes in the buffer.
MERGE2D_EXPORT int restoreWorld(int handle) {
  return guarded([&] {
    at(handle).world().restore(buffer, "a saved state");
    at(handle).letAllGo();
    return 1;
  });
}

MERGE2D_EXPORT void pushBody(int handle, int body, double x, double y, double px, double py) {
  at(handle).world().applyImpulse(id(body), {x, y}, {px, py});
}
MERGE2D_EXPORT void dragBody(int handle, int body, double gx, double gy, double x, double y) {
  at(handle).drag(id(body), {.grip = {gx, gy}, .target = {x, y}});
}
MERGE2D_EXPORT void letGo(int handle, int body) { at(handle).letGo(id(body)); }
MERGE2D_EXPORT double dragForce(int handle, int body, int axis) {
  return at(handle).force(id(body))[axis];
}
