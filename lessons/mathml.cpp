#include "lessons/mathml.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "lessons/page.h"

namespace merge2d {
namespace {

struct Command {
  std::string_view name, shown;
  bool letter;
};

constexpr std::array<Command, 37> kCommands = {{
    {"alpha", "α", true},      {"beta", "β", true},    {"gamma", "γ", true},
    {"delta", "δ", true},      {"Delta", "Δ", true},   {"epsilon", "ε", true},
    {"varepsilon", "ε", true}, {"eta", "η", true},     {"theta", "θ", true},
    {"lambda", "λ", true},     {"mu", "μ", true},      {"nu", "ν", true},
    {"pi", "π", true},         {"rho", "ρ", true},     {"sigma", "σ", true},
    {"tau", "τ", true},        {"phi", "φ", true},     {"omega", "ω", true},
    {"Omega", "Ω", true},      {"infty", "∞", true},   {"cdot", "·", false},
    {"times", "×", false},     {"le", "≤", false},     {"leq", "≤", false},
    {"ge", "≥", false},        {"geq", "≥", false},    {"ne", "≠", false},
    {"neq", "≠", false},       {"perp", "⊥", false},   {"pm", "±", false},
    {"to", "→", false},        {"approx", "≈", false}, {"sum", "∑", false},
    {"sin", "sin", true},      {"cos", "cos", true},   {"tan", "tan", true},
    {"quad", "\u2003", false},
}};

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool isLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// Reads a formula from left to right. Every step of it goes forward, so that any text ends.
class MathReader {
 public:
  explicit MathReader(std::string_view text) : text_(text) {}

  /// All up to the end, or to the brace that closes the group.
  std::string row() {
    std::string out = "<mrow>";
    while (!text_.empty() && text_.front() != '}') out += scripted();
    if (!text_.empty()) text_.remove_prefix(1);
    return out + "</mrow>";
  }
  bool atEnd() const { return text_.empty(); }

 private:
  /// An atom with its superscript and subscript.
  std::string scripted() {
    std::string base = atom();
    std::string below, above;
    while (!text_.empty() && (text_.front() == '_' || text_.front() == '^')) {
      std::string& part = text_.front() == '_' ? below : above;
      text_.remove_prefix(1);
      part = atom();
    }
    if (!below.empty() && !above.empty()) {
      return fmt::format("<msubsup>{}{}{}</msubsup>", base, below, above);
    }
    if (!below.empty()) return fmt::format("<msub>{}{}</msub>", base, below);
    if (!above.empty()) return fmt::format("<msup>{}{}</msup>", base, above);
    return base;
  }

  std::string atom() {
    skipSpaces();
    if (text_.empty()) return "<mrow></mrow>";
    if (depth_ >= kDeepest) {
      text_.remove_prefix(lengthOfCharacter());
      return "<mrow></mrow>";
    }
    ++depth_;
    std::string out = oneAtom();
    --depth_;
    return out;
  }

  std::string oneAtom() {
    const char first = text_.front();
    if (first == '{') return group();
    if (first == '\\') return command();
    if (isDigit(first)) return number();
    const std::string_view one = text_.substr(0, lengthOfCharacter());
    text_.remove_prefix(one.size());
    if (first == '-') return "<mo>−</mo>";
    // Beyond ASCII only letters, as λ; all else is an operator.
    const bool letter = isLetter(first) || one.size() > 1;
    return fmt::format("<{0}>{1}</{0}>", letter ? "mi" : "mo", escapedHtml(one));
  }

  std::string group() {
    text_.remove_prefix(1);
    return row();
  }

  std::string number() {
    std::size_t end = 0;
    while (end < text_.size() &&
           (isDigit(text_[end]) ||
            (text_[end] == '.' && end + 1 < text_.size() && isDigit(text_[end + 1])))) {
      ++end;
    }
    const std::string_view digits = text_.substr(0, end);
    text_.remove_prefix(end);
    return fmt::format("<mn>{}</mn>", digits);
  }

  std::string command() {
    text_.remove_prefix(1);
    std::size_t end = 0;
    while (end < text_.size() && isLetter(text_[end])) ++end;
    if (end == 0) {  // "\," and the like: a space
      if (!text_.empty()) text_.remove_prefix(lengthOfCharacter());
      return "<mspace width=\"0.2em\"/>";
    }
    const std::string_view name = text_.substr(0, end);
    text_.remove_prefix(end);
    if (name == "frac") {
      const std::string top = atom();
      return fmt::format("<mfrac>{}{}</mfrac>", top, atom());
    }
    if (name == "sqrt") return fmt::format("<msqrt>{}</msqrt>", atom());
    if (name == "text") return words();
    const auto* found = std::find_if(kCommands.begin(), kCommands.end(),
                                     [&](const Command& c) { return c.name == name; });
    if (found == kCommands.end()) return fmt::format("<mi>{}</mi>", name);
    return fmt::format("<{0}>{1}</{0}>", found->letter ? "mi" : "mo", found->shown);
  }

  /// \text{kg}: upright, with its spaces.
  std::string words() {
    if (text_.empty() || text_.front() != '{') return atom();
    const std::size_t end = std::min(text_.find('}'), text_.size());
    const std::string_view inside = text_.substr(1, end - 1);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    return fmt::format("<mtext>{}</mtext>", escapedHtml(inside));
  }

  void skipSpaces() {
    while (!text_.empty() && (text_.front() == ' ' || text_.front() == '\n')) {
      text_.remove_prefix(1);
    }
  }
  /// Of one character in UTF-8.
  std::size_t lengthOfCharacter() const {
    std::size_t length = 1;
    while (length < text_.size() && (static_cast<unsigned char>(text_[length]) & 0xC0U) == 0x80U) {
      ++length;
    }
    return length;
  }

  static constexpr int kDeepest = 64;  ///< of groups and commands in each other

  std::string_view text_;
  int depth_ = 0;
};

}  // namespace

std::string mathMl(std::string_view latex) {
  MathReader reader(latex);
  std::string out = "<math>";
  while (!reader.atEnd()) out += reader.row();
  return out + "</math>";
}

}  // namespace merge2d
