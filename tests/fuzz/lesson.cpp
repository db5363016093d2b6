/// Lessons: lesson.toml and text.md, which a line of percent signs parts.

#include "lessons/lesson.h"

#include <array>

#include "tests/fuzz/harness.h"

namespace merge2d::fuzz {

void tryInput(std::string_view bytes) {
  constexpr std::string_view kBetween = "\n%%%%\n";
  const std::size_t at = std::min(bytes.find(kBetween), bytes.size());
  const std::string_view text = bytes.substr(std::min(at + kBetween.size(), bytes.size()));
  const std::array<EmbeddedFile, 2> files{
      {{"lesson.toml", bytes.substr(0, at)}, {"text.md", text}}};
  try {
    const Lesson lesson = loadLesson(DataFolder("fuzz", files));
    require(!lesson.traces.empty(), "a lesson shows something", bytes);
  } catch (const InputError&) {
  } catch (const IoError&) {
  }
}

}  // namespace merge2d::fuzz
