#include "lessons/encode.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "lessons/pack.h"
#include "render/camera.h"
#include "render/silhouette.h"
#include "src2d/trace/json_text.h"
#include "src2d/trace/parameters.h"

namespace merge2d {
namespace {

constexpr double kPictureAspect = 1000.0 / 720.0;
constexpr double kFriction = 1e-5;  ///< quantum of a coefficient

/// Packs the columns of a recording in the order in which the page reads them.
class Encoder {
 public:
  Encoder(const Recording& recording, const Encoding& encoding)
      : r_(recording), every_(encoding.contacts_every) {
    length_.quantum = cameraOf(recording).height / encoding.positions;
    angle_.quantum = 4.0 / encoding.positions;
    amount_.steps = encoding.decades;
  }

  EncodedTrace encode() {
    packBodies();
    if (r_.detail == Detail::Full) {
      packContacts();
      packDecisions();
    }
    packStats();
    EncodedTrace out;
    out.head = head();
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
    column(values, [&](double v) { return length_.code(v); });
  }
  template <class T>
  void angles(const std::vector<T>& values) {
    column(values, [&](double v) { return angle_.code(v); });
  }
  template <class T>
  void amounts(const std::vector<T>& values) {
    column(values, [&](double v) { return amount_.code(v); });
  }

  void packBodies() {
    for (const BodyTrack& t : r_.tracks) {
      packer_.number(t.first);
      lengths(t.x);
      lengths(t.y);
      angles(t.angle);
      runs(t.collection);
      runs(t.asleep);
      if (r_.detail == Detail::Motion) continue;
      amounts(t.vx);
      amounts(t.vy);
      amounts(t.omega);
    }
  }

