#pragma once
/// Lessons by their names, as commands take them.

#include <optional>
#include <string>

#include "app/options.h"
#include "src2d/scene/data_folder.h"
#include "src2d/scene/load.h"

namespace merge2d {

/// A built-in lesson's folder, or a folder that holds one.
std::optional<DataFolder> lessonNamed(const std::string& name);

/// The scene that a lesson is about, with changes. Throws InputError, IoError.
Scene sceneOfLesson(const DataFolder& lesson, const Overrides& overrides);

}  // namespace merge2d
