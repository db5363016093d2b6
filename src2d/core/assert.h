#pragma once
/// Assertions for programmers' mistakes. They print the values they are about and stay on in every
/// build: they stand outside the hot loops.

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

/// The name of the source without its folder: where the program was built is nobody's business, and
/// the same sources give the same bytes everywhere.
#ifdef __FILE_NAME__
#define MERGE2D_FILE __FILE_NAME__
#else
#define MERGE2D_FILE __FILE__
#endif

/// MERGE2D_ASSERT(a < b, "a {} must be below b {}", a, b)
#define MERGE2D_ASSERT(condition, ...)                                                           \
  do {                                                                                           \
    if (!(condition)) {                                                                          \
      fmt::print(stderr, "{}:{}: assertion {} failed: {}\n", MERGE2D_FILE, __LINE__, #condition, \
                 fmt::format(__VA_ARGS__));                                                      \
      std::abort();                                                                              \
    }                                                                                            \
  } while (false)
