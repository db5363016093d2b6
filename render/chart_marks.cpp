#include "render/chart_marks.h"

#include <algorithm>

#include "src2d/core/utf8.h"

namespace merge2d {
namespace {

using Marks = std::vector<PlacedMark*>;

/// Whether a line or another name that reaches from `from` to `to` meets the name.
bool meets(const PlacedMark& mark, float from, float to, float gap) {
  return from < mark.start + mark.width + gap && to > mark.start - gap;
}

/// On which side of its line each name stands: before it where it would leave the plot otherwise,
/// or be crossed by the line of one that stands there. What fits on neither side begins before
/// `left`.
void chooseSides(std::span<PlacedMark> marks, float left, float right, float gap) {
  float end = right;
  for (std::size_t i = marks.size(); i-- > 0;) {
    PlacedMark& mark = marks[i];
    mark.at_right = mark.column + mark.width > end;
    mark.start = mark.at_right ? mark.column - mark.width : mark.column;
    if (mark.at_right && mark.start >= left) end = std::min(end, mark.column - gap);
  }
}

/// Rows for all of these, or false where there are too few. A name that begins at its line stands
/// above the later lines it reaches, one that ends there above all names that begin, or end
/// earlier, where it is.
bool findRows(const Marks& marks, float gap) {
  for (std::size_t i = marks.size(); i-- > 0;) {
    PlacedMark& mark = *marks[i];
    mark.row = 0;
    for (std::size_t k = i + 1; !mark.at_right && k < marks.size(); ++k) {
      const PlacedMark& later = *marks[k];
      if (later.column >= mark.start + mark.width + gap) break;
      if (!later.at_right) mark.row = std::max(mark.row, later.row + 1);
    }
    if (mark.row >= PlacedMark::kRows) return false;
  }
  for (std::size_t i = 0; i < marks.size(); ++i) {
    PlacedMark& mark = *marks[i];
    for (std::size_t k = 0; mark.at_right && k < marks.size(); ++k) {
      const PlacedMark& other = *marks[k];
      if (k == i || (k > i && other.at_right)) continue;
      const float end = std::max(other.column, other.start + other.width);
      if (meets(mark, other.start, end, gap)) mark.row = std::max(mark.row, other.row + 1);
    }
    if (mark.row >= PlacedMark::kRows) return false;
  }
  return true;
}

}  // namespace

void placeNames(std::span<PlacedMark> marks, float left, float right, float gap) {
  chooseSides(marks, left, right, gap);
  Marks named;
  for (PlacedMark& mark : marks) {
    if (mark.start < left) continue;
    named.push_back(&mark);
    mark.named = findRows(named, gap);
    if (!mark.named) named.pop_back();
  }
  findRows(named, gap);
}

std::string shortened(std::string_view text, std::size_t characters) {
  std::size_t at = 0, cut = 0;
  for (std::size_t count = 1; at < text.size(); ++count) {
    if (count == characters) cut = at;
    if (count > characters) return std::string(text.substr(0, cut)) + "…";
    at += std::max<std::size_t>(1, characterBytes(text, at));
  }
  return std::string(text);
}

}  // namespace merge2d
