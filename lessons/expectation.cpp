#include "lessons/expectation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>

#include "lessons/body_named.h"
#include "src2d/core/error.h"
#include "src2d/core/suggest.h"

namespace merge2d {
namespace {

constexpr std::array<std::string_view, 6> kOfAll = {"collections", "simulated", "contacts",
                                                    "inside",      "asleep",    "kinetic-energy"};
constexpr std::array<std::string_view, 5> kOfBody = {"x", "y", "angle", "speed", "spin"};
constexpr std::array<std::string_view, 4> kOfPair = {"force", "friction", "gap", "points"};

double degreesOf(double radians) { return radians * 180.0 / std::numbers::pi; }

/// Whether a collection is welded to a body that does not respond to forces.
bool holds(const Recording& r, BodyId fixed, CollectionId collection, std::int64_t step) {
  return std::ranges::any_of(r.contacts, [&](const ContactTrack& c) {
    if (c.a != fixed && c.b != fixed) return false;
    const auto i = r.sampleAt(c.spans, step);
    return i && c.internal[*i] != 0 && r.collection(c.a == fixed ? c.b : c.a, step) == collection;
  });
}

}  // namespace

Quantity::Quantity(const Value& place, const Scene& scene) : text_(place.text()) {
  std::istringstream in(text_);
  std::string of, a, conjunction, b, rest;
  in >> kind_ >> of >> a >> conjunction >> b >> rest;
  std::vector<std::string_view> known(kOfAll.begin(), kOfAll.end());
  std::ranges::copy(kOfBody, std::back_inserter(known));
  std::ranges::copy(kOfPair, std::back_inserter(known));
  if (!isAmong(kind_, known)) {
    place.fail(fmt::format("'{}' cannot be measured{}; there are {}", kind_,
                           didYouMean(kind_, known), fmt::join(known, ", ")));
  }
  const bool all = isAmong(kind_, kOfAll), body = isAmong(kind_, kOfBody);
  const bool fits = all    ? of.empty()
                    : body ? of == "of" && !a.empty() && conjunction.empty()
                           : of == "of" && conjunction == "and" && !b.empty() && rest.empty();
  if (!fits) {
    place.fail(fmt::format("it should read \"{}{}\"", kind_,
                           all ? "" : (body ? " of NAME" : " of NAME and NAME")));
  }
  if (!all) a_ = bodyNamed(place, scene, a);
  if (!all && !body) b_ = bodyNamed(place, scene, b);
  if (b_ < a_) std::swap(a_, b_);
  if (body) a_ = bodyNamed(place, scene, a);
}

double Quantity::at(const Recording& r, std::int64_t step) const {
  const Stats& stats = r.stats[static_cast<std::size_t>(step)];
  if (kind_ == "collections") return stats.collections;
  if (kind_ == "simulated") return stats.active_bodies;
  if (kind_ == "contacts") return stats.contacts;
  if (kind_ == "inside") return stats.internal_contacts;
  if (kind_ == "asleep") return stats.asleep;
  if (kind_ == "kinetic-energy") return stats.kinetic_energy;
  if (isAmong(kind_, kOfBody)) {
    const BodyTrack& t = r.tracks[index(a_)];
    if (!r.present(a_, step)) return std::nan("");
    const std::size_t i = r.sample(a_, step);
    if (kind_ == "x") return t.x[i];
    if (kind_ == "y") return t.y[i];
    if (kind_ == "angle") return degreesOf(t.angle[i]);
    if (kind_ == "spin") return degreesOf(static_cast<double>(t.omega[i]));
    return std::hypot(static_cast<double>(t.vx[i]), static_cast<double>(t.vy[i]));
  }
  double sum = 0.0, least = std::nan("");
  int points = 0;
  for (const ContactTrack& c : r.contacts) {
    if (c.a != a_ || c.b != b_) continue;
    const auto i = r.sampleAt(c.spans, step);
    if (!i) continue;
    ++points;
    sum += static_cast<double>(kind_ == "force" ? c.lambda_n[*i] : c.lambda_t[*i]);
    least = points == 1 ? static_cast<double>(c.gap[*i])
                        : std::min(least, static_cast<double>(c.gap[*i]));
  }
  if (kind_ == "points") return points;
  return kind_ == "gap" ? least : sum / r.scene.step;
}

Expectation::Expectation(TableReader table, const std::vector<LessonTrace>& traces) {
  if (const auto value = table.get("trace")) {
    std::vector<std::string_view> labels;
    for (const LessonTrace& trace : traces) labels.emplace_back(trace.label);
    const auto at = std::ranges::find(labels, std::string_view(value->text()));
    if (at == labels.end()) {
      value->fail(fmt::format("the lesson has no trace '{}'{}", value->text(),
                              didYouMean(value->text(), labels)));
    }
    trace_ = static_cast<std::size_t>(at - labels.begin());
  }
  const Scene& scene = traces[trace_].scene;
  const auto names = [&](const char* key, What what) {
    const auto value = table.get(key);
    if (!value) return 0;
    what_ = what;
    place_ = *value;
    for (const Value& name : value->elements("[\"a\", \"b\"]")) {
      bodies_.push_back(bodyNamed(name, scene, name.text()));
    }
    if (bodies_.empty()) value->fail("it names no body");
    return 1;
  };
  int found = names("together", What::Together) + names("apart", What::Apart) +
              names("free", What::Free) + names("asleep", What::Asleep);
  const auto event = [&](const char* key, What what) {
    const auto value = table.get(key);
    if (!value) return;
    what_ = what;
    place_ = *value;
    event_.emplace(*value, scene);
    ++found;
  };
  event("happens", What::Happens);
  event("never", What::Never);
  if (const auto value = table.get("measure")) {
    place_ = *value;
    quantity_.emplace(*value, scene);
    ++found;
  }
  if (const auto value = table.get("at")) at_.emplace(*value, scene);
  if (const auto value = table.get("between")) {
    const std::vector<double> ends = value->numbers(2, "[least, most]");
    if (ends[0] > ends[1]) value->fail("the first number must not be larger than the second");
    between_ = {ends[0], ends[1]};
  }
  table.done();
  if (found != 1) {
    table.fail(
        "an [[expect]] says exactly one of together, apart, free, asleep, happens, never, measure");
  }
  const bool timeless = what_ == What::Happens || what_ == What::Never;
  if (!timeless && !at_) table.fail("'at' is missing: when is it to be so?");
  if (timeless && at_) table.fail("'at' has no meaning here; the event itself is the moment");
  if (what_ == What::Measure && !between_) table.fail("'between = [least, most]' is missing");
}

std::optional<std::string> Expectation::failure(const Recording& recording) const {
  const auto wrong = look(recording);
  if (!wrong) return std::nullopt;
  try {
    place_->fail(*wrong);
  } catch (const InputError& error) {
    return error.what();
  }
}

std::optional<std::string> Expectation::lookTogether(const Recording& r, std::int64_t step) const {
  const auto moves = [&](BodyId b) { return r.bodies[index(b)].motion == Motion::Dynamic; };
  const auto first = std::ranges::find_if(bodies_, moves);
  if (first == bodies_.end()) return std::nullopt;  // bodies that never move are one already
  const CollectionId wanted = r.collection(*first, step);
  if (wanted == kNoCollection) {
    return fmt::format("at step {} {} is in no collection", step, r.bodies[index(*first)].name);
  }
  for (const BodyId b : bodies_) {
    if (moves(b) ? r.collection(b, step) == wanted : holds(r, b, wanted, step)) continue;
    return fmt::format("at step {} {} is not in one collection with {}", step,
                       r.bodies[index(b)].name, r.bodies[index(*first)].name);
  }
  return std::nullopt;
}

std::optional<std::string> Expectation::look(const Recording& r) const {
  if (what_ == What::Happens || what_ == What::Never) {
    const auto found = event_->find(r);
    if (what_ == What::Never) {
      if (!found) return std::nullopt;
      return fmt::format("it does happen, at step {}", found->step);
    }
    if (!found) return "it does not happen";
    const double time = static_cast<double>(found->step) * r.scene.step;
    if (!between_ || (time >= between_->first && time <= between_->second)) return std::nullopt;
    return fmt::format("it happens at {} s, not between {} s and {} s", time, between_->first,
                       between_->second);
  }
  const auto moment = at_->find(r);
  if (!moment) return fmt::format("'{}' does not happen", at_->text());
  const std::int64_t step = moment->step;
  if (what_ == What::Measure) {
    const double value = quantity_->at(r, step);
    if (value >= between_->first && value <= between_->second) return std::nullopt;
    return fmt::format("at step {} it is {:.6g}, not between {} and {}", step, value,
                       between_->first, between_->second);
  }
  const auto is = [&](BodyId b) { return r.bodies[index(b)].name; };
  if (what_ == What::Together) return lookTogether(r, step);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyId b = bodies_[i];
    const CollectionId c = r.collection(b, step);
    if (what_ == What::Free && c != kNoCollection) {
      return fmt::format("at step {} {} is in a collection", step, is(b));
    }
    if (what_ == What::Asleep &&
        (!r.present(b, step) || r.tracks[index(b)].asleep[r.sample(b, step)] == 0)) {
      return fmt::format("at step {} {} is awake", step, is(b));
    }
    for (std::size_t j = 0; what_ == What::Apart && j < i; ++j) {
      if (c != kNoCollection && c == r.collection(bodies_[j], step)) {
        return fmt::format("at step {} {} and {} are in one collection", step, is(bodies_[j]),
                           is(b));
      }
    }
  }
  return std::nullopt;
}

}  // namespace merge2d
