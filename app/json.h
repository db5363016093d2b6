#pragma once
/// JSON whose keys stay in the order they were written.

#include <nlohmann/json.hpp>

namespace merge2d {

using Json = nlohmann::ordered_json;

}  // namespace merge2d
