#pragma once
/// Archives of a saved state: one writes its fields as bytes, one reads them, one lists their
/// kinds.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "src2d/core/error.h"
#include "src2d/state_fields.h"

namespace merge2d {

template <class T>
concept PlainField = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// An archive that goes through values down to their plain fields, which `Sink` takes by `plain`,
/// as it takes lists by `list`.
template <class Sink>
class StateWalk {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }

 private:
  Sink& sink() { return static_cast<Sink&>(*this); }

  template <class T>
  void put(const T& value) {
    if constexpr (PlainField<T>) {
      sink().plain(value);
    } else {
      fields(sink(), value);
    }
  }
  void put(const Vec2& v) { (*this)(v.x(), v.y()); }
  void put(const Eigen::Matrix3d& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) put(m(i));
  }
  template <class A, class B>
  void put(const std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class T, std::size_t n>
  void put(const std::array<T, n>& array) {
    for (const T& item : array) put(item);
  }
  template <class T, std::size_t n>
  void put(const T (&array)[n]) {
    for (const T& item : array) put(item);
  }
  template <class T>
  void put(const std::vector<T>& list) {
    sink().list(list);
  }
  void put(const std::string& text) { put(std::vector<char>(text.begin(), text.end())); }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value ? std::vector<T>{*value} : std::vector<T>{});
  }
  void put(const ConvexShape& shape) {
    const auto* circle = std::get_if<Circle>(&shape);
    (*this)(circle != nullptr, circle ? *circle : Circle{},
            circle ? Polygon{} : std::get<Polygon>(shape));
  }
};

/// Writes values as bytes.
class StateWriter : public StateWalk<StateWriter> {
 public:
  template <class T>
  void plain(const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void list(const std::vector<T>& items) {
    plain(static_cast<std::uint64_t>(items.size()));
    for (const T& item : items) (*this)(item);
  }
  std::string bytes;
};

/// Writes down which fields there are, in order, with their kinds and sizes.
class StateSignature : public StateWalk<StateSignature> {
 public:
  template <class T>
  void plain(const T& value) {
    text += std::is_floating_point_v<T> ? 'f' : std::is_enum_v<T> ? 'e' : 'i';
    text += static_cast<char>('0' + sizeof value);
  }
  template <class T>
  void list(const std::vector<T>&) {
    text += '[';
    (*this)(T{});
    text += ']';
  }
  std::string text;
};

/// The last of an enumeration that is none of numbers.
template <class E>
inline constexpr std::optional<E> kLastValueOf = std::nullopt;
template <>
inline constexpr std::optional<Motion> kLastValueOf<Motion> = Motion::Scripted;
template <>
inline constexpr std::optional<Mode> kLastValueOf<Mode> = Mode::MergeSleep;
template <>
inline constexpr std::optional<JointKind> kLastValueOf<JointKind> = JointKind::Prismatic;
template <>
inline constexpr std::optional<EventReason> kLastValueOf<EventReason> = EventReason::User;

/// How many bytes a value takes whose lists are empty.
template <class T>
std::size_t leastStateBytes() {
  static const std::size_t bytes = [] {
    StateWriter write;
    write(T{});
    return write.bytes.size();
  }();
  return bytes;
}

/// The counterpart of StateWriter; throws InputError at the end of the bytes, and for values that
/// no field can have.
class StateReader {
 public:
  StateReader(std::string_view bytes, const std::string& source) : rest_(bytes), source_(source) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  std::size_t rest() const { return rest_.size(); }
  [[noreturn]] void fail(std::string_view sentence) const {
    throw InputError(fmt::format("{}: {}", source_, sentence));
  }

 private:
  template <class T>
  void get(T& value) {
    if constexpr (PlainField<T>) {
      std::array<char, sizeof value> bytes{};
      if (rest_.size() < bytes.size()) fail("the snapshot is incomplete");
      std::memcpy(bytes.data(), rest_.data(), bytes.size());
      rest_.remove_prefix(bytes.size());
      if (!couldBe<T>(bytes)) fail("the snapshot is damaged: it has an impossible value");
      std::memcpy(&value, bytes.data(), bytes.size());
    } else {
      fields(*this, value);
    }
  }
  template <class T>
  static bool couldBe(const std::array<char, sizeof(T)>& bytes) {
    if constexpr (std::is_same_v<T, bool>) {
      return bytes[0] == 0 || bytes[0] == 1;
    } else if constexpr (std::is_floating_point_v<T>) {
      return !std::isnan(std::bit_cast<T>(bytes));
    } else if constexpr (std::is_enum_v<T>) {
      return !kLastValueOf<T> || (std::bit_cast<std::underlying_type_t<T>>(bytes) >= 0 &&
                                  std::bit_cast<std::underlying_type_t<T>>(bytes) <=
                                      static_cast<std::underlying_type_t<T>>(*kLastValueOf<T>));
    }
    return true;
  }
  void get(Vec2& v) { (*this)(v.x(), v.y()); }
  void get(Eigen::Matrix3d& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) get(m(i));
  }
  template <class A, class B>
  void get(std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class T, std::size_t n>
  void get(std::array<T, n>& array) {
    for (T& item : array) get(item);
  }
  template <class T, std::size_t n>
  void get(T (&array)[n]) {
    for (T& item : array) get(item);
  }
  void get(std::string& text) {
    std::vector<char> letters;
    get(letters);
    text.assign(letters.begin(), letters.end());
  }
  template <class T>
  void get(std::optional<T>& value) {
    std::vector<T> list;
    get(list);
    value = list.empty() ? std::nullopt : std::optional<T>(list.front());
  }
  void get(ConvexShape& shape) {
    bool is_circle = false;
    Circle circle;
    Polygon polygon;
    (*this)(is_circle, circle, polygon);
    shape = is_circle ? ConvexShape(circle) : ConvexShape(polygon);
  }
  template <class T>
  void get(std::vector<T>& list) {
    std::uint64_t size = 0;
    get(size);
    if (size > rest_.size() / std::max<std::size_t>(1, leastStateBytes<T>())) {
      fail("the snapshot is damaged: it ends within a list");
    }
    list.resize(size);
    for (T& item : list) get(item);
  }

  std::string_view rest_;
  const std::string& source_;
};

}  // namespace merge2d
