#pragma once
/// Walks through a run on command, stage by stage: what `merge2d step` understands. Lines in, text
/// out, so that it works in a terminal, from a pipe and in a test.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "lessons/tables.h"
#include "lessons/timeline.h"

namespace merge2d {

/// Draws a stage of a recorded step, or the state before the first step (null), into a file;
/// returns what the picture shows. Throws IoError.
using PictureMaker =
    std::function<std::string(const StepRecord* record, Stage stage, const std::string& file)>;

/// The answer to one line.
struct Answer {
  std::string text;
  bool ok = true;  ///< false: the line was not understood, or could not be done
};

class Player {
 public:
  Player(const Scene& scene, Mode mode, std::int64_t last, PictureMaker draw);

  /// The first view.
  std::string greeting() const;
  /// "step 118 Unmerge > ".
  std::string prompt() const;
  /// Does what a line says. An empty line repeats the last motion; "#" starts a comment.
  Answer run(std::string_view line);
  bool done() const { return done_; }

  /// The completions of the last word of a line: commands, stages, bodies.
  std::vector<std::string> completions(std::string_view line) const;

  std::int64_t step() const { return step_; }
  Stage stage() const { return stage_; }
  double time();  ///< of the state that is shown [s]

 private:
  using Arguments = std::vector<std::string>;
  struct Command;
  static const std::vector<Command>& commands();
  const Command& find(std::string_view word) const;

  // The commands.
  std::string forward(const Arguments& arguments);
  std::string back(const Arguments& arguments);
  std::string forwardStage(const Arguments& arguments);
  std::string backStage(const Arguments& arguments);
  std::string nextEvent(const Arguments& arguments);
  std::string previousEvent(const Arguments& arguments);
  std::string jump(const Arguments& arguments);
  std::string here(const Arguments& arguments);
  std::string table(const Arguments& arguments);
  std::string stages(const Arguments& arguments);
  std::string why(const Arguments& arguments);
  std::string body(const Arguments& arguments);
  std::string pair(const Arguments& arguments);
  std::string events(const Arguments& arguments);
  std::string picture(const Arguments& arguments);
  std::string changed(const Arguments& arguments);
  std::string undo(const Arguments& arguments);
  std::string byHand(const Arguments& words);
  std::string help(const Arguments& arguments);
  std::string quit(const Arguments& arguments);

  std::string moveTo(std::int64_t step, Stage stage);
  const Snapshot& now();  ///< the state after the stage
  std::string contactsOf(const RowFilter& filter);
  BodyId bodyNamed(const std::string& name) const;
  std::string report();
  std::string eventList(const Snapshot& of) const;

  Timeline timeline_;
  Words words_;
  PictureMaker draw_;
  std::int64_t step_ = 0;
  Stage stage_ = Stage::Merge;  ///< the stage that was done last
  std::string last_motion_ = "step";
  bool done_ = false;
};

}  // namespace merge2d
