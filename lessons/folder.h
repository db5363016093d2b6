#pragma once
/// Where the lessons and the program of their pages are.

#include <filesystem>

namespace merge2d {

/// MERGE2D_LESSONS of the environment, else the folder in the sources, else the installed one.
std::filesystem::path lessonFolder();

}  // namespace merge2d
