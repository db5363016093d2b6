#include "src2d/scene/toml_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src2d/core/utf8.h"
#include "src2d/scene/rules.h"
#include "src2d/scene/settings_list.h"

namespace merge2d {
namespace {

/// How a value of a wrong type or size is shown: "the text \"3\"", "-1", "a table".
std::string shown(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) {
    return fmt::format("the text \"{}\"", beginning(*text, 40));
  }
  if (const auto number = node.value_exact<double>()) {
    return shownNumber(*number);
  }
  if (const auto integer = node.value_exact<std::int64_t>()) return fmt::format("{}", *integer);
  if (const auto truth = node.value_exact<bool>()) return *truth ? "true" : "false";
  if (const auto* array = node.as_array()) return fmt::format("a list of {}", array->size());
  return node.is_table() ? "a table" : "a date or time";
}

/// " (it belongs in [merging])", for a setting or a key of the whole scene in a wrong table.
std::string homeOf(std::string_view key) {
  constexpr std::array<std::string_view, 5> kTop{"title", "gravity", "step", "duration", "seed"};
  if (isAmong(key, kTop)) {
    return " (it belongs at the top, before the first [table])";
  }
  std::string homes;
  Settings settings;
  forEachSetting(settings, [&](std::string_view table, std::string_view setting, auto&, auto&) {
    if (setting == key) homes += fmt::format("{}[{}]", homes.empty() ? "" : " or ", table);
  });
  if (homes == "[material]") homes = "the [[body]], or for all bodies in [material]";
  return homes.empty() ? "" : fmt::format(" (it belongs in {})", homes);
}

/// A suggestion for an unknown key: one of those known or, where these are few, any of them.
std::string hintOf(std::string_view key, const std::vector<std::string_view>& known) {
  constexpr std::size_t kFew = 9;
  const std::string near = didYouMean(key, known);
  if (!near.empty() || known.size() > kFew) return near;
  return fmt::format(" (it may have '{}')", fmt::join(known, "', '"));
}

}  // namespace

double radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }

double degrees(double angle) {
  const double exact = angle * (180.0 / std::numbers::pi);
  const double neat = std::stod(fmt::format("{:.14g}", exact));
  if (radians(neat) == angle) return neat;
  for (const double towards : {-kForever, kForever}) {
    const double neighbour = std::nextafter(exact, towards);
    if (radians(exact) != angle && radians(neighbour) == angle) return neighbour;
  }
  return exact;
}

// Values

void Value::fail(std::string_view sentence) const { source_->fail(node_->source(), sentence); }

void Value::failMustBe(std::string_view what) const {
  fail(mustBe(key_, home_, what, shown(*node_)));
}

double Value::number(const Range& range) const {
  if (!node_->is_number()) failMustBe("a number");
  const auto* whole = node_->as_integer();
  const double number =
      whole != nullptr ? static_cast<double>(whole->get()) : node_->as_floating_point()->get();
  if (!std::isfinite(number) || std::abs(number) > kAnyNumber.upper) failMustBe(kAnyNumber.words);
  if (number < range.lower || number > range.upper) failMustBe(range.words);
  return number;
}

std::int64_t Value::integer(const Range& range) const {
  const auto integer = node_->value_exact<std::int64_t>();
  if (!integer) failMustBe("a whole number");
  const double number = static_cast<double>(*integer);
  if (number < range.lower || number > range.upper) failMustBe(range.words);
  return *integer;
}

bool Value::boolean() const {
  const auto truth = node_->value_exact<bool>();
  if (!truth) failMustBe("true or false");
  return *truth;
}

std::string Value::text() const {
  const auto text = node_->value_exact<std::string>();
  if (!text) failMustBe("a text in quotes");
  return *text;
}

Vec2 Value::vector(const Range& range, std::string_view form) const {
  const std::vector<Value> both = elements(form);
  if (both.size() != 2) failMustBe(form);
  return {both[0].number(range), both[1].number(range)};
}

