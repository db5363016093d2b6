/// Text scenes.

#include "tests/fuzz/harness.h"

namespace merge2d::fuzz {

void tryInput(std::string_view bytes) {
  try {
    requireSound(parseScene(bytes, "fuzz.toml"));
  } catch (const InputError&) {
  }
}

}  // namespace merge2d::fuzz
