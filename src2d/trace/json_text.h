#pragma once
/// JSON that is written from its beginning to its end: fast, and the same bytes everywhere.

#include <fmt/format.h>

#include <concepts>
#include <string>
#include <string_view>

#include "src2d/core/ids.h"
#include "src2d/core/vec.h"

namespace merge2d {

/// Puts the commas by itself. Numbers get the fewest digits that give the same number again; one
/// that is not finite becomes null. Text that is not UTF-8 becomes "�" there.
class JsonText {
 public:
  JsonText& open(char bracket);
  JsonText& close(char bracket);
  JsonText& key(std::string_view name);

  JsonText& value(std::string_view text);
  JsonText& value(const char* text) { return value(std::string_view(text)); }
  JsonText& value(double number);
  JsonText& value(bool truth) { return raw(truth ? "true" : "false"); }
  JsonText& value(std::nullptr_t) { return raw("null"); }
  JsonText& value(BodyId id) { return value(merge2d::index(id)); }
  JsonText& value(CollectionId id) { return value(merge2d::value(id)); }
  JsonText& value(const Vec2& v) { return row(v.x(), v.y()); }
  template <std::integral I>
  JsonText& value(I number) {
    const fmt::format_int digits(number);
    return raw({digits.data(), digits.size()});
  }

  template <class T>
  JsonText& field(std::string_view name, const T& v) {
    return key(name).value(v);
  }

  /// [a,b,…]
  template <class... Values>
  JsonText& row(const Values&... values) {
    open('[');
    (value(values), ...);
    return close(']');
  }

  /// An array of what `one` writes for each of `items`.
  template <class Items, class F>
  JsonText& array(std::string_view name, const Items& items, F&& one) {
    key(name).open('[');
    for (const auto& item : items) one(item);
    return close(']');
  }

  /// A value that is JSON already.
  JsonText& raw(std::string_view json);

  /// Ends a line of JSON Lines.
  JsonText& endLine();

  std::string_view text() const { return {buffer_.data(), buffer_.size()}; }
  void clear();

 private:
  void put(std::string_view text) { buffer_.append(text.data(), text.data() + text.size()); }
  void putSeparator();

  fmt::memory_buffer buffer_;
  bool comma_ = false;  ///< a value stands right before
};

}  // namespace merge2d
