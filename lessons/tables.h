#pragma once
/// The work of a stage as a table of text: for terminals, pipes and screen readers.

#include <optional>
#include <string>
#include <vector>

#include "lessons/words.h"
#include "src2d/recorder.h"

namespace merge2d {

/// Columns of text, each as wide as its widest cell; numbers to the right.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> head) : head_(std::move(head)) {}

  /// `rank`: the larger, the more it is worth a place when not all rows are shown.
  void add(std::vector<std::string> row, double rank = 0.0);
  bool empty() const { return rows_.empty(); }
  /// At most `most` rows, the largest ranks first; rows of one rank in the order in which they were
  /// added. "(none)" when there are none.
  std::string text(std::size_t most) const;

 private:
  struct Row {
    std::vector<std::string> cells;
    double rank = 0.0;
  };
  std::vector<std::string> head_;
  std::vector<Row> rows_;
};

/// Which rows are wanted.
struct RowFilter {
  std::size_t most = 16;
  std::optional<BodyId> body;                     ///< those that concern it
  std::optional<std::pair<BodyId, BodyId>> pair;  ///< those of this pair, ascending

  bool wants(BodyId a, BodyId b) const;
  bool wants(BodyId a) const;
};

/// The table of a stage, below a line that says what the stage does.
std::string stageTable(const Words& words, const StepRecord& record, Stage stage,
                       const RowFilter& filter = {});

/// "Which welds break?" …: what a stage does, in one line.
const char* purpose(Stage stage);

/// The work of a stage in this step, in one line: "2 welds ended; C1 came apart into 2".
std::string summary(const StepRecord& record, Stage stage);
/// The same in at most 26 characters: "34 found", "nothing to do".
std::string result(const StepRecord& record, Stage stage);

}  // namespace merge2d
