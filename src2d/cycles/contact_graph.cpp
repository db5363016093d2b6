#include "src2d/cycles/contact_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "src2d/core/error.h"
#include "src2d/core/suggest.h"
#include "src2d/core/utf8.h"
#include "src2d/scene/source_text.h"

namespace merge2d {
namespace {

constexpr std::string_view kPinned = "pinned";

/// A word of a line; columns count characters from 1.
struct Word {
  std::string_view text;
  std::uint32_t column = 0;
};

/// The words of a line up to a comment, and the column behind the last one.
struct Line {
  std::vector<Word> words;
  std::uint32_t end = 1;
};

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/// "0x1b", or "U+202E" for a character of several bytes.
std::string shownControl(std::string_view character) {
  const auto code = static_cast<std::uint32_t>(codePoint(character));
  return character.size() == 1 ? fmt::format("0x{:02x}", code) : fmt::format("U+{:04X}", code);
}

template <class Number>
std::optional<Number> numberIn(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

class GraphReader {
 public:
  GraphReader(std::string_view text, const std::string& source) : source_(source, text) {}

  ContactGraph read() {
    std::string_view rest = source_.text();
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
    for (line_ = 1; !rest.empty(); ++line_) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      readLine(split(rest.substr(0, end)));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    warnOfIdlePins();
    return std::move(graph_);
  }

 private:
  [[noreturn]] void fail(std::uint32_t column, std::string_view sentence) const {
    throw InputError(source_.message({line_, column}, sentence));
  }

  Line split(std::string_view text) const {
    Line line;
    std::uint32_t column = 0;
    bool inside = false;
    for (std::size_t i = 0, bytes = 0; i < text.size() && text[i] != '#'; i += bytes) {
      bytes = characterBytes(text, i);
      ++column;
      if (bytes == 0) {
        fail(column, fmt::format("expected text in UTF-8, got the byte 0x{:02x}",
                                 static_cast<unsigned char>(text[i])));
      }
      if (isBlank(text[i])) {
        inside = false;
        continue;
      }
      if (const std::string_view character = text.substr(i, bytes); isControl(character)) {
        fail(column,
             fmt::format("expected text, got the control character {}", shownControl(character)));
      }
      if (!inside) line.words.push_back({text.substr(i, 0), column});
      inside = true;
      std::string_view& word = line.words.back().text;
      word = {word.data(), word.size() + bytes};
      line.end = column + 1;
    }
    return line;
  }

  void readLine(const Line& line) {
    if (line.words.empty()) return;
    if (line.words[0].text == kPinned) {
      readPinned(line);
    } else {
      readPair(line);
    }
  }

  void readPinned(const Line& line) {
    if (line.words.size() < 2) fail(line.end, "expected the names of pinned bodies");
    for (std::size_t i = 1; i < line.words.size(); ++i) {
      const std::uint32_t body = bodyOf(line.words[i].text);
      graph_.pinned[body] = 1;
      pinned_at_.emplace_back(body, std::pair(line_, line.words[i].column));
    }
  }

  void readPair(const Line& line) {
    const auto& words = line.words;
    if (words.size() < 2) {
      fail(line.end, "expected a second body, got the end of the line" + meantPinned(words[0]));
    }
    if (words.size() < 3) {
      fail(line.end,
           "expected a count of contacts, got the end of the line" + meantPinned(words[0]));
    }
    GraphPair pair;
    pair.contacts = readCount(words[2], words[0]);
    if (words[0].text == words[1].text) {
      fail(words[1].column,
           fmt::format("expected two different bodies, got '{}' twice", words[0].text));
    }
    pair.a = bodyOf(words[0].text);
    pair.b = bodyOf(words[1].text);
    refuseSecond(pair, words[0]);
    readPoints(line, pair);
    graph_.pairs.push_back(std::move(pair));
  }

  static std::string meantPinned(const Word& first) {
    return didYouMean(first.text, std::vector<std::string_view>{kPinned});
  }

  int readCount(const Word& word, const Word& first) const {
    const auto count = numberIn<std::int64_t>(word.text);
    const bool whole =
        !word.text.empty() && std::all_of(word.text.begin(), word.text.end(),
                                          [](char c) { return c >= '0' && c <= '9'; });
    if (!whole) {
      fail(word.column,
           fmt::format("expected a count of contacts, got '{}'{}", word.text, meantPinned(first)));
    }
    if (!count || *count > GraphLimits::kContacts) {
      fail(word.column, fmt::format("expected a count of contacts of at most {}, got '{}'",
                                    GraphLimits::kContacts, word.text));
    }
    return static_cast<int>(*count);
  }

  void refuseSecond(const GraphPair& pair, const Word& first) {
    const auto key = std::minmax(pair.a, pair.b);
    const auto [before, added] = line_of_.try_emplace({key.first, key.second}, line_);
    if (added) return;
    fail(first.column,
         fmt::format("'{}' and '{}' already have line {}; give all their contacts there",
                     graph_.bodies[pair.a], graph_.bodies[pair.b], before->second));
  }

  /// All points of the contacts, or none.
  void readPoints(const Line& line, GraphPair& pair) const {
    const auto& words = line.words;
    const std::size_t given = words.size() - 3, expected = static_cast<std::size_t>(pair.contacts);
    for (std::size_t i = 3; i < words.size(); ++i) pair.points.push_back(readPoint(words[i]));
    if (given == 0 || given == expected) return;
    const std::uint32_t column = given > expected ? words[3 + expected].column : line.end;
    fail(column, fmt::format("expected {} point{} for {} contact{}, got {}", expected,
                             expected == 1 ? "" : "s", expected, expected == 1 ? "" : "s", given));
  }

  Vec2 readPoint(const Word& word) const {
    const std::size_t comma = word.text.find(',');
    std::optional<double> x, y;
    if (comma != std::string_view::npos) {
      x = numberIn<double>(word.text.substr(0, comma));
      y = numberIn<double>(word.text.substr(comma + 1));
    }
    if (!x || !y) {
      const bool spaced = word.text.ends_with(',') || word.text.starts_with(',');
      fail(word.column, fmt::format("expected a point x,y, got '{}'{}", word.text,
                                    spaced ? " (no spaces around the comma)" : ""));
    }
    const auto sane = [](double v) { return std::abs(v) <= GraphLimits::kCoordinate; };
    if (!sane(*x) || !sane(*y)) {  // also true for what is not a number
      fail(word.column, fmt::format("expected finite coordinates of at most {:g}, got '{}'",
                                    GraphLimits::kCoordinate, word.text));
    }
    return {*x, *y};
  }

  std::uint32_t bodyOf(std::string_view name) {
    const auto next = static_cast<std::uint32_t>(graph_.bodies.size());
    const auto [at, added] = number_.try_emplace(std::string(name), next);
    if (added) {
      graph_.bodies.emplace_back(name);
      graph_.pinned.push_back(0);
    }
    return at->second;
  }

  /// A pinned body that touches nothing is often a mistyped one.
  void warnOfIdlePins() {
    std::vector<std::uint8_t> touches(graph_.bodies.size(), 0);
    for (const GraphPair& pair : graph_.pairs) touches[pair.a] = touches[pair.b] = 1;
    std::vector<std::string_view> others;
    for (std::size_t i = 0; i < touches.size(); ++i) {
      if (touches[i] != 0) others.push_back(graph_.bodies[i]);
    }
    for (const auto& [body, at] : pinned_at_) {
      if (std::exchange(touches[body], 1) != 0) continue;
      const std::string& name = graph_.bodies[body];
      graph_.warnings.push_back(fmt::format("{}:{}:{}: the pinned body '{}' touches nothing{}",
                                            source_.name(), at.first, at.second, name,
                                            didYouMean(name, others)));
    }
  }

  SourceText source_;
  std::uint32_t line_ = 0;
  ContactGraph graph_;
  std::unordered_map<std::string, std::uint32_t> number_;  ///< of a body, by its name
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> line_of_;
  std::vector<std::pair<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>>> pinned_at_;
};

}  // namespace

ContactGraph parseContactGraph(std::string_view text, const std::string& source) {
  return GraphReader(text, source).read();
}

}  // namespace merge2d
