#include "lessons/encode.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "lessons/encode_head.h"
#include "lessons/pack.h"
#include "render/camera.h"

namespace merge2d {
namespace {

constexpr double kPictureAspect = 1000.0 / 720.0;
constexpr double kFriction = 1e-5;  ///< quantum of a coefficient

/// Packs the columns of a recording in the order in which the page reads them.
class Encoder {
 public:
  Encoder(const Recording& recording, const Encoding& encoding)
      : r_(recording), most_impulses_(encoding.impulses) {
    legend_.every = recording.every * encoding.contacts_every;
    legend_.length.quantum = cameraOf(recording).height / encoding.positions;
    legend_.angle.quantum = 4.0 / encoding.positions;
    legend_.amount.steps = encoding.decades;
  }

  EncodedTrace encode() {
    packBodies();
    if (r_.detail == Detail::Full) {
      packContacts();
      packDecisions();
      packInside();
    }
    packStats();
    if (r_.every > 1) packEvents();
    EncodedTrace out;
    legend_.inside = insideKept();
    out.head = headOf(r_, legend_);
    out.data = base64(deflated(packer_.bytes()));
    return out;
  }

 private:
  template <class T, class Code>
  void column(const std::vector<T>& values, Code code) {
    codes_.clear();
    for (const T& value : values) codes_.push_back(code(value));
    packer_.column(codes_);
  }
  template <class T>
  void runs(const std::vector<T>& values) {
    codes_.assign(values.begin(), values.end());
    packer_.runs(codes_);
  }
  template <class T>
  void lengths(const std::vector<T>& values) {
    column(values, [&](double v) { return legend_.length.code(v); });
  }
  template <class T>
  void angles(const std::vector<T>& values) {
    column(values, [&](double v) { return legend_.angle.code(v); });
  }
  template <class T>
  void amounts(const std::vector<T>& values) {
    column(values, [&](double v) { return legend_.amount.code(v); });
  }

  void packBodies() {
    for (const BodyTrack& t : r_.tracks) {
      packer_.number(t.first);
      if (r_.every > 1) packer_.column(t.at);
      lengths(t.x);
      lengths(t.y);
      angles(t.angle);
      runs(t.collection);
      runs(t.asleep);
      if (r_.detail == Detail::Motion || r_.every > 1) continue;
      amounts(t.vx);
      amounts(t.vy);
      amounts(t.omega);
    }
  }

  /// Which samples of a track are kept, and the spans they form, counted in samples.
  void chooseSamples(const std::vector<Span>& spans) {
    kept_.clear();
    kept_spans_.clear();
    const std::int64_t every = legend_.every / r_.every;
    std::size_t sample = 0;
    for (const Span& span : spans) {
      for (std::int64_t i = span.first; i < span.first + span.count; ++i, ++sample) {
        if (i % every != 0) continue;
        const std::int64_t at = i / every;
        if (kept_spans_.empty() || kept_spans_.back().first + kept_spans_.back().count != at) {
          kept_spans_.push_back({at, 0});
        }
        ++kept_spans_.back().count;
        kept_.push_back(sample);
      }
    }
  }
  void packSpans() {
    packer_.number(static_cast<std::int64_t>(kept_spans_.size()));
    for (const Span& span : kept_spans_) {
      packer_.number(span.first);
      packer_.number(span.count);
    }
  }
  template <class T>
  std::vector<T> kept(const std::vector<T>& values) const {
    std::vector<T> out;
    out.reserve(kept_.size());
    for (const std::size_t sample : kept_) out.push_back(values[sample]);
    return out;
  }

  void packContacts() {
    packer_.number(static_cast<std::int64_t>(r_.contacts.size()));
    for (const ContactTrack& t : r_.contacts) {
      chooseSamples(t.spans);
      packer_.number(static_cast<std::int64_t>(index(t.a)));
      packer_.number(static_cast<std::int64_t>(index(t.b)));
      packer_.number(Linear{kFriction}.code(t.mu));
      packSpans();
      lengths(kept(t.x));
      lengths(kept(t.y));
      angles(kept(t.normal));
      amounts(kept(t.gap));
      amounts(kept(t.lambda_n));
      amounts(kept(t.lambda_t));
      amounts(kept(t.w_n));
      amounts(kept(t.w_t));
      runs(kept(t.state));
      runs(kept(t.internal));
      runs(kept(t.fresh));
    }
  }

  /// The index of a track's criterion in the head's table.
  std::size_t criterionOf(const DecisionTrack& t) {
    const auto key = std::tuple{t.stage, t.criterion, t.threshold, t.needed};
    const auto [at, added] = criterion_of_.try_emplace(key, legend_.criteria.size());
    if (added) legend_.criteria.push_back(&t);
    return at->second;
  }

  void packDecisions() {
    packer_.number(static_cast<std::int64_t>(r_.decisions.size()));
    for (const DecisionTrack& t : r_.decisions) {
      chooseSamples(t.spans);
      packer_.number(static_cast<std::int64_t>(index(t.a)));
      packer_.number(static_cast<std::int64_t>(index(t.b)));
      packer_.number(static_cast<std::int64_t>(criterionOf(t)));
      packSpans();
      amounts(kept(t.value));
      runs(kept(t.count));
      runs(kept(t.passed));
    }
  }

  /// Of the steps worth most, as many as there is room for, in the order of steps; where not each
  /// step has its contacts in the page, of those that do.
  std::vector<const ImpulsesInside*> insideKept() const {
    std::vector<const ImpulsesInside*> kept;
    std::size_t total = 0;
    for (const ImpulsesInside& inside : r_.inside) {
      if (inside.step % legend_.every != 0) continue;
      total += inside.contact.size();
      if (total > most_impulses_) break;
      kept.push_back(&inside);
    }
    std::ranges::sort(kept, {}, &ImpulsesInside::step);
    return kept;
  }

