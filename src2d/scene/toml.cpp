#define TOML_IMPLEMENTATION
#include "src2d/scene/toml.h"
