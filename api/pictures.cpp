#include <algorithm>
#include <cmath>
#include <cstring>

#include "api/handles.h"
#include "lessons/folder.h"
#include "lessons/lesson.h"
#include "lessons/page.h"
#include "render/new_file.h"
#include "render/png.h"
#include "src2d/core/suggest.h"
#include "src2d/scene/load.h"

using merge2d::given;
using merge2d::guarded;

namespace merge2d {
namespace {

constexpr int kLargest = 16384;  // [px]

/// All that a picture's look depends on, to tell whether a drawer still serves.
std::string keyOf(const m2_world& world, const m2_picture_def& def) {
  const auto text = [](const char* t) { return t == nullptr ? "" : t; };
  std::string key =
      fmt::format("{}x{} {} {} {} {} bodies", def.width, def.height, text(def.overlays),
                  text(def.theme), def.transparent, world.world.bodies().size());
  if (def.has_camera) {
    key += fmt::format(" {} {} {}", def.camera_center.x, def.camera_center.y, def.camera_height);
  }
  return key;
}

void check(const m2_picture_def& def) {
  if (def.width < 16 || def.height < 16 || def.width > kLargest || def.height > kLargest) {
    throw InputError(fmt::format("a picture has 16 to {} pixels in each direction, not {}x{}",
                                 kLargest, def.width, def.height));
  }
  if (!def.has_camera) return;
  const bool finite = std::isfinite(def.camera_center.x) && std::isfinite(def.camera_center.y);
  if (!finite || !(def.camera_height > 0.0) || !std::isfinite(def.camera_height)) {
    throw InputError("a camera has a finite centre and a positive height");
  }
}

FrameStyle styleOf(const m2_world& world, const m2_picture_def& def) {
  FrameStyle style;
  style.width = def.width;
  style.height = def.height;
  if (def.theme != nullptr) style.theme = themeByName(def.theme);
  style.transparent = def.transparent;
  style.overlays = def.overlays == nullptr ? Overlays::standard() : parseOverlays(def.overlays);
  style.mode = world.world.mode();
  const Scene& scene = world.world.scene();
  // The view of the beginning, whenever the first picture is drawn.
  const World start(scene);
  adaptToScene(style, scene, start.capture(), start.bodies());
  if (def.has_camera) {
    style.followed.reset();
    style.camera = {.center = toVec(def.camera_center), .height = def.camera_height};
  }
  return style;
}

/// A drawer belongs to the thread that made it, as its OpenGL does.
FrameDrawer& drawerOf(m2_world& world, const m2_picture_def& def) {
  const std::string key = keyOf(world, def);
  if (world.drawer && world.drawn_as == key && world.drawn_by == std::this_thread::get_id()) {
    return *world.drawer;
  }
  world.drawer.reset();
  world.drawer = std::make_unique<FrameDrawer>(world.world.bodies(), styleOf(world, def));
  world.drawn_as = key;
  world.drawn_by = std::this_thread::get_id();
  return *world.drawer;
}

Picture draw(m2_world* world, const m2_picture_def* def) {
  m2_world& w = given(world, "world");
  check(given(def, "def"));
  return drawerOf(w, *def).draw(w.seen().snapshot);
}

Recording recorded(const Scene& scene, Mode mode, Detail detail) {
  Recording recording = record(
      scene, {.mode = mode,
              .detail = detail,
              .steps = static_cast<std::int64_t>(std::ceil(scene.duration / scene.step - 1e-9))});
  if (detail == Detail::Full) lookInside(recording);
  return recording;
}

std::string pageOf(const Scene& scene, Mode mode, bool live) {
  PageContent content{.title = scene.title, .lesson = "null", .traces = {}};
  content.traces.push_back({std::string(name(mode)), recorded(scene, mode, Detail::Full)});
  if (mode != Mode::Reference) {
    content.traces.push_back({"reference", recorded(scene, Mode::Reference, Detail::Motion)});
  }
  return makePage(content, live);
}

std::string pageOf(const Lesson& lesson, bool live) {
  std::vector<Recording> recordings = recordLesson(lesson);
  PageContent content{
      .title = lesson.title, .lesson = lessonJson(lesson, recordings), .traces = {}};
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    content.traces.push_back(
        {lesson.traces[i].label, std::move(recordings[i]), lesson.traces[i].world});
  }
  return makePage(content, live);
}

/// A name without a dot or a slash, which no lesson and no scene has.
void refuseUnknownName(const std::string& name) {
  if (name.find_first_of("./") != std::string::npos) return;
  std::vector<std::string> names;
  for (const BuiltinLesson& lesson : builtinLessons()) names.push_back(lesson.name);
  for (const BuiltinScene& scene : builtinScenes()) names.push_back(scene.name);
  const std::vector<std::string_view> views(names.begin(), names.end());
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  throw InputError(
      fmt::format("no lesson or scene is called '{}'{}", name, didYouMean(name, views)));
}

}  // namespace
}  // namespace merge2d

m2_picture_def m2_picture_def_default() {
  m2_picture_def def{};
  def.width = 960;
  def.height = 540;
  return def;
}

m2_status m2_world_draw(m2_world* world, const m2_picture_def* def, uint8_t* rgba, size_t size) {
  return guarded([&] {
    const merge2d::Picture picture = merge2d::draw(world, def);
    if (size != picture.rgba.size()) {
      throw merge2d::InputError(
          fmt::format("the picture has {} bytes, not {}", picture.rgba.size(), size));
    }
    std::memcpy(&given(rgba, "rgba"), picture.rgba.data(), size);
  });
}

m2_status m2_world_write_png(m2_world* world, const m2_picture_def* def, const char* path) {
  return guarded([&] {
    const std::string file = &given(path, "path");
    const merge2d::Picture picture = merge2d::draw(world, def);
    merge2d::PngEncoder encoder;
    merge2d::NewFile out(file);
    out.write(encoder.encode(picture, {.alpha = def->transparent}));
    out.finish();
  });
}

m2_status m2_lesson_page(const char* name, bool live, char** html) {
  return guarded([&] {
    const std::string wanted = &given(name, "name");
    char*& out = given(html, "html");
    for (const merge2d::BuiltinLesson& lesson : merge2d::builtinLessons()) {
      if (lesson.name != wanted) continue;
      out = merge2d::copyOf(merge2d::pageOf(merge2d::loadLesson(lesson.folder), live));
      return;
    }
    if (std::filesystem::is_directory(wanted)) {
      const merge2d::DataFolder folder{std::filesystem::path(wanted)};
      out = merge2d::copyOf(merge2d::pageOf(merge2d::loadLesson(folder), live));
      return;
    }
    merge2d::refuseUnknownName(wanted);
    out = merge2d::copyOf(
        merge2d::pageOf(merge2d::loadScene(wanted), merge2d::Mode::MergeSleep, live));
  });
}

m2_status m2_scene_page(const m2_scene* scene, m2_mode mode, bool live, char** html) {
  return guarded([&] {
    const merge2d::Scene& s = given(scene, "scene").scene;
    given(html, "html") = merge2d::copyOf(merge2d::pageOf(s, merge2d::toMode(mode), live));
  });
}
