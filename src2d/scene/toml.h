#pragma once
/// toml++, compiled once (toml.cpp) into our own library: it is quick to include, and users of the
/// engine need not link the shared one.

#undef TOML_HEADER_ONLY
#undef TOML_SHARED_LIB
#define TOML_HEADER_ONLY 0
#define TOML_SHARED_LIB 0
#include <toml++/toml.h>
