#pragma once
/// Stands in for parts that the C++ library of Emscripten's compiler (libc++ 14) lacks of C++20:
/// the algorithms of std::ranges. Only scripts/build-web includes it.

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000
namespace std {
template <class To, class From>
To bit_cast(const From& from) noexcept {
  To to;
  std::memcpy(&to, &from, sizeof(To));
  return to;
}
/// strtod, which rounds correctly too, takes more than from_chars: blanks, a plus sign, 0x.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const std::string text(first, last);
  const bool plain =
      !text.empty() && text.find_first_not_of("0123456789.-eE+") != 0 && text[0] != '+';
  char* end = nullptr;
  const double read = plain ? std::strtod(text.c_str(), &end) : 0.0;
  if (!plain || end == text.c_str()) return {first, errc::invalid_argument};
  value = read;
  return {first + (end - text.c_str()), errc{}};
}
}  // namespace std
namespace std::ranges {
namespace shim {
template <class Projection>
auto through(Projection& p) {
  return [&p](auto&& x) -> decltype(auto) { return std::invoke(p, std::forward<decltype(x)>(x)); };
}
template <class Compare, class Projection>
auto comparing(Compare& c, Projection& p) {
  return [&](const auto& a, const auto& b) -> bool {
    return std::invoke(c, std::invoke(p, a), std::invoke(p, b));
  };
}
template <class Predicate, class Projection>
auto testing(Predicate& f, Projection& p) {
  return [&](auto&& x) -> bool { return std::invoke(f, std::invoke(p, x)); };
}
}  // namespace shim

#define MERGE2D_PREDICATE(NAME)                                        \
  template <class R, class F, class P = std::identity>                 \
  auto NAME(R&& r, F f, P p = {}) {                                    \
    return std::NAME(std::begin(r), std::end(r), shim::testing(f, p)); \
  }
MERGE2D_PREDICATE(all_of)
MERGE2D_PREDICATE(any_of)
MERGE2D_PREDICATE(none_of)
MERGE2D_PREDICATE(count_if)
MERGE2D_PREDICATE(find_if)
MERGE2D_PREDICATE(find_if_not)
MERGE2D_PREDICATE(partition)
MERGE2D_PREDICATE(stable_partition)
MERGE2D_PREDICATE(remove_if)
#undef MERGE2D_PREDICATE

#define MERGE2D_ORDER(NAME)                                                \
  template <class R, class C = std::ranges::less, class P = std::identity> \
  auto NAME(R&& r, C c = {}, P p = {}) {                                   \
    return std::NAME(std::begin(r), std::end(r), shim::comparing(c, p));   \
  }
MERGE2D_ORDER(sort)
MERGE2D_ORDER(stable_sort)
MERGE2D_ORDER(is_sorted)
MERGE2D_ORDER(max_element)
MERGE2D_ORDER(min_element)
#undef MERGE2D_ORDER

template <std::input_or_output_iterator I, class C = std::ranges::less, class P = std::identity>
void sort(I first, I last, C c = {}, P p = {}) {
  std::sort(first, last, shim::comparing(c, p));
}

template <class R, class T, class P = std::identity>
auto find(R&& r, const T& value, P p = {}) {
  return std::find_if(std::begin(r), std::end(r),
                      [&](auto&& x) { return std::invoke(p, x) == value; });
}
template <class R, class T, class P = std::identity>
auto count(R&& r, const T& value, P p = {}) {
  return std::count_if(std::begin(r), std::end(r),
                       [&](auto&& x) { return std::invoke(p, x) == value; });
}
template <class R, class T, class P = std::identity>
bool contains(R&& r, const T& value, P p = {}) {
  return std::ranges::find(r, value, p) != std::end(r);
}
template <class R, class T, class C = std::ranges::less, class P = std::identity>
auto lower_bound(R&& r, const T& value, C c = {}, P p = {}) {
  return std::lower_bound(
      std::begin(r), std::end(r), value,
      [&](const auto& x, const T& v) -> bool { return std::invoke(c, std::invoke(p, x), v); });
}
template <std::input_or_output_iterator I, class T, class C = std::ranges::less,
          class P = std::identity>
auto lower_bound(I first, I last, const T& value, C c = {}, P p = {}) {
  return std::lower_bound(first, last, value, [&](const auto& x, const T& v) -> bool {
    return std::invoke(c, std::invoke(p, x), v);
  });
}
template <class R, class T, class C = std::ranges::less, class P = std::identity>
auto upper_bound(R&& r, const T& value, C c = {}, P p = {}) {
  return std::upper_bound(
      std::begin(r), std::end(r), value,
      [&](const T& v, const auto& x) -> bool { return std::invoke(c, v, std::invoke(p, x)); });
}
template <class R, class T, class C = std::ranges::less, class P = std::identity>
bool binary_search(R&& r, const T& value, C c = {}, P p = {}) {
  const auto at = std::ranges::lower_bound(r, value, c, p);
  return at != std::end(r) && !std::invoke(c, value, std::invoke(p, *at));
}
template <class A, class B, class Out, class C = std::ranges::less, class P = std::identity,
          class Q = std::identity>
void set_symmetric_difference(A&& a, B&& b, Out out, C c = {}, P p = {}, Q = {}) {
  std::set_symmetric_difference(std::begin(a), std::end(a), std::begin(b), std::end(b), out,
                                shim::comparing(c, p));
}
template <class R, class T>
void fill(R&& r, const T& value) {
  std::fill(std::begin(r), std::end(r), value);
}
template <class R, class Out>
void copy(R&& r, Out out) {
  std::copy(std::begin(r), std::end(r), out);
}
template <class R, class Out, class F>
void transform(R&& r, Out out, F f) {
  std::transform(std::begin(r), std::end(r), out, [&](auto&& x) { return std::invoke(f, x); });
}
template <class R>
void reverse(R&& r) {
  std::reverse(std::begin(r), std::end(r));
}
template <class R, class I, class C = std::ranges::less, class P = std::identity>
void inplace_merge(R&& r, I middle, C c = {}, P p = {}) {
  std::inplace_merge(std::begin(r), middle, std::end(r), shim::comparing(c, p));
}
template <class A, class B, class C = std::ranges::equal_to>
bool equal(A&& a, B&& b, C c = {}) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b), c);
}
template <class R>
auto unique(R&& r) {
  struct Rest {
    decltype(std::begin(r)) first, last;
    auto begin() const { return first; }
    auto end() const { return last; }
  };
  return Rest{std::unique(std::begin(r), std::end(r)), std::end(r)};
}
}  // namespace std::ranges
#endif
