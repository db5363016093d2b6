#pragma once
/// Assertions for programmers' mistakes. They print the values they are about and stay on in every
/// build: they stand outside the hot loops.

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

/// MERGE2D_ASSERT(a < b, "a {} must be below b {}", a, b)
#define MERGE2D_ASSERT(condition, ...)                                                       \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      fmt::print(stderr, "{}:{}: assertion {} failed: {}\n", __FILE__, __LINE__, #condition, \
                 fmt::format(__VA_ARGS__));                                                  \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)
