#pragma once
/// toml++, compiled once (toml.cpp) into our own library: it is quick to include, and users of the
/// engine need not link the shared one. Some wrong files (`x = {a=}`) trip its assertions; these
/// throw here, in every kind of build, so that parseToml can report them.

namespace merge2d {
struct TomlAssertion {};
[[noreturn]] void throwTomlAssertion();
}  // namespace merge2d

#pragma push_macro("NDEBUG")
#undef NDEBUG
#undef TOML_HEADER_ONLY
#undef TOML_SHARED_LIB
#define TOML_HEADER_ONLY 0
#define TOML_SHARED_LIB 0
#define TOML_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : ::merge2d::throwTomlAssertion())
#include <toml++/impl/preprocessor.h>
#if TOML_LIB_MAJOR == 3 && TOML_LIB_MINOR <= 3
// Its tests for white space reach the unreachable for characters such as 'µ', where "no" is meant.
#undef TOML_UNREACHABLE
#define TOML_UNREACHABLE return {}
#endif
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
