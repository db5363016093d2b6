/// Drawn scenes: PNG pictures.

#include "tests/fuzz/harness.h"

namespace merge2d::fuzz {

void tryInput(std::string_view bytes) {
  try {
    requireSound(parseDrawing(std::string(bytes), "fuzz.png"));
  } catch (const InputError&) {
  }
}

}  // namespace merge2d::fuzz
