/// Random structures that are to fall, merged and in two references: when do they?
///
///   families [--family NAME|all] [--cases N] [--seed N] [--rule default|paper] [--quiet] [--toml]
///
/// One reference has the settings of the merged run, the other contacts ten times as hard and 100
/// sweeps. Where they differ by more than 0.3 s the case is decided by little, and stands apart.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/family_scenes.h"
#include "src2d/scene/load.h"
#include "src2d/world.h"

namespace merge2d::bench {
namespace {

constexpr double kLate = 0.3;   // [s]
constexpr double kSlack = 2.0;  // in which what is late falls after the end [s]

/// Where a body is, seen from another.
struct Seen {
  Vec2 place = Vec2::Zero();
  double angle = 0.0;
};

Seen look(const Snapshot& now, const Watch& watch) {
  const BodyState &body = now.bodies[watch.body], &frame = now.bodies[watch.frame];
  return {frame.pose().toLocal(body.pose() * watch.at), body.angle - frame.angle};
}

bool hasFallen(const Seen& before, const Seen& now, const Watch& watch) {
  const Vec2 way = now.place - before.place;
  const double moved = watch.along.isZero() ? way.norm() : std::abs(way.dot(watch.along));
  return moved > watch.way || std::abs(now.angle - before.angle) > watch.turn;
}

/// When the first of the watched bodies has moved, or kNever [s].
double timeOfFall(const Structure& structure, const Scene& scene, Mode mode) {
  World world(scene, {.mode = mode, .timings = false});
  Snapshot now;
  while (world.time() < structure.from) world.step();
  world.captureMotion(now);
  std::vector<Seen> before;
  for (const Watch& watch : structure.watched) before.push_back(look(now, watch));
  while (world.time() < structure.until + kSlack) {
    world.step();
    world.captureMotion(now);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Watch& watch = structure.watched[i];
      if (hasFallen(before[i], look(now, watch), watch)) return world.time();
    }
  }
  return kNever;
}

/// What merging made of a structure.
enum class Outcome { Falls, Stands, Never, Late, Early, Wrong };

struct Verdict {
  Outcome outcome = Outcome::Falls;
  bool is_apart = false;  ///< the references differ
};

Verdict judge(double merged, double soft, double hard, double until) {
  const double first = std::min(soft, hard), last = std::max(soft, hard);
  const bool is_early = merged < first - kLate;
  if (first > until) return {merged <= until && is_early ? Outcome::Wrong : Outcome::Stands};
  const bool is_apart = last - first > kLate;
  if (is_early) return {Outcome::Early, is_apart};
  if (merged <= last + kLate) return {Outcome::Falls, is_apart};
  return {merged == kNever ? Outcome::Never : Outcome::Late, is_apart};
}

struct Sum {
  int fall = 0, never = 0, late = 0, early = 0, wrong = 0;
  int apart = 0, apart_off = 0;

  void count(const Verdict& v) {
    const Outcome o = v.outcome;
    if (v.is_apart) {
      ++apart;
      apart_off += o == Outcome::Falls ? 0 : 1;
      return;
    }
    fall += o == Outcome::Stands || o == Outcome::Wrong ? 0 : 1;
    never += o == Outcome::Never ? 1 : 0;
    late += o == Outcome::Late ? 1 : 0;
    early += o == Outcome::Early ? 1 : 0;
    wrong += o == Outcome::Wrong ? 1 : 0;
  }

  Sum& operator+=(const Sum& o) {
    fall += o.fall, never += o.never, late += o.late, early += o.early, wrong += o.wrong;
    apart += o.apart, apart_off += o.apart_off;
    return *this;
  }
};

void print(const std::string& family, int cases, const Sum& sum) {
  fmt::print(
      "{:11} {} cases: {} fall in both references; of these {} never fall merged, {} more than {} "
      "s late, {} as much early. {} fall that stand. References differ in {}, merged is outside "
      "of both in {}.\n",
      family, cases, sum.fall, sum.never, sum.late, kLate, sum.early, sum.wrong, sum.apart,
      sum.apart_off);
  std::fflush(stdout);
}

constexpr std::array kMarks{"ok   ", "ok   ", "NEVER", "LATE ", "EARLY", "WRONG"};

Structure structureOf(const Family& family, const Cases& cases, int i) {
  Random random = cases.random(i);
  Structure structure = family.make(random);
  structure.scene.settings.unmerging.rule = cases.rule;
  return structure;
}

Sum run(const Family& family, const Cases& cases) {
  Sum sum;
  for (int i = 0; i < cases.count; ++i) {
    const Structure s = structureOf(family, cases, i);
    const double merged = timeOfFall(s, s.scene, Mode::Merge);
    const double soft = timeOfFall(s, s.scene, Mode::Reference);
    const double hard = timeOfFall(s, hardened(s.scene), Mode::Reference);
    const Verdict verdict = judge(merged, soft, hard, s.until);
    sum.count(verdict);
    if (cases.quiet) continue;
    fmt::print("{}{} {} {:4} {:14} {:2} bodies: {} s, reference {} s, hard {} s\n",
               kMarks[static_cast<std::size_t>(verdict.outcome)], verdict.is_apart ? "~" : " ",
               family.name, cases.seed + static_cast<unsigned>(i), s.kind, s.watched.size(),
               shown(merged), shown(soft), shown(hard));
    std::fflush(stdout);
  }
  print(family.name, cases.count, sum);
  return sum;
}

void run(const std::string& name, const Cases& cases) {
  Sum sum;
  int count = 0;
  for (const Family& family : kFamilies) {
    if (name != "all" && name != family.name) continue;
    sum += run(family, cases);
    count += cases.count;
  }
  if (name == "all") print("all", count, sum);
}

}  // namespace
}  // namespace merge2d::bench

int main(int argc, char** argv) {
  using namespace merge2d::bench;
  CLI::App app{"Random structures that fall, merged and in two references"};
  Cases cases{.count = 140};
  std::string name = "all";
  std::vector<std::string> names{"all"};
  for (const Family& family : kFamilies) names.emplace_back(family.name);
  bool toml = false;
  app.add_option("--family", name, "Which, or all of them")->check(CLI::IsMember(names));
  app.add_flag("--toml", toml, "Print the scene of the first case instead");
  cases.addTo(app);
  CLI11_PARSE(app, argc, argv);
  if (!toml) {
    run(name, cases);
    return 0;
  }
  for (const Family& family : kFamilies) {
    if (name == family.name) fmt::print("{}", toToml(structureOf(family, cases, 0).scene));
  }
  return 0;
}
