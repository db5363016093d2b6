#define TOML_IMPLEMENTATION
#include "src2d/scene/toml.h"

namespace merge2d {

void throwTomlAssertion() { throw TomlAssertion(); }

}  // namespace merge2d
