#pragma once
/// The constant properties of a body, as the pages read them.

#include "src2d/trace/json_text.h"
#include "src2d/trace/snapshot.h"

namespace merge2d {

/// An object: name, motion, mass, inertia, its pieces and their common boundary.
void writeBody(JsonText& out, const BodyInfo& body);

}  // namespace merge2d
