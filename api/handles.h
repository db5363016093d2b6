#pragma once
/// The objects behind the pointers of the public interface, and how its functions fail.

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "merge2d/merge2d.h"
#include "render/frame.h"
#include "src2d/body_locator.h"
#include "src2d/core/error.h"
#include "src2d/core/suggest.h"
#include "src2d/world.h"

struct m2_scene {
  merge2d::Scene scene;
};

/// Arrays that follow the world; made when somebody asks for them.
struct WatchedArrays {
  std::unique_ptr<double[]> poses, velocities;
  std::unique_ptr<std::int32_t[]> collections;
};

/// The results of the last step, as the public interface shows it.
struct WorldRecords {
  bool captured = false;  ///< `snapshot` and the arrays below are of now
  merge2d::Snapshot snapshot;
  std::vector<m2_contact> contacts;
  std::vector<m2_collection> collections;
  std::vector<m2_body> members;
  std::vector<m2_joint_state> joints;
  std::vector<m2_spring_state> springs;
  std::vector<m2_event> events;
  std::vector<m2_decision> decisions;
};

struct m2_world {
  explicit m2_world(std::shared_ptr<const merge2d::Scene> scene, merge2d::Mode mode)
      : world(std::move(scene), {.mode = mode, .timings = false}) {}

  merge2d::World world;
  bool noting = false;  ///< the steps to come note their decisions
  bool noted = false;   ///< the last step did
  WatchedArrays watched;
  WorldRecords records;
  bool located = false;  ///< `locator` is of now
  merge2d::BodyLocator locator;
  std::string saved;

  std::unique_ptr<merge2d::FrameDrawer> drawer;
  std::string drawn_as;  ///< the drawing for which the drawer was made
  std::thread::id drawn_by;

  /// To be called after each change: views of the world are stale then.
  void changed();
  /// The records of now.
  const WorldRecords& seen();
  const merge2d::BodyLocator& places();
};

namespace merge2d {

/// Keeps the message of the current exception, for m2_error.
m2_status failed(m2_status status, const char* message) noexcept;
/// The status of the exception that is being handled.
m2_status failure() noexcept;

template <class Work>
m2_status guarded(Work&& work) noexcept {
  try {
    work();
    return M2_OK;
  } catch (...) {
    return failure();
  }
}

/// Throws InputError for a null pointer.
template <class T>
T& given(T* pointer, const char* name) {
  if (pointer == nullptr) throw InputError(fmt::format("{} is a null pointer", name));
  return *pointer;
}

/// The body of that name, in the descriptions of a scene or the bodies of a world; throws
/// InputError with a suggestion.
template <class Bodies>
m2_body bodyCalled(const Bodies& bodies, const std::string& name) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == name) return static_cast<m2_body>(i);
    names.emplace_back(bodies[i].name);
  }
  throw InputError(fmt::format("there is no body '{}'{}", name, didYouMean(name, names)));
}

/// Does something to a world, which has changed then even when it fails.
template <class Work>
m2_status change(m2_world* world, Work&& work) noexcept {
  return guarded([&] {
    m2_world& w = given(world, "world");
    struct Finally {
      m2_world& w;
      ~Finally() { w.changed(); }
    } finally{w};
    work(w);
  });
}

/// A copy that `m2_free` frees.
char* copyOf(std::string_view text);

inline Vec2 toVec(m2_vec v) { return {v.x, v.y}; }
inline m2_vec fromVec(const Vec2& v) { return {v.x(), v.y()}; }

/// Throw InputError for values without meaning.
BodyDesc toDesc(const m2_body_def& def);
SpringDesc toDesc(const m2_spring_def& def);
JointDesc toDesc(const m2_joint_def& def);
std::vector<ConvexShape> toShapes(const m2_shape& shape);
Mode toMode(m2_mode mode);

}  // namespace merge2d
