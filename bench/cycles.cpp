/// How well the cycle criteria judge, and what they cost: Markdown tables for docs/cycles.md.
///
/// All criteria look at one and the same run, the reference: at times half a second apart, the
/// pairs that are ready to merge by their velocities are judged, and what the reference does in the
/// next seconds says who was right. Only pairs with a single contact count: the criteria agree on
/// others.

#include "src2d/merging/cycles.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <random>

#include "src2d/merging/metric.h"
#include "src2d/scene/load.h"
#include "src2d/world.h"

namespace merge2d {
namespace {

constexpr std::array kCriteria = {CycleCriterion::Off, CycleCriterion::Triangle,
                                  CycleCriterion::Rigid};
constexpr std::array kTitles = {"off", "triangle", "rigid"};
constexpr double kMoved = 0.02;    // m or rad: the pair has moved
constexpr double kSoon = 1.0;      // s
constexpr double kLater = 5.0;     // s
constexpr double kEvery = 0.5;     // s
constexpr double kLongest = 10.0;  // s of a scene that are judged

using Pair = std::pair<BodyId, BodyId>;

/// What one criterion did with the pairs of a single contact.
struct Score {
  int welded = 0, false_soon = 0, false_later = 0, missed = 0;

  Score& operator+=(const Score& o) {
    welded += o.welded;
    false_soon += o.false_soon;
    false_later += o.false_later;
    missed += o.missed;
    return *this;
  }
};
using Scores = std::array<Score, 3>;

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

/// Judges a pair when its future is known.
struct Pending {
  Pair pair;
  Pose then;
  double time = 0.0;
  std::array<bool, 3> welded{};
  bool moved_soon = false, moved = false;
};

class Judge {
 public:
  Judge(const Scene& scene, double from, double until)
      : world_(scene, {.mode = Mode::Reference, .timings = false}), from_(from), until_(until) {}

  Scores run() {
    const auto every = std::max(1L, std::lround(kEvery / world_.scene().step));
    while (world_.time() < until_ + kLater) {
      world_.step();
      world_.capture(now_);
      const Moment moment(now_, world_.bodies());
      auto quiet = moment.quietPairs(world_.scene().settings);
      for (auto& [pair, points] : quiet) counts_[pair] += 1;
      std::erase_if(counts_, [&](const auto& entry) { return !quiet.contains(entry.first); });
      follow(moment);
      const bool sampled = world_.time() >= from_ && world_.time() <= until_;
      if (sampled && world_.steps() % every == 0) judge(moment, quiet);
    }
    finish();
    return scores_;
  }

 private:
  void judge(const Moment& moment, const std::map<Pair, std::vector<Vec2>>& quiet) {
    const auto bodies = static_cast<std::uint32_t>(world_.bodies().size());
    const auto node = [&](BodyId id) {  // all that is pinned is one
      return moment.body(id).pinned ? bodies : static_cast<std::uint32_t>(id);
    };
    std::vector<Pin> pins;
    for (const auto& [pair, points] : quiet) {
      if (counts_[pair] < world_.scene().settings.merging.steps) continue;
      for (const Vec2& p : points) pins.push_back({node(pair.first), node(pair.second), p, true});
    }
    std::array<Groups, 3> groups;
    for (std::size_t c = 0; c < 3; ++c) groups[c] = heldGroups(bodies + 1, pins, kCriteria[c]);
    for (const auto& [pair, points] : quiet) {
      if (counts_[pair] < world_.scene().settings.merging.steps || points.size() != 1) continue;
      Pending p{.pair = pair, .then = moment.seen(pair.first, pair.second), .time = world_.time()};
      for (std::size_t c = 0; c < 3; ++c) {
        p.welded[c] = groups[c][node(pair.first)] == groups[c][node(pair.second)];
      }
      pending_.push_back(p);
    }
  }

  void follow(const Moment& moment) {
    for (Pending& p : pending_) {
      const double age = world_.time() - p.time;
      if (p.moved || age > kLater) continue;
      const Pose now = moment.seen(p.pair.first, p.pair.second);
      p.moved = (now.position - p.then.position).norm() > kMoved ||
                std::abs((p.then.rotation.inverse() * now.rotation).angle()) > kMoved;
      p.moved_soon = p.moved && age <= kSoon;
    }
  }

  void finish() {
    for (const Pending& p : pending_) {
      for (std::size_t c = 0; c < 3; ++c) {
        Score& score = scores_[c];
        score.welded += p.welded[c];
        score.false_soon += p.welded[c] && p.moved_soon;
        score.false_later += p.welded[c] && p.moved;
        score.missed += !p.welded[c] && !p.moved;
      }
    }
  }

