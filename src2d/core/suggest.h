#pragma once
/// "Did you mean": the known word nearest to a mistyped one.

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace merge2d {

/// How many insertions, deletions, replacements and swaps of neighbours turn `a` into `b`, upper
/// and lower case being the same (optimal string alignment).
inline std::size_t editDistance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  const auto same = [&](std::size_t i, std::size_t j) { return lower(a[i]) == lower(b[j]); };
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (same(i - 1, j - 1) ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1)) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

/// Whether `word` is one of those known.
template <class Words>
bool isAmong(std::string_view word, const Words& known) {
  return std::find(known.begin(), known.end(), word) != known.end();
}

/// "bodies" of "body": the plurals that change more than an s.
inline std::string pluralOf(std::string_view word) {
  return word.ends_with('y') ? std::string(word.substr(0, word.size() - 1)) + "ies"
                             : std::string(word);
}

/// Whether it is a known word cut short: "--out" of "--output". Less than four letters, or half a
/// word, may begin too many.
inline bool abbreviates(std::string_view word, std::string_view known) {
  return word.size() >= 4 && 2 * word.size() >= known.size() && known.starts_with(word);
}

/// How far `word` is from a known one, or one of them from the plural of the other: who writes
/// "bodies" means "body", and the other way round.
inline std::size_t distanceToMeant(std::string_view word, std::string_view known) {
  if (word != known && abbreviates(word, known)) return 1;
  return std::min({editDistance(word, known), editDistance(word, pluralOf(known)),
                   editDistance(pluralOf(word), known)});
}

/// A word of other programs, and ours for the same.
struct Synonym {
  std::string_view theirs, ours;
};
inline constexpr Synonym kSynonyms[] = {
    {"position", "at"},    {"pos", "at"},       {"rotation", "angle"},
    {"radius", "circle"},  {"disc", "circle"},  {"width", "box"},
    {"height", "box"},     {"size", "box"},     {"vertices", "polygon"},
    {"vel", "velocity"},   {"omega", "spin"},   {"type", "motion"},
    {"static", "pinned"},  {"fixed", "pinned"}, {"kinematic", "scripted"},
    {"hinge", "revolute"}, {"pin", "revolute"}, {"slider", "prismatic"}};

/// The candidate nearest to `word`, or nothing when none is near enough to be meant. The first one
/// wins a tie.
template <class Words>
std::string_view nearest(std::string_view word, const Words& candidates) {
  constexpr std::size_t kLongest = 64;  // longer words are not worth the quadratic time
  std::string_view best;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  if (word.size() > kLongest) return best;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kLongest) continue;
    const std::size_t distance = distanceToMeant(word, candidate);
    if (distance < least && distance < word.size()) {
      least = distance;
      best = candidate;
    }
  }
  for (const Synonym& synonym : kSynonyms) {
    const bool meant = editDistance(word, synonym.theirs) == 0;
    if (meant && best.empty() && isAmong(synonym.ours, candidates)) return synonym.ours;
  }
  return best;
}

/// " (did you mean 'friction'?)", or nothing: to be put at the end of a sentence.
template <class Words>
std::string didYouMean(std::string_view word, const Words& candidates) {
  const std::string_view best = nearest(word, candidates);
  return best.empty() ? "" : " (did you mean '" + std::string(best) + "'?)";
}

}  // namespace merge2d
