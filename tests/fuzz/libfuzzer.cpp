/// How libFuzzer calls a harness.

#include "tests/fuzz/harness.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  merge2d::fuzz::tryInput({reinterpret_cast<const char*>(data), size});
  return 0;
}
