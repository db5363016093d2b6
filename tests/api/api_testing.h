#pragma once
/// Scenes and refusals of the public interface.

#include <merge2d/merge2d.h>

#include <string>

namespace merge2d::testing_api {

/// A pinned ground, body 0, and `boxes` unit boxes on it, one on the other.
inline Scene towerOf(int boxes) {
  Scene scene;
  scene.add({.name = "ground",
             .motion = Motion::Pinned,
             .position = {0.0, -0.5},
             .shapes = {Shape::box(20.0, 1.0)}});
  for (int i = 0; i < boxes; ++i) {
    scene.add({.name = "box " + std::to_string(i),
               .position = {0.0, 0.5 + i},
               .shapes = {Shape::box(1.0, 1.0)}});
  }
  return scene;
}

/// The message of an InputError.
template <class Work>
std::string refusal(Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace merge2d::testing_api