  /// The changes by the sweep are small as a rule: they are kept as differences of codes.
  void changes(const std::vector<float>& from, const std::vector<float>& to) {
    codes_.clear();
    for (std::size_t i = 0; i < to.size(); ++i) {
      codes_.push_back(legend_.amount.code(to[i]) - legend_.amount.code(from[i]));
    }
    packer_.column(codes_);
  }

  void packInside() {
    const std::vector<const ImpulsesInside*> kept = insideKept();
    packer_.number(static_cast<std::int64_t>(kept.size()));
    for (const ImpulsesInside* inside : kept) {
      packer_.number(inside->step);
      packer_.number(inside->sweeping ? 1 : 0);
      packer_.column(inside->contact);
      amounts(inside->warm_n);
      amounts(inside->warm_t);
      changes(inside->warm_n, inside->swept_n);
      changes(inside->warm_t, inside->swept_t);
      changes(inside->swept_n, inside->begin_n);
      changes(inside->swept_t, inside->begin_t);
      runs(inside->inner);
    }
  }

  template <class Get>
  void statistic(Get get) {
    codes_.clear();
    const auto every = static_cast<std::size_t>(r_.every);
    for (std::size_t i = 0; i < r_.stats.size(); i += every) codes_.push_back(get(r_.stats[i]));
    packer_.column(codes_);
  }
  void packStats() {
    const Logarithmic fine{.floor = 1e-6, .steps = 1024.0};
    statistic([](const Stats& s) { return s.active_bodies; });
    statistic([](const Stats& s) { return s.collections; });
    statistic([](const Stats& s) { return s.asleep; });
    statistic([](const Stats& s) { return s.contacts; });
    statistic([](const Stats& s) { return s.internal_contacts; });
    statistic([&](const Stats& s) { return fine.code(s.max_penetration); });
    statistic([&](const Stats& s) { return fine.code(s.kinetic_energy); });
    statistic([&](const Stats& s) { return fine.code(s.potential_energy); });
    statistic([&](const Stats& s) { return fine.code(s.momentum.x()); });
    statistic([&](const Stats& s) { return fine.code(s.momentum.y()); });
    statistic([&](const Stats& s) { return fine.code(s.angular_momentum); });
  }

  template <class Get>
  void ofEvents(Get get) {
    column(r_.events, [&](const TimedEvent& e) { return static_cast<std::int32_t>(get(e)); });
  }
  /// Those of a long run are so many that the head would be most of the page.
  void packEvents() {
    ofEvents([](const TimedEvent& e) { return e.step; });
    ofEvents([](const TimedEvent& e) { return e.event.type; });
    ofEvents([](const TimedEvent& e) { return index(e.event.a); });
    ofEvents([](const TimedEvent& e) { return index(e.event.b); });
    ofEvents([](const TimedEvent& e) { return value(e.event.collection); });
    ofEvents([](const TimedEvent& e) { return e.event.reason; });
  }

  const Recording& r_;
  std::size_t most_impulses_;
  ColumnLegend legend_;
  Packer packer_;
  std::vector<std::int32_t> codes_;
  std::vector<std::size_t> kept_;
  std::vector<Span> kept_spans_;
  std::map<std::tuple<std::string, std::string, double, int>, std::size_t> criterion_of_;
};

}  // namespace

const std::vector<Encoding>& encodings() {
  static const std::vector<Encoding> kAll = {
      {.positions = 65536, .decades = 256, .contacts_every = 1, .impulses = kMostImpulses},
      {.positions = 65536, .decades = 256, .contacts_every = 1, .impulses = 50'000},
      {.positions = 32768, .decades = 64, .contacts_every = 1, .impulses = 50'000},
      {.positions = 32768, .decades = 64, .contacts_every = 1, .impulses = 10'000},
      {.positions = 16384, .decades = 32, .contacts_every = 2, .impulses = 10'000},
      {.positions = 16384, .decades = 16, .contacts_every = 5, .impulses = 10'000},
      {.positions = 8192, .decades = 8, .contacts_every = 10, .impulses = 10'000},
      {.positions = 4096, .decades = 8, .contacts_every = 50, .impulses = 10'000},
      {.positions = 4096, .decades = 8, .contacts_every = 1'000'000, .impulses = 0},
  };
  return kAll;
}

EncodedTrace encode(const Recording& recording, const Encoding& encoding) {
  return Encoder(recording, encoding).encode();
}

Camera cameraOf(const Recording& recording) {
  if (recording.scene.camera) return *recording.scene.camera;
  constexpr std::int64_t kLooks = 500;
  Coverage seen;
  for (std::int64_t step = 0; step <= recording.steps;
       step += std::max<std::int64_t>(1, recording.steps / kLooks)) {
    Snapshot now;
    for (std::size_t i = 0; i < recording.bodies.size(); ++i) {
      const BodyId id{static_cast<std::uint32_t>(i)};
      if (!recording.present(id, step)) continue;
      const BodyTrack& t = recording.tracks[i];
      const std::size_t at = recording.sample(id, step);
      now.bodies.push_back({.id = id, .x = {t.x[at], t.y[at]}, .angle = t.angle[at]});
    }
    seen.add(now, recording.bodies);
  }
  return fitCamera(seen, recording.bodies, kPictureAspect, recording.scene.margin);
}

}  // namespace merge2d
