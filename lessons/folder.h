#pragma once
/// The lessons that come with the program, and the program of their pages.

#include <span>
#include <vector>

#include "src2d/scene/data_folder.h"

namespace merge2d {

/// The files of `lessons/` as they were when the program was built.
std::span<const EmbeddedFile> embeddedLessons();
/// `player.js`, `player.css` and the engine, `engine.b64`. They read the output of this program, so
/// nothing replaces them.
std::span<const EmbeddedFile> embeddedPlayer();
/// `page.txt` and `engine.txt`: the licences of all parts of a page.
std::span<const EmbeddedFile> embeddedLicences();

/// Where lessons are looked for, in this order.
inline std::vector<DataFolder> lessonFolders() {
  return dataFolders("lessons", "MERGE2D_LESSONS", embeddedLessons());
}

}  // namespace merge2d
