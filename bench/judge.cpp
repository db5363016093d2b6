#include "bench/judge.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "src2d/cycles/held_groups.h"
#include "src2d/merging/metric.h"
#include "src2d/world.h"

namespace merge2d {
namespace {

constexpr double kMoved = 0.02;    // m or rad: the pair has moved
constexpr double kSlipped = 2e-4;  // m: a contact is not where it was
constexpr double kSoon = 1.0;      // s
constexpr double kLater = 5.0;     // s
constexpr double kEvery = 0.5;     // s

using Pair = std::pair<BodyId, BodyId>;
using PointKey = std::tuple<BodyId, BodyId, std::uint32_t>;  ///< bodies and feature

/// One step of the reference.
class Moment {
 public:
  Moment(const Snapshot& s, const std::vector<BodyInfo>& bodies) : s_(s), bodies_(bodies) {}

  const BodyState& body(BodyId id) const {
    return *std::ranges::lower_bound(s_.bodies, id, {}, &BodyState::id);
  }
  bool has(BodyId id) const {
    return std::ranges::binary_search(s_.bodies, id, {}, &BodyState::id);
  }
  bool fixed(BodyId id) const {
    return body(id).pinned || bodies_[index(id)].motion != Motion::Dynamic;
  }

  /// The pairs whose active contacts do not slip and whose bodies do not move against each other.
  std::map<Pair, std::vector<Vec2>> quietPairs(const Settings& settings) const {
    std::map<Pair, std::vector<Vec2>> pairs;
    std::map<Pair, bool> slips;
    for (const ContactView& c : s_.contacts) {
      if (c.lambda_n <= 0.0 || (fixed(c.a) && fixed(c.b))) continue;
      pairs[{c.a, c.b}].push_back(c.x);
      slips[{c.a, c.b}] |= std::abs(c.w_t) >= settings.merging.sliding;
    }
    std::erase_if(pairs, [&](const auto& entry) {
      const auto& [a, b] = entry.first;
      return slips[entry.first] || fastest(a, b) >= settings.merging.velocity;
    });
    return pairs;
  }

  /// Joints whose bodies do not move against each other, as so many contacts in a place.
  struct JointPins {
    BodyId a{}, b{};
    Vec2 at = Vec2::Zero();
    int count = 0;
  };
  std::vector<JointPins> quietJoints(const Settings& settings) const {
    std::vector<JointPins> quiet;
    for (const JointView& j : s_.joints) {
      const bool holds = j.kind == JointKind::Revolute || j.kind == JointKind::Weld;
      if (!holds || j.broken || j.to_world || !has(j.a) || !has(j.b)) continue;
      if (fastest(j.a, j.b) >= settings.merging.velocity) continue;
      quiet.push_back({j.a, j.b, j.to, j.kind == JointKind::Weld ? 2 : 1});
    }
    return quiet;
  }

  Pose seen(BodyId a, BodyId b) const { return body(a).pose().inverse() * body(b).pose(); }

 private:
  /// Eq. (15), over the corners of the body's bounds.
  double fastest(BodyId a, BodyId b) const {
    const auto field = [&](BodyId id) {
      return VelocityField{body(id).x, body(id).v, body(id).omega};
    };
    double most = 0.0;
    for (const BodyId id : {a, b}) {
      if (fixed(id)) continue;
      Aabb box;
      for (const ConvexShape& shape : bodies_[index(id)].shapes) {
        box.include(bounds(shape, Pose{}));
      }
      const Pose pose = body(id).pose();
      for (const double x : {box.lower.x(), box.upper.x()}) {
        for (const double y : {box.lower.y(), box.upper.y()}) {
          const Vec2 p = pose * Vec2(x, y);
          most = std::max(most, (field(a).at(p) - field(b).at(p)).norm());
        }
      }
    }
    return most;
  }

