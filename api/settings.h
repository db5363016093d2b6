#pragma once
/// Numbers and words of a scene by their names in scene files.

#include <string>

#include "src2d/scene/scene.h"

namespace merge2d {

/// Sets title, gravity, step, duration, seed, or a setting. Throws InputError with a suggestion for
/// an unknown key, and with the range for a value outside of it.
void setByName(Scene& scene, const std::string& key, const std::string& value);
/// The same for a setting alone.
void setByName(Settings& settings, const std::string& key, const std::string& value);

/// As `setByName` takes it.
std::string getByName(const Scene& scene, const std::string& key);
std::string getByName(const Settings& settings, const std::string& key);

}  // namespace merge2d
