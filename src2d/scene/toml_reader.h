#pragma once
/// Typed reading of TOML: each value knows its name and place, each table the keys that were asked
/// for, so that whatever is left over is a mistake with a place and a suggestion.

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src2d/core/suggest.h"
#include "src2d/core/vec.h"
#include "src2d/scene/names.h"
#include "src2d/scene/range.h"
#include "src2d/scene/source_text.h"

namespace merge2d {

class TableReader;

/// One value of a scene file.
class Value {
 public:
  /// `key` and `home` name it in messages: 'mass' in [[body]].
  Value(const SourceText& source, const toml::node& node, std::string key, std::string home)
      : source_(&source), node_(&node), key_(std::move(key)), home_(std::move(home)) {}

  double number(const Range& range = kAnyNumber) const;
  std::int64_t integer(const Range& range) const;
  bool boolean() const;
  std::string text() const;
  /// Two numbers, each within the range; `form` tells what they are: "[width, height]".
  Vec2 vector(const Range& range = kAnyNumber, std::string_view form = "[x, y]") const;
  /// `count` numbers; `form` tells how they should look: "[from, until]".
  std::vector<double> numbers(std::size_t count, std::string_view form) const;
  /// The values of an array; `form` tells how it should look.
  std::vector<Value> elements(std::string_view form) const;
  /// `form` tells what it should look like.
  TableReader table(std::string_view form = "a table { … }") const;
  template <HasNames E>
  E named() const;

  /// Throws an InputError at this value.
  [[noreturn]] void fail(std::string_view sentence) const;
  /// The same with the sentence "'mass' in [[body]] must be …, but is …".
  [[noreturn]] void failMustBe(std::string_view what) const;

 private:
  const SourceText* source_;
  const toml::node* node_;
  std::string key_;
  std::string home_;
};

/// One table of a scene file. A key counts as known once it was asked for; after the last question
/// `done` reports what is unknown first, then what is missing.
class TableReader {
 public:
  /// `title` names the table in messages: "[[body]]".
  TableReader(const SourceText& source, const toml::table& table, std::string title)
      : source_(&source), table_(&table), title_(std::move(title)) {}

  std::optional<Value> get(std::string_view key);
  bool has(std::string_view key) { return get(key).has_value(); }
  /// Like `has`, but does not ask for the key: to be used in messages.
  bool holds(std::string_view key) const { return table_->contains(key); }
  /// Like `get`, but the key must be there; `done` complains if it is not.
  std::optional<Value> require(std::string_view key);

  /// Each leaves `value` alone when the key is absent.
  void read(std::string_view key, double& value, const Range& range = kAnyNumber);
  void read(std::string_view key, Vec2& value, const Range& range = kAnyNumber);
  void read(std::string_view key, bool& value, const Range& = kAnyNumber);
  void read(std::string_view key, std::string& value);
  template <std::integral I>
  void read(std::string_view key, I& value, const Range& range);
  template <HasNames E>
  void read(std::string_view key, E& value, const Range& = kAnyNumber);
  /// Degrees in the file, radians (or radians per second) in `value`.
  void readDegrees(std::string_view key, double& value);

  /// A table inside this one.
  std::optional<TableReader> table(std::string_view key);
  /// The tables of an array of tables `[[key]]`; none when it is absent.
  std::vector<TableReader> tables(std::string_view key);

  /// Throws the InputError of the first unknown key, else of the first missing one.
  void done() const;

  /// Where the key is, or else the table, for messages about another place: "line 12".
  std::string whereIs(std::string_view key) const;

  /// Throws an InputError at the table, or at the value of one of its keys where it has that.
  [[noreturn]] void fail(std::string_view sentence) const;
  [[noreturn]] void failAt(std::string_view key, std::string_view sentence) const;
  const std::string& title() const { return title_; }

 private:
  const SourceText* source_;
  const toml::table* table_;
  std::string title_;
  std::vector<std::string_view> known_;
  std::vector<std::string_view> missing_;
};

double radians(double degrees);
/// The degrees, as short as may be, that `radians` turns into `angle` again (at worst within one
/// unit in the last place: some angles are not hit by any number of degrees).
double degrees(double angle);

/// "one of "off", "triangle", "rigid"".
template <HasNames E>
std::string choiceOf() {
  std::string choice;
  for (const std::string_view name : namesOf<E>()) {
    choice += (choice.empty() ? "one of \"" : ", \"") + std::string(name) + "\"";
  }
  return choice;
}

template <HasNames E>
E Value::named() const {
  const std::string word = text();
  if (const auto value = valueOf<E>(word)) return *value;
  fail("'" + key_ + "' in " + home_ + " must be " + choiceOf<E>() + ", but is \"" + word + "\"" +
       didYouMean(word, namesOf<E>()));
}

template <std::integral I>
void TableReader::read(std::string_view key, I& value, const Range& range) {
  if (const auto found = get(key)) value = static_cast<I>(found->integer(range));
}

template <HasNames E>
void TableReader::read(std::string_view key, E& value, const Range&) {
  if (const auto found = get(key)) value = found->template named<E>();
}

}  // namespace merge2d