  const Snapshot& s_;
  const std::vector<BodyInfo>& bodies_;
};

/// A contact that holds something: what has become of it since.
struct Held {
  Pin pin;
  double slid = 0.0, crept = 0.0;  ///< slip on the edge of the cone, and inside it [m]
};

/// The contact that a pair lost first; of several at once the last of these.
enum class Loss { None, Hit, Crept, Slid, Opened };

/// The contacts that were judged at one time, and which of them are left.
struct Sample {
  double time = 0.0;
  std::map<PointKey, Held> contacts{};
  std::vector<Pin> joints{};
  std::set<Pair> met{};    ///< all pairs that touched then
  std::set<BodyId> hit{};  ///< those that have met something new since
};

/// Judges a pair when its future is known.
struct Pending {
  Pair pair;
  Pose then;
  std::size_t sample = 0;
  std::uint32_t a = 0, b = 0;  ///< the nodes
  std::array<bool, 3> welded{};
  bool would_hold = false;  ///< by `rigid`, if all contacts had been ready
  bool moved_soon = false, moved = false;
  Loss loss = Loss::None;  ///< of what held it
};

class Judge {
 public:
  Judge(const Scene& scene, double from, double until)
      : world_(scene, {.mode = Mode::Reference, .timings = false}), from_(from), until_(until) {}

  Judgement run() {
    const auto every = std::max(1L, std::lround(kEvery / world_.scene().step));
    while (world_.time() < until_ + kLater) {
      world_.step();
      world_.capture(now_);
      const Moment moment(now_, world_.bodies());
      const auto quiet = moment.quietPairs(world_.scene().settings);
      for (const auto& [pair, points] : quiet) counts_[pair] += 1;
      std::erase_if(counts_, [&](const auto& entry) { return !quiet.contains(entry.first); });
      followContacts();
      followPairs(moment);
      const bool sampled = world_.time() >= from_ && world_.time() <= until_;
      if (sampled && world_.steps() % every == 0) judge(moment, quiet);
    }
    return total();
  }

 private:
  std::uint32_t bodies() const { return static_cast<std::uint32_t>(world_.bodies().size()); }

  /// All that is pinned is one node.
  std::uint32_t node(const Moment& moment, BodyId id) const {
    return moment.body(id).pinned ? bodies() : static_cast<std::uint32_t>(id);
  }

  Groups groupsOf(const std::vector<Pin>& pins, CycleCriterion criterion) const {
    return heldGroups(bodies() + 1, pins, criterion);
  }

  void judge(const Moment& moment, const std::map<Pair, std::vector<Vec2>>& quiet) {
    const int needed = world_.scene().settings.merging.steps;
    const auto ready = [&](const Pair& pair) {
      const auto count = counts_.find(pair);
      return count != counts_.end() && count->second >= needed;
    };
    samples_.push_back({.time = world_.time()});
    Sample& sample = samples_.back();
    std::vector<Pin> pins, all;
    for (const ContactView& c : now_.contacts) {
      sample.met.insert({c.a, c.b});
      if (c.lambda_n <= 0.0) continue;
      const Pin pin{node(moment, c.a), node(moment, c.b), c.x, true};
      all.push_back(pin);
      if (!ready({c.a, c.b})) continue;
      pins.push_back(pin);
      sample.contacts[{c.a, c.b, c.feature}] = {.pin = pin};
    }
    for (const Moment::JointPins& j : moment.quietJoints(world_.scene().settings)) {
      for (int i = 0; i < j.count; ++i) {
        const Pin pin{node(moment, j.a), node(moment, j.b), j.at + i * Vec2::UnitX(), true};
        all.push_back(pin);
        pins.push_back(pin);
        sample.joints.push_back(pin);
      }
    }
    std::array<Groups, 3> groups;
    for (std::size_t c = 0; c < 3; ++c) groups[c] = groupsOf(pins, kCriteria[c]);
    const Groups eager = groupsOf(all, CycleCriterion::Rigid);
    for (const auto& [pair, points] : quiet) {
      if (!ready(pair) || points.size() != 1) continue;
      const std::uint32_t a = node(moment, pair.first), b = node(moment, pair.second);
      Pending p{.pair = pair,
                .then = moment.seen(pair.first, pair.second),
                .sample = samples_.size() - 1,
                .a = a,
                .b = b};
      for (std::size_t c = 0; c < 3; ++c) p.welded[c] = groups[c][a] == groups[c][b];
      p.would_hold = eager[a] == eager[b];
      pending_.push_back(p);
    }
  }

