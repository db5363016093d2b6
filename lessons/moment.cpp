#include "lessons/moment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "lessons/body_named.h"
#include "src2d/core/suggest.h"

namespace merge2d {

struct Moment::Event {
  std::string kind;
  int ordinal = 1;  ///< 0: the last one
  std::optional<BodyId> a, b;
  std::string reason;

  bool matches(const merge2d::Event& event) const {
    if (kind != name(event.type)) return false;
    if (!reason.empty() && reason != name(event.reason)) return false;
    const auto involves = [&](BodyId body) { return event.a == body || event.b == body; };
    return (!a || involves(*a)) && (!b || involves(*b));
  }
};

namespace {

constexpr std::array<std::string_view, 9> kKinds = {"merge", "unmerge", "sleep", "wake",   "impact",
                                                    "emit",  "break",   "union", "parting"};
constexpr std::array<std::string_view, 4> kReasons = {"broken", "sliding", "relative-motion",
                                                      "user"};
constexpr std::array<std::string_view, 8> kOrdinals = {"last",   "first", "second", "third",
                                                       "fourth", "fifth", "sixth",  "seventh"};

std::optional<double> toNumber(const std::string& word) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return {};
  return value;
}

bool share(const Recording& r, BodyId a, BodyId b, std::int64_t step) {
  const CollectionId c = r.collection(a, step);
  return c != kNoCollection && c == r.collection(b, step);
}

}  // namespace

/// Reads a moment word by word.
struct Moment::Parser {
  Parser(const Value& at, const Scene& of) : place(at), scene(of) {
    std::istringstream in(at.text());
    for (std::string word; in >> word;) words.push_back(word);
  }

  const Value& place;
  const Scene& scene;
  std::vector<std::string> words;
  std::size_t next = 0;

  bool done() const { return next >= words.size(); }
  std::string peek(std::size_t ahead = 0) const {
    return next + ahead < words.size() ? words[next + ahead] : std::string();
  }
  std::string take() { return done() ? std::string() : words[next++]; }
  bool accept(std::string_view word) {
    if (peek() != word) return false;
    ++next;
    return true;
  }

  [[noreturn]] void fail(const std::string& sentence) const {
    place.fail(sentence +
               "; a moment is for example \"start\", \"step 120\", \"2.5 s\", \"first merge\", \"3 "
               "steps before first unmerge of a and b\", \"last sleep\"");
  }

  double takeNumber() {
    const std::string word = take();
    if (const auto value = toNumber(word)) return *value;
    fail(word.empty() ? "a number is missing" : fmt::format("'{}' is no number", word));
  }

  BodyId takeName() { return bodyNamed(place, scene, take()); }

  void readShift(Moment& out) {
    if (!toNumber(peek()) || (peek(2) != "before" && peek(2) != "after")) return;
    const double amount = takeNumber();
    const std::string unit = take();
    if (unit != "s" && unit != "step" && unit != "steps") {
      fail(fmt::format("'{}' is neither 's' nor 'steps'", unit));
    }
    out.shift_steps_ = unit != "s";
    out.shift_ = take() == "before" ? -amount : amount;
  }

  Event readEvent() {
    Event event;
    const auto at = std::find(kOrdinals.begin(), kOrdinals.end(), peek());
    if (at != kOrdinals.end()) {
      event.ordinal = static_cast<int>(at - kOrdinals.begin());
      ++next;
    }
    event.kind = take();
    if (!isAmong(event.kind, kKinds)) {
      fail(event.kind.empty() ? "the name of an event is missing"
                              : fmt::format("'{}' is no moment and no event{}", event.kind,
                                            didYouMean(event.kind, kKinds)));
    }
    if (accept("of")) {
      event.a = takeName();
      if (accept("and")) event.b = takeName();
    }
    if ((event.kind == "union" || event.kind == "parting") && !event.b) {
      fail(fmt::format("'{0}' needs two bodies: \"{0} of a and b\"", event.kind));
    }
    if (accept("by")) {
      event.reason = take();
      if (!isAmong(event.reason, kReasons)) {
        fail(fmt::format("'{}' is no reason{}", event.reason, didYouMean(event.reason, kReasons)));
      }
    }
    return event;
  }

  Moment read() {
    Moment out(place, place.text());
    readShift(out);
    if (accept("start")) {
      out.base_ = Base::Start;
    } else if (accept("end")) {
      out.base_ = Base::End;
    } else if (accept("step")) {
      out.base_ = Base::Step;
      out.number_ = takeNumber();
    } else if (toNumber(peek())) {
      out.base_ = Base::Seconds;
      out.number_ = takeNumber();
      if (!accept("s")) fail("after a number stands its unit, 's'");
    } else {
      out.base_ = Base::Event;
      out.event_ = std::make_shared<Event>(readEvent());
      if (accept("after")) out.after_ = std::make_shared<Moment>(read());
    }
    return out;
  }
};

Moment::Moment(const Value& place, std::string text) : place_(place), text_(std::move(text)) {}

Moment::Moment(const Value& place, const Scene& scene) : place_(place), text_(place.text()) {
  Parser parser(place, scene);
  *this = parser.read();
  if (!parser.done()) parser.fail(fmt::format("'{}' is too much", parser.peek()));
}

std::optional<Found> Moment::find(const Recording& r) const {
  Found out;
  if (base_ == Base::End) {
    out.step = r.steps;
  } else if (base_ == Base::Step) {
    out.step = static_cast<std::int64_t>(number_);
  } else if (base_ == Base::Seconds) {
    out.step = std::llround(number_ / r.scene.step);
  } else if (base_ == Base::Event) {
    // What follows from another event may happen in the same step; a second one of the same kind
    // comes later.
    std::int64_t from = 0;
    if (after_) {
      const auto before = after_->find(r);
      if (!before) return std::nullopt;
      const bool same = after_->event_ && after_->event_->kind == event_->kind;
      from = before->step - (same ? 0 : 1);
    }
    std::vector<Found> all;
    if (event_->kind == "union" || event_->kind == "parting") {
      const bool now = event_->kind == "union";
      for (std::int64_t step = from + 1; step <= r.steps; ++step) {
        if (share(r, *event_->a, *event_->b, step) == now &&
            share(r, *event_->a, *event_->b, step - 1) != now) {
          all.push_back({step, std::nullopt});
        }
      }
    } else {
      for (const TimedEvent& e : r.events) {
        if ((e.step > from || !after_) && event_->matches(e.event))
          all.push_back({e.step, e.event});
      }
    }
    const auto wanted = static_cast<std::size_t>(event_->ordinal);
    if (all.empty() || all.size() < wanted) return std::nullopt;
    out = wanted == 0 ? all.back() : all[wanted - 1];
  }
  out.step += shift_steps_ ? std::llround(shift_) : std::llround(shift_ / r.scene.step);
  if (out.step < 0 || out.step > r.steps) return std::nullopt;
  return out;
}

Found Moment::in(const Recording& r) const {
  if (const auto found = find(r)) return *found;
  place_.fail(fmt::format("'{}' does not happen within the {} s that are simulated", text_,
                          static_cast<double>(r.steps) * r.scene.step));
}

}  // namespace merge2d
