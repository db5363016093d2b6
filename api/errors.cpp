#include <cstdlib>
#include <cstring>
#include <string_view>

#include "api/handles.h"

namespace {

thread_local std::string last_message;
thread_local const char* last_error = "";

}  // namespace

namespace merge2d {

m2_status failed(m2_status status, const char* message) noexcept {
  try {
    last_message = message;
    last_error = last_message.c_str();
  } catch (...) {
    last_error = "there is not enough memory, not even for this message";
  }
  return status;
}

m2_status failure() noexcept {
  try {
    throw;
  } catch (const InputError& error) {
    // A change "key=value" of the library is an option of the program.
    constexpr std::string_view kOption = "--set ";
    const std::string_view message = error.what();
    const std::size_t skipped = message.starts_with(kOption) ? kOption.size() : 0;
    return failed(M2_INPUT_ERROR, error.what() + skipped);
  } catch (const IoError& error) {
    return failed(M2_IO_ERROR, error.what());
  } catch (const SimulationError& error) {
    return failed(M2_SIMULATION_ERROR, error.what());
  } catch (const std::bad_alloc&) {
    return failed(M2_MEMORY_ERROR, "there is not enough memory");
  } catch (const std::exception& error) {
    return failed(M2_INTERNAL_ERROR, error.what());
  } catch (...) {
    return failed(M2_INTERNAL_ERROR, "an unknown error");
  }
}

char* copyOf(std::string_view text) {
  auto* copy = static_cast<char*>(std::malloc(text.size() + 1));
  if (copy == nullptr) throw std::bad_alloc();
  std::memcpy(copy, text.data(), text.size());
  copy[text.size()] = '\0';
  return copy;
}

}  // namespace merge2d

const char* m2_version() { return MERGE2D_VERSION; }
const char* m2_error() { return last_error; }
void m2_free(char* text) { std::free(text); }
