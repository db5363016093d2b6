#pragma once
/// Times that a lesson names by what happens: "first unmerge of a and b after first impact". They
/// stay right when the engine's numbers move a little.
///
///   moment = [ N steps before | N steps after | T s before | T s after ] point
///   point  = start | end | step N | T s | [first | second | … | last] event
///   event  = kind [ of NAME [ and NAME ] ] [ by REASON ] [ after moment ]
///   kind   = merge | unmerge | sleep | wake | impact | emit: as in the trace
///          | union | parting: two bodies come into one collection, or no longer share one

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lessons/recording.h"
#include "src2d/scene/toml_reader.h"

namespace merge2d {

/// A moment in a recording: a step, and the event that was found there, if any.
struct Found {
  std::int64_t step = 0;
  std::optional<Event> event;
};

class Moment {
 public:
  /// Reads and checks the text; body names must be those of `scene`. Throws an InputError at
  /// `place`.
  Moment(const Value& place, const Scene& scene);

  /// Nothing when it does not happen.
  std::optional<Found> find(const Recording& recording) const;
  /// Throws an InputError at the place when it does not happen.
  Found in(const Recording& recording) const;

  const std::string& text() const { return text_; }
  const Value& place() const { return place_; }

 private:
  struct Event;
  struct Parser;

  Value place_;
  std::string text_;
  double shift_ = 0.0;        ///< later by so much
  bool shift_steps_ = false;  ///< counted in steps, not seconds
  enum class Base { Start, End, Step, Seconds, Event } base_ = Base::Start;
  double number_ = 0.0;
  std::shared_ptr<const Event> event_;
  std::shared_ptr<const Moment> after_;

  Moment(const Value& place, std::string text);
};

}  // namespace merge2d
