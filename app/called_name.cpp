#include "app/called_name.h"

namespace merge2d {
namespace {

std::string& storedName() {
  static std::string name = "merge2d";
  return name;
}

}  // namespace

void setCalledName(const char* name) {
  if (name != nullptr && *name != '\0') storedName() = name;
}

const std::string& calledName() { return storedName(); }

}  // namespace merge2d