  /// Which samples of a track are kept, and the spans they form, counted in samples.
  void chooseSamples(const std::vector<Span>& spans) {
    kept_.clear();
    kept_spans_.clear();
    std::size_t sample = 0;
    for (const Span& span : spans) {
      for (std::int64_t step = span.first; step < span.first + span.count; ++step, ++sample) {
        if (step % every_ != 0) continue;
        const std::int64_t at = step / every_;
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
    const auto [at, added] = criterion_of_.try_emplace(key, criteria_.size());
    if (added) criteria_.push_back(&t);
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

  template <class Get>
  void statistic(Get get) {
    column(r_.stats, get);
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

  std::string head() const {
    JsonText out;
    const Camera camera = cameraOf(r_);
    out.open('{').field("scene", r_.scene.name).field("title", r_.scene.title);
    out.field("mode", name(r_.mode)).field("full", r_.detail == Detail::Full);
    out.field("h", r_.scene.step).field("steps", r_.steps).field("every", every_);
    out.key("gravity").value(r_.scene.gravity);
    out.key("camera").row(camera.center.x(), camera.center.y(), camera.height);
    out.field("length", length_.quantum).field("angle", angle_.quantum);
    out.key("amount").row(amount_.floor, amount_.steps);
    out.key("parameters");
    writeParameters(out, r_.scene);
    headBodies(out);
    out.array("criteria", criteria_, [&](const DecisionTrack* t) {
      out.open('{').field("stage", t->stage).field("criterion", t->criterion);
      out.field("equation", t->equation).field("threshold", t->threshold);
      out.field("needed", t->needed).close('}');
    });
    out.array("events", r_.events, [&](const TimedEvent& e) {
      out.row(e.step, name(e.event.type), e.event.a, e.event.b, e.event.collection,
              name(e.event.reason));
    });
    out.array("colors", r_.colors, [&](const CollectionColor& c) { out.row(c.id, c.slot); });
    out.array("ledger", r_.ledger, [&](const LedgerEntry& e) {
      const auto change = [&](double LedgerEntry::Sums::*of) {
        return std::pair{e.before.*of, e.after.*of};
      };
      out.open('[').value(e.step).value(static_cast<int>(e.stage)).value(e.anchored ? 1 : 0);
      for (const auto of : {&LedgerEntry::Sums::px, &LedgerEntry::Sums::py,
                            &LedgerEntry::Sums::angular, &LedgerEntry::Sums::kinetic}) {
        const auto [before, after] = change(of);
        out.value(static_cast<float>(before)).value(static_cast<float>(after));
      }
      out.close(']');
    });
    out.array("orders", r_.orders, [&](const SweepOrder& order) {
      out.open('[').value(order.step).open('[');
      for (const NotedVisit& visit : order.visits) out.row(visit.a, visit.b, visit.depth);
      out.close(']').close(']');
    });
    out.array("springs", r_.scene.springs, [&](const SpringDesc& s) { headSpring(out, s); });
    out.close('}');
    return std::string(out.text());
  }

  void headSpring(JsonText& out, const SpringDesc& s) const {
    // Anchors are given in the body's own frame, the page knows the one at its centre of mass.
    const auto local = [&](BodyIndex body, const Vec2& anchor) -> Vec2 {
      return anchor - areaProperties(r_.scene.bodies[body].shapes).centroid;
    };
    const Vec2 from = local(s.body, s.anchor), to = s.to_body ? local(*s.to_body, s.to) : s.to;
    out.row(s.body, from.x(), from.y(), s.to_body ? static_cast<std::int64_t>(*s.to_body) : -1,
            to.x(), to.y());
  }

  void headBodies(JsonText& out) const {
    out.array("bodies", r_.bodies, [&](const BodyInfo& body) {
      out.open('{').field("name", body.name).field("motion", name(body.motion));
      out.field("mass", body.mass).field("inertia", body.inertia);
      const Silhouette looks = silhouette(body.shapes);
      out.array("pieces", looks.pieces, [&](const Piece& piece) {
        out.open('[');
        if (piece.kind == Piece::Kind::Disc) {
          out.value(piece.frame.position.x()).value(piece.frame.position.y()).value(piece.radius);
        } else {
          for (const Vec2& v : piece.vertices) out.value(v);
        }
        out.close(']');
      });
      out.array("boundary", looks.boundary,
                [&](const Segment& s) { out.row(s.from.x(), s.from.y(), s.to.x(), s.to.y()); });
      out.close('}');
    });
  }

  const Recording& r_;
  std::int64_t every_;
  Linear length_, angle_;
  Logarithmic amount_;
  Packer packer_;
  std::vector<std::int32_t> codes_;
  std::vector<std::size_t> kept_;
  std::vector<Span> kept_spans_;
  std::map<std::tuple<std::string, std::string, double, int>, std::size_t> criterion_of_;
  std::vector<const DecisionTrack*> criteria_;
};

}  // namespace

const std::vector<Encoding>& encodings() {
  static const std::vector<Encoding> kAll = {
      {.positions = 65536, .decades = 256, .contacts_every = 1},
      {.positions = 32768, .decades = 64, .contacts_every = 1},
      {.positions = 16384, .decades = 32, .contacts_every = 2},
      {.positions = 16384, .decades = 16, .contacts_every = 5},
      {.positions = 8192, .decades = 8, .contacts_every = 10},
      {.positions = 4096, .decades = 8, .contacts_every = 50},
      {.positions = 4096, .decades = 8, .contacts_every = 1'000'000},
  };
  return kAll;
}

EncodedTrace encode(const Recording& recording, const Encoding& encoding) {
  return Encoder(recording, encoding).encode();
}

Camera cameraOf(const Recording& recording) {
  if (recording.scene.camera) return *recording.scene.camera;
  Snapshot initial;
  for (std::size_t i = 0; i < recording.bodies.size(); ++i) {
    const BodyId id{static_cast<std::uint32_t>(i)};
    if (!recording.present(id, 0)) continue;
    const BodyTrack& t = recording.tracks[i];
    initial.bodies.push_back({.id = id, .x = {t.x[0], t.y[0]}, .angle = t.angle[0]});
  }
  return fitCamera(initial, recording.bodies, kPictureAspect);
}

}  // namespace merge2d