std::vector<double> Value::numbers(std::size_t count, std::string_view form) const {
  const std::vector<Value> values = elements(form);
  if (values.size() != count) failMustBe(form);
  std::vector<double> result;
  for (const Value& value : values) result.push_back(value.number());
  return result;
}

std::vector<Value> Value::elements(std::string_view form) const {
  const toml::array* array = node_->as_array();
  if (array == nullptr) failMustBe(form);
  std::vector<Value> result;
  result.reserve(array->size());
  for (const toml::node& element : *array) {
    result.emplace_back(*source_, element, fmt::format("{}[{}]", key_, result.size()), home_);
  }
  return result;
}

TableReader Value::table(std::string_view form) const {
  const toml::table* table = node_->as_table();
  if (table == nullptr) failMustBe(form);
  return {*source_, *table, fmt::format("'{}' of {}", key_, home_)};
}

// Tables

std::optional<Value> TableReader::get(std::string_view key) {
  if (!isAmong(key, known_)) known_.push_back(key);
  const toml::node* node = table_->get(key);
  if (node == nullptr) return std::nullopt;
  return Value(*source_, *node, std::string(key), title_);
}

std::optional<Value> TableReader::require(std::string_view key) {
  auto value = get(key);
  if (!value) missing_.push_back(key);
  return value;
}

void TableReader::read(std::string_view key, double& value, const Range& range) {
  if (const auto found = get(key)) value = found->number(range);
}

void TableReader::read(std::string_view key, Vec2& value, const Range& range) {
  if (const auto found = get(key)) value = found->vector(range);
}

void TableReader::read(std::string_view key, bool& value, const Range&) {
  if (const auto found = get(key)) value = found->boolean();
}

void TableReader::read(std::string_view key, std::string& value) {
  if (const auto found = get(key)) value = found->text();
}

void TableReader::readDegrees(std::string_view key, double& value) {
  if (const auto found = get(key)) value = radians(found->number());
}

std::optional<TableReader> TableReader::table(std::string_view key) {
  const auto found = get(key);
  if (!found) return std::nullopt;
  const toml::table* table = table_->get(key)->as_table();
  if (table == nullptr) failAt(key, fmt::format("[{0}] must be one table, written [{0}]", key));
  return TableReader(*source_, *table, fmt::format("[{}]", key));
}

std::vector<TableReader> TableReader::tables(std::string_view key) {
  std::vector<TableReader> result;
  const auto found = get(key);
  if (!found) return result;
  const toml::array* array = table_->get(key)->as_array();
  const auto complain = [&] {
    failAt(key, fmt::format("each {0} must be a table of its own, written [[{0}]]", key));
  };
  if (array == nullptr) complain();
  for (const toml::node& element : *array) {
    if (!element.is_table()) complain();
    result.emplace_back(*source_, *element.as_table(), fmt::format("[[{}]]", key));
  }
  return result;
}

void TableReader::done() const {
  const toml::key* unknown = nullptr;
  const auto position = [](const toml::key& key) { return key.source().begin; };
  for (const auto& [key, node] : *table_) {
    if (isAmong(key.str(), known_)) continue;
    if (unknown == nullptr || position(key) < position(*unknown)) unknown = &key;
  }
  if (unknown != nullptr) {
    const std::string_view key = unknown->str();
    const std::string home = homeOf(key);
    source_->fail(unknown->source(), fmt::format("unknown key '{}' in {}{}", key, title_,
                                                 home.empty() ? hintOf(key, known_) : home));
  }
  if (!missing_.empty()) fail(fmt::format("{} needs the key '{}'", title_, missing_.front()));
}

std::string TableReader::whereIs(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return source_->place(node != nullptr ? node->source() : table_->source());
}

void TableReader::fail(std::string_view sentence) const {
  source_->fail(table_->source(), sentence);
}

void TableReader::failAt(std::string_view key, std::string_view sentence) const {
  if (!holds(key)) fail(sentence);
  source_->fail(table_->get(key)->source(), sentence);
}

}  // namespace merge2d
