/// Random structures that are to fall, merged and in references: when do they?
///
///   families [--family NAME|all] [--cases N] [--seed N] [--rule default|paper] [--quiet] [--toml]
///
/// One reference has the settings of the merged run, one contacts ten times as hard and 100 sweeps.
/// Where the merged run agrees with neither, two more are asked: one in steps of a quarter, and one
/// by the direct solver. Where references differ by more than 0.3 s the case is decided by little,
/// and stands apart.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/families/family_list.h"
#include "src2d/scene/load.h"
#include "src2d/world.h"

namespace merge2d::bench {
namespace {

constexpr double kLate = 0.3;   // [s]
constexpr double kSlack = 2.0;  // after the end, for late falls [s]

/// Where a body is, seen from another.
struct Seen {
  Vec2 place = Vec2::Zero();
  double angle = 0.0;
};

Seen look(const Snapshot& now, const Watch& watch) {
  const BodyState &body = now.bodies[watch.body], &frame = now.bodies[watch.frame];
  return {frame.pose().toLocal(body.pose() * watch.at), body.angle - frame.angle};
}

/// Of the way, or the turn, that is a fall: of the body that has moved farthest.
double partOfFall(const Structure& s, const std::vector<Seen>& before, const Snapshot& now) {
  double most = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Watch& watch = s.watched[i];
    const Seen seen = look(now, watch);
    const Vec2 way = seen.place - before[i].place;
    const double moved = watch.along.isZero() ? way.norm() : std::abs(way.dot(watch.along));
    most = std::max({most, moved / watch.way, std::abs(seen.angle - before[i].angle) / watch.turn});
  }
  return most;
}

/// When the first of the watched bodies has moved so far, and a fifth less, or kNever [s]. Where a
/// structure slips in each swing a little, one swing more or less is a matter of little.
struct Fall {
  double time = kNever, nearly = kNever;
};

Fall fallOf(const Structure& structure, const Scene& scene, Mode mode) {
  World world(scene, {.mode = mode, .timings = false});
  Snapshot now;
  while (world.time() < structure.from) world.step();
  world.captureMotion(now);
  std::vector<Seen> before;
  for (const Watch& watch : structure.watched) before.push_back(look(now, watch));
  Fall fall;
  while (world.time() < structure.until + kSlack) {
    world.step();
    world.captureMotion(now);
    const double part = partOfFall(structure, before, now);
    if (part > 0.8) fall.nearly = std::min(fall.nearly, world.time());
    if (part <= 1.0) continue;
    fall.time = world.time();
    break;
  }
  return fall;
}

std::vector<Fall> fallsOf(const Structure& s, const std::vector<Scene>& references) {
  std::vector<Fall> falls;
  for (const Scene& scene : references) falls.push_back(fallOf(s, scene, Mode::Reference));
  return falls;
}

/// In short steps, and by the direct solver.
std::vector<Scene> dearReferencesOf(const Scene& scene) {
  Scene fine = hardened(scene), direct = fine;
  fine.step *= 0.25;
  direct.settings.solver.method = SolverMethod::Newton;
  return {fine, direct};
}

/// What merging made of a structure.
enum class Outcome { Falls, Stands, Never, Late, Early, Wrong };

struct Verdict {
  Outcome outcome = Outcome::Falls;
  bool is_apart = false;  ///< the references differ

  bool isOff() const { return outcome != Outcome::Falls && outcome != Outcome::Stands; }
};

Verdict judge(const Fall& merged, const std::vector<Fall>& references, double until) {
  double first = kNever, nearly = kNever, last = 0.0;
  for (const Fall& fall : references) {
    first = std::min(first, fall.time);
    nearly = std::min(nearly, fall.nearly);
    last = std::max(last, fall.time);
  }
  const bool is_early = merged.time < nearly - kLate;
  if (first > until) return {merged.time <= until && is_early ? Outcome::Wrong : Outcome::Stands};
  const bool is_apart = last - first > kLate;
  if (is_early) return {Outcome::Early, is_apart};
  if (last == kNever || merged.nearly <= last + kLate) return {Outcome::Falls, is_apart};
  return {merged.nearly == kNever ? Outcome::Never : Outcome::Late, is_apart};
}

struct Sum {
  int fall = 0, never = 0, late = 0, early = 0, wrong = 0;
  int apart = 0, apart_off = 0;

  void count(const Verdict& v) {
    const Outcome o = v.outcome;
    if (v.is_apart) {
      ++apart;
      apart_off += v.isOff() ? 1 : 0;
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
      "{:11} {} cases: {} fall in all references; of these {} never fall merged, {} more than {} "
      "s late, {} as much early. {} fall that stand. References differ in {}, merged is outside "
      "of all in {}.\n",
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
    const Fall merged = fallOf(s, s.scene, Mode::Merge);
    std::vector<Fall> references = fallsOf(s, {s.scene, hardened(s.scene)});
    Verdict verdict = judge(merged, references, s.until);
    if (verdict.isOff()) {
      for (const Fall& fall : fallsOf(s, dearReferencesOf(s.scene))) references.push_back(fall);
      verdict = judge(merged, references, s.until);
    }
    sum.count(verdict);
    if (cases.quiet) continue;
    std::string times;
    for (const Fall& fall : references) times += fmt::format(" {}", shown(fall.time));
    fmt::print("{}{} {} {:4} {:14} {:2} bodies: {} s, references{} s\n",
               kMarks[static_cast<std::size_t>(verdict.outcome)], verdict.is_apart ? "~" : " ",
               family.name, cases.seed + static_cast<unsigned>(i), s.kind, s.watched.size(),
               shown(merged.time), times);
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
