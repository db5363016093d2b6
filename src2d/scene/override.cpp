#include "src2d/scene/override.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "src2d/core/error.h"
#include "src2d/core/suggest.h"
#include "src2d/scene/toml_parse.h"

namespace merge2d {
namespace {

/// The table a key such as `body.platform.mass` starts from, and what is left of the key.
struct Target {
  toml::table* table;
  std::string_view key;
};

[[noreturn]] void fail(const std::string& place, std::string_view sentence) {
  throw InputError(fmt::format("{}: {}", place, sentence));
}

std::string_view elementName(toml::node& element) {
  const auto* table = element.as_table();
  const auto* name = table != nullptr ? table->get_as<std::string>("name") : nullptr;
  return name != nullptr ? std::string_view(name->get()) : std::string_view();
}

toml::table* tableAt(toml::array& array, std::size_t i) {
  return i < array.size() ? array[i].as_table() : nullptr;
}

[[noreturn]] void failForm(const std::string& place, std::string_view kind) {
  fail(place, fmt::format("write {0}[3].key or {0}.NAME.key", kind));
}

/// " (a number stands in brackets: body[1].mass)" for `1.mass` after `body.`.
std::string bracketsHint(std::string_view kind, std::string_view word, std::string_view rest) {
  const bool number =
      !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
  if (!number) return "";
  return fmt::format(" (a number stands in brackets: {}[{}]{})", kind, word, rest);
}

/// " (it is a copy of 'brick'; all have one description: body.brick.mass)" for `brick[0,1].mass`.
std::string copiesHint(std::string_view kind, std::string_view word, std::string_view rest,
                       const std::vector<std::string_view>& names) {
  const std::string_view stem = word.substr(0, word.find('['));
  if (stem == word || !isAmong(stem, names)) return "";
  return fmt::format(" (it is a copy of '{0}'; all have one description: {1}.{0}{2})", stem, kind,
                     rest);
}

/// `[3].mass` after `body`.
Target byNumber(toml::array& array, std::string_view rest, std::string_view kind,
                const std::string& place) {
  const std::size_t close = rest.find(']');
  const std::string digits(rest.substr(1, close == std::string_view::npos ? 0 : close - 1));
  const bool well_formed = !digits.empty() && digits.size() < 9 &&
                           std::all_of(digits.begin(), digits.end(), ::isdigit) &&
                           rest.substr(close + 1).starts_with('.');
  if (!well_formed) failForm(place, kind);
  toml::table* table = tableAt(array, std::stoul(digits));
  if (table == nullptr) {
    fail(place, fmt::format("there is no {}[{}]; the scene has {} of them, numbered from 0", kind,
                            digits, array.size()));
  }
  return {table, rest.substr(close + 2)};
}

/// `.platform.mass` after `body`; names may contain dots, so the longest that fits is meant.
Target byName(toml::array& array, std::string_view rest, std::string_view kind,
              const std::string& place) {
  rest.remove_prefix(1);
  std::vector<std::string_view> names;
  toml::table* best = nullptr;
  std::size_t length = 0;
  for (toml::node& element : array) {
    const std::string_view name = elementName(element);
    if (name.empty()) continue;
    names.push_back(name);
    const bool meant = rest.starts_with(name) && rest.substr(name.size()).starts_with('.');
    if (meant && name.size() > length) {
      best = element.as_table();
      length = name.size();
    }
  }
  if (best == nullptr) {
    const std::size_t dot = rest.find('.');
    if (dot == std::string_view::npos) failForm(place, kind);
    const std::string_view word = rest.substr(0, dot);
    std::string hint = bracketsHint(kind, word, rest.substr(dot));
    if (hint.empty()) hint = copiesHint(kind, word, rest.substr(dot), names);
    fail(place, fmt::format("no {} is called '{}'{}", kind, word,
                            hint.empty() ? didYouMean(word, names) : hint));
  }
  return {best, rest.substr(length + 1)};
}

Target locate(toml::table& scene, std::string_view key, const std::string& place) {
  const std::size_t end = std::min(key.find_first_of(".["), key.size());
  const std::string_view kind = key.substr(0, end);
  const std::string_view rest = key.substr(end);
  toml::array* array = scene.get_as<toml::array>(kind);
  const bool tables = array != nullptr && !array->empty() && array->front().is_table();
  if (rest.starts_with('[')) {
    if (!tables) fail(place, fmt::format("the scene has no [[{}]]", kind));
    return byNumber(*array, rest, kind, place);
  }
  if (rest.starts_with('.') && tables) return byName(*array, rest, kind, place);
  return {&scene, key};
}

bool isDottedKey(std::string_view key) {
  const auto allowed = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
  };
  return !key.empty() && std::all_of(key.begin(), key.end(), allowed) && !key.starts_with('.') &&
         !key.ends_with('.') && key.find("..") == std::string_view::npos;
}

/// A text as TOML has it.
std::string tomlText(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

/// The table `key = value`; a bare word is a text, and so is any title.
toml::table parseAssignment(std::string_view key, const std::string& value,
                            const std::string& place) {
  const auto parse = [&](std::string_view written) {
    const std::string text = fmt::format("{} = {}", key, written);
    return parseToml(SourceText(place, text));
  };
  if (value.find_first_of("\n\r") != std::string::npos) fail(place, "a value is one line");
  const bool in_quotes = value.starts_with('"') || value.starts_with('\'');
  if (key == "title" && !in_quotes) return parse(tomlText(value));
  try {
    return parse(value);
  } catch (const InputError&) {
    const bool word = !value.empty() && std::isalpha(static_cast<unsigned char>(value[0])) != 0 &&
                      value.find_first_of("\"\\[]{}") == std::string::npos;
    if (word) return parse(tomlText(value));
  }
  fail(place, fmt::format("'{}' is not a number, true or false, \"a text\" or [a, list]", value));
}

/// Moves what is in `from` into `to`; values keep their place.
void merge(toml::table& to, toml::table&& from) {
  for (auto&& [key, node] : from) {
    toml::table* old = to.get_as<toml::table>(key.str());
    if (old != nullptr && node.is_table()) {
      merge(*old, std::move(*node.as_table()));
    } else {
      node.visit([&, &k = key](auto& concrete) { to.insert_or_assign(k, std::move(concrete)); });
    }
  }
}

}  // namespace

void applyOverride(toml::table& scene, const std::string& key, const std::string& value) {
  const std::string place = fmt::format("--set {}={}", key, value);
  const Target target = locate(scene, key, place);
  if (!isDottedKey(target.key)) {
    fail(place, fmt::format("'{}' is not a key such as merging.velocity", target.key));
  }
  merge(*target.table, parseAssignment(target.key, value, place));
}

}  // namespace merge2d
