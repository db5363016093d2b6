#pragma once
/// The name that this program was called by: the first word of its command line.

#include <string>

namespace merge2d {

/// For commands that it prints. To be called once, before anything else asks for it.
void setCalledName(const char* name);

/// "merge2d", or with the path to it that was typed: "build/merge2d".
const std::string& calledName();

}  // namespace merge2d
