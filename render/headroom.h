#pragma once
/// Memory that is left for code which does not survive a lack of it.

#include <cstddef>

namespace merge2d {

/// Throws std::bad_alloc unless so many bytes can be had just now. Mesa and the compiler inside it
/// end the process by a null pointer where memory is refused: they are asked for nothing then.
void requireHeadroom(std::size_t bytes);

}  // namespace merge2d