  /// Takes out of each sample the contacts that no longer hold, and asks which pairs that frees.
  void followContacts() {
    std::map<PointKey, const ContactView*> seen;
    for (const ContactView& c : now_.contacts) seen[{c.a, c.b, c.feature}] = &c;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      Sample& sample = samples_[i];
      if (world_.time() - sample.time > kLater) continue;
      for (const ContactView& c : now_.contacts) {
        if (c.lambda_n > 0.0 && !sample.met.contains({c.a, c.b})) sample.hit.insert({c.a, c.b});
      }
      Loss worst = Loss::None;
      bool hit = false;
      for (auto at = sample.contacts.begin(); at != sample.contacts.end();) {
        const PointKey key = at->first;
        const auto now = seen.find(key);
        const Loss loss = lossOf(at->second, now == seen.end() ? nullptr : now->second);
        if (loss == Loss::None) {
          ++at;
          continue;
        }
        worst = std::max(worst, loss);
        hit |= sample.hit.contains(std::get<0>(key)) || sample.hit.contains(std::get<1>(key));
        at = sample.contacts.erase(at);
      }
      if (worst != Loss::None) freePairs(i, hit ? Loss::Hit : worst);
    }
  }

  Loss lossOf(Held& held, const ContactView* now) const {
    if (now == nullptr || now->lambda_n <= 0.0) return Loss::Opened;
    const double slip = now->w_t * world_.scene().step;
    (now->state == ContactState::Sliding ? held.slid : held.crept) += slip;
    if (std::abs(held.slid) > kSlipped) return Loss::Slid;
    return std::abs(held.crept) > kSlipped ? Loss::Crept : Loss::None;
  }

  /// The pairs of a sample that what is left of its contacts does not hold any more.
  void freePairs(std::size_t sample, Loss loss) {
    std::vector<Pin> left = samples_[sample].joints;
    for (const auto& [key, held] : samples_[sample].contacts) left.push_back(held.pin);
    const Groups group = groupsOf(left, CycleCriterion::Rigid);
    for (Pending& p : pending_) {
      const bool held = p.sample == sample && p.welded[2] && !p.moved && p.loss == Loss::None;
      if (held && group[p.a] != group[p.b]) p.loss = loss;
    }
  }

  void followPairs(const Moment& moment) {
    for (Pending& p : pending_) {
      const double age = world_.time() - samples_[p.sample].time;
      if (p.moved || age > kLater) continue;
      const Pose now = moment.seen(p.pair.first, p.pair.second);
      p.moved = (now.position - p.then.position).norm() > kMoved ||
                std::abs((p.then.rotation.inverse() * now.rotation).angle()) > kMoved;
      p.moved_soon = p.moved && age <= kSoon;
    }
  }

  Judgement total() const {
    Judgement sum;
    for (const Pending& p : pending_) {
      for (std::size_t c = 0; c < 3; ++c) {
        Score& score = sum.scores[c];
        score.welded += p.welded[c];
        score.false_soon += p.welded[c] && p.moved_soon;
        score.false_later += p.welded[c] && p.moved;
        score.missed += !p.welded[c] && !p.moved;
      }
      if (p.welded[2] && p.moved) {
        int* const of_loss[] = {&sum.causes.none, &sum.causes.hit, &sum.causes.crept,
                                &sum.causes.slid, &sum.causes.opened};
        ++*of_loss[static_cast<std::size_t>(p.loss)];
      } else if (!p.welded[2] && !p.moved) {
        ++(p.would_hold ? sum.causes.early : sum.causes.balanced);
      }
    }
    return sum;
  }

  World world_;
  double from_, until_;
  Snapshot now_;
  std::map<Pair, int> counts_;  ///< consecutive quiet steps
  std::vector<Sample> samples_;
  std::vector<Pending> pending_;
};

}  // namespace

Judgement& Judgement::operator+=(const Judgement& more) {
  for (std::size_t c = 0; c < 3; ++c) {
    scores[c].welded += more.scores[c].welded;
    scores[c].false_soon += more.scores[c].false_soon;
    scores[c].false_later += more.scores[c].false_later;
    scores[c].missed += more.scores[c].missed;
  }
  causes.hit += more.causes.hit;
  causes.opened += more.causes.opened;
  causes.slid += more.causes.slid;
  causes.crept += more.causes.crept;
  causes.none += more.causes.none;
  causes.early += more.causes.early;
  causes.balanced += more.causes.balanced;
  return *this;
}

Judgement judgeScene(const Scene& scene, double from, double until) {
  return Judge(scene, from, until).run();
}

}  // namespace merge2d