  World world_;
  double from_, until_;
  Snapshot now_;
  std::map<Pair, int> counts_;  ///< consecutive quiet steps
  std::vector<Pending> pending_;
  Scores scores_;
};

/// Discs, boxes and triangles that fall into a pit.
Scene randomPile(std::uint64_t seed, int bodies, int columns) {
  std::mt19937_64 random(seed);
  const auto unit = [&] { return static_cast<double>(random() >> 11u) * 0x1p-53; };
  const double width = columns * 1.1;
  std::string toml = fmt::format(
      "format = 1\n[[body]]\nmotion = \"pinned\"\nat = [0, -0.5]\nbox = [{0}, 1]\n"
      "[[body]]\nmotion = \"pinned\"\nat = [{1}, 10]\nbox = [1, 30]\n"
      "[[body]]\nmotion = \"pinned\"\nat = [-{1}, 10]\nbox = [1, 30]\n",
      width + 4.0, 0.5 * width + 0.5);
  for (int i = 0; i < bodies; ++i) {
    const double size = 0.5 + 0.4 * unit();
    const double x = (i % columns + 0.5) * 1.1 - 0.5 * width + 0.05 * (unit() - 0.5);
    toml += fmt::format("[[body]]\nat = [{}, {}]\nangle = {}\n", x, 0.7 + i / columns * 1.1,
                        360.0 * unit());
    switch (random() % 3) {
      case 0:
        toml += fmt::format("circle = {}\n", 0.5 * size);
        break;
      case 1:
        toml += fmt::format("box = [{}, {}]\n", 0.8 * size, 0.6 * size);
        break;
      default:
        toml += fmt::format("polygon = [[-{0}, -{1}], [{0}, -{1}], [0, {0}]]\n", 0.5 * size,
                            0.3 * size);
    }
  }
  return parseScene(toml, fmt::format("pile-{}.toml", seed));
}

void printRow(const std::string& name, const Scores& scores) {
  fmt::print("| {} |", name);
  for (const Score& s : scores) {
    fmt::print(" {} | {} | {} | {} |", s.welded, s.false_soon, s.false_later, s.missed);
  }
  fmt::print("\n");
}

void judgeScenes(int piles) {
  fmt::print("| single-contact pairs of |");
  for (const char* name : kTitles)
    fmt::print(" {}: welded | false, 1 s | false, 5 s | missed |", name);
  fmt::print("\n|---|");
  for (int i = 0; i < 12; ++i) fmt::print("---:|");
  fmt::print("\n");
  Scores total;
  const auto add = [&](Scores& sum, const Scores& more) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += more[c];
  };
  for (const BuiltinScene& builtin : builtinScenes()) {
    const Scene scene = loadScene(builtin.name);
    const Scores scores = Judge(scene, 0.0, std::min(kLongest, scene.duration)).run();
    printRow("`" + builtin.name + "`", scores);
    add(total, scores);
  }
  Scores all_piles;
  for (int i = 0; i < piles; ++i) {
    add(all_piles, Judge(randomPile(static_cast<std::uint64_t>(i), 50, 7), 1.0, 6.0).run());
  }
  printRow(fmt::format("{} random piles of 50", piles), all_piles);
  add(total, all_piles);
  printRow("**all**", total);
}

/// What the Merge stage takes of a step while a large pile comes to rest.
void measureCost(int bodies) {
  fmt::print("\n| pile of {} mixed bodies, 6 s | ms per step | of which Merge | share |\n", bodies);
  fmt::print("|---|---:|---:|---:|\n");
  for (std::size_t c = 0; c < 3; ++c) {
    Scene scene = randomPile(1, bodies, 40);
    scene.settings.merging.cycles = kCriteria[c];
    World world(scene, {.mode = Mode::Merge});
    double total = 0.0, merging = 0.0;
    while (world.time() < 6.0) {
      world.step();
      for (const double seconds : world.stats().seconds) total += seconds;
      merging += world.stats().seconds[static_cast<std::size_t>(Stage::Merge)];
    }
    const auto steps = static_cast<double>(world.steps());
    fmt::print("| `merging.cycles = \"{}\"` | {:.2f} | {:.3f} | {:.1f}% |\n", kTitles[c],
               1e3 * total / steps, 1e3 * merging / steps, 1e2 * merging / total);
  }
}

}  // namespace
}  // namespace merge2d

int main(int argc, char** argv) {
  CLI::App program("Judges the cycle criteria by what the reference does");
  int piles = 50, bodies = 2000;
  program.add_option("--piles", piles, "Number of random piles");
  program.add_option("--bodies", bodies, "Bodies of the pile that is timed; 0: none");
  CLI11_PARSE(program, argc, argv);
  merge2d::judgeScenes(piles);
  if (bodies > 0) merge2d::measureCost(bodies);
}
