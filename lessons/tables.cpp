#include "lessons/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lessons/explain.h"
#include "lessons/lookup.h"

namespace merge2d {
namespace {

bool isNumber(const std::string& cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789.+-e%") == std::string::npos;
}

/// Of UTF-8, as terminals count.
std::size_t widthOf(const std::string& cell) {
  return static_cast<std::size_t>(std::ranges::count_if(
      cell, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string place(const Vec2& x) { return fmt::format("{:.3f}, {:.3f}", x.x(), x.y()); }
std::string number(double v) { return shortNumber(v); }

/// A record and what its tables are made of.
class StageTables {
 public:
  StageTables(const Words& words, const StepRecord& record, const RowFilter& filter)
      : words_(words), record_(record), filter_(filter) {}

  std::string of(Stage stage) const {
    switch (stage) {
      case Stage::ContactDetection:
        return contactsFound();
      case Stage::ContactOrdering:
        return order();
      case Stage::SleepAndWake:
        return decisions(stage);
      case Stage::WarmStart:
        return impulses(stage, false);
      case Stage::SingleIterationPGS:
        return impulses(stage, true);
      case Stage::Unmerge:
        return decisions(stage);
      case Stage::SolveLCP:
        return solved();
      case Stage::AdvanceVelocities:
        return velocities();
      case Stage::AccumulateRelativeMotion:
        return decisions(stage);
      case Stage::AdvancePositions:
        return positions();
      case Stage::Merge:
        return decisions(stage) + collections();
    }
    return {};
  }

 private:
  std::string a(BodyId id) const { return words_.name(id); }

  std::string contactsFound() const {
    TextTable table({"a", "b", "at [m]", "gap [m]", "new", ""});
    for (const ContactView& c : record_[Stage::ContactDetection].after.contacts) {
      if (!filter_.wants(c.a, c.b)) continue;
      table.add({a(c.a), a(c.b), place(c.x), number(c.gap), c.fresh ? "new" : "",
                 c.internal ? "merged" : ""},
                c.fresh      ? 2.0
                : c.internal ? 0.0
                             : 1.0);
    }
    for (const NotedPoint& p : record_.notes.pruned) {
      if (filter_.wants(p.a, p.b)) table.add({a(p.a), a(p.b), place(p.x), "", "", "pruned"}, 1.5);
    }
    return table.text(filter_.most);
  }

  std::string order() const {
    TextTable table({"place", "a", "b", "distance"});
    std::size_t rank = 0;
    for (const NotedVisit& v : record_.notes.order) {
      ++rank;
      if (!filter_.wants(v.a, v.b)) continue;
      table.add({fmt::format("{}", rank), a(v.a), a(v.b),
                 v.depth > 0 ? fmt::format("{}", v.depth) : "not reached"},
                -static_cast<double>(rank));
    }
    if (table.empty() && record_.notes.order.empty()) {
      return "No sweep goes breadth first in this step.\n";
    }
    return table.text(filter_.most);
  }

  std::string decisions(Stage stage) const {
    TextTable table({"a", "b", "verdict", "count", "at [m]", "test"});
    for (const Decision& d : record_[stage].after.decisions) {
      if (!filter_.wants(d.a, d.b)) continue;
      const bool calm = d.verdict == "keep" || d.verdict == "below" || d.verdict == "wait" ||
                        d.verdict == "carried" || d.verdict == "passed";
      const double ratio = std::min(closeness(d), 10.0);
      const std::string count = d.needed > 0 ? fmt::format("{}/{}", d.count, d.needed) : "";
      table.add({a(d.a), d.a == d.b ? "" : a(d.b), std::string(d.verdict), count,
                 d.at.isZero() ? "" : place(d.at), words_.test(d)},
                (calm ? 0.0 : 20.0) + ratio);
    }
    return table.text(filter_.most);
  }

  std::string impulses(Stage stage, bool compare) const {
    std::vector<std::string> head{"a", "b", "at [m]", "λ_n [N s]", "λ_t [N s]", "μ λ_n"};
    if (compare) head = {"a", "b", "λ_n before", "λ_n after", "λ_t before", "λ_t after", "μ λ_n"};
    TextTable table(head);
    const auto before = byKey(record_.before_stage(stage));
    for (const ContactView& c : record_[stage].after.contacts) {
      if (!filter_.wants(c.a, c.b)) continue;
      const std::string limit = number(c.mu * c.lambda_n);
      if (!compare) {
        table.add({a(c.a), a(c.b), place(c.x), number(c.lambda_n), number(c.lambda_t), limit},
                  c.lambda_n);
        continue;
      }
      const auto found = before.find(keyOf(c));
      const ContactView& old = found == before.end() ? c : *found->second;
      table.add({a(c.a), a(c.b), number(old.lambda_n), number(c.lambda_n), number(old.lambda_t),
                 number(c.lambda_t), limit},
                std::hypot(c.lambda_n - old.lambda_n, c.lambda_t - old.lambda_t));
    }
    return table.text(filter_.most);
  }

  std::string solved() const {
    TextTable table(
        {"a", "b", "λ_n [N s]", "λ_t [N s]", "of the cone", "w_n [m/s]", "w_t [m/s]", "state"});
    for (const ContactView& c : record_[Stage::SolveLCP].after.contacts) {
      if (c.internal || !filter_.wants(c.a, c.b)) continue;
      const double limit = c.mu * c.lambda_n;
      const double part = limit > 0.0 ? std::abs(c.lambda_t) / limit : 0.0;
      table.add({a(c.a), a(c.b), number(c.lambda_n), number(c.lambda_t),
                 fmt::format("{:.0f}%", 100.0 * part), number(c.w_n), number(c.w_t),
                 merge2d::name(c.state)},
                part + c.lambda_n * 1e-9);
    }
    return table.text(filter_.most);
  }

  std::string velocities() const {
    TextTable table({"body", "", "v before [m/s]", "v after [m/s]", "ω before", "ω after [rad/s]"});
    for (const BodyState& b : record_[Stage::AdvanceVelocities].after.bodies) {
      const BodyState* old = bodyIn(record_.before_stage(Stage::AdvanceVelocities), b.id);
      if (!filter_.wants(b.id) || old == nullptr || b.pinned) continue;
      table.add({a(b.id), b.collection == kNoCollection ? "" : collectionName(b.collection),
                 place(old->v), place(b.v), number(old->omega), number(b.omega)},
                (b.v - old->v).norm());
    }
    return table.text(filter_.most);
  }

  std::string positions() const {
    TextTable table({"body", "", "x, y before [m]", "x, y after [m]", "way [m]"});
    for (const BodyState& b : record_[Stage::AdvancePositions].after.bodies) {
      const BodyState* old = bodyIn(record_.before_stage(Stage::AdvancePositions), b.id);
      if (!filter_.wants(b.id) || old == nullptr || b.pinned) continue;
      const double way = (b.x - old->x).norm();
      table.add({a(b.id), b.collection == kNoCollection ? "" : collectionName(b.collection),
                 place(old->x), place(b.x), number(way)},
                way);
    }
    return table.text(filter_.most);
  }

  std::string collections() const {
    TextTable table({"collection", "bodies", "fixed to", "mass [kg]", "I [kg m²]", "centre [m]",
                     "v [m/s]", "box [m]"});
    for (const CollectionView& c : record_[Stage::Merge].after.collections) {
      const bool wanted = std::ranges::any_of(c.bodies, [&](BodyId b) { return filter_.wants(b); });
      if (!wanted) continue;
      table.add(
          {collectionName(c.id), fmt::format("{}", c.bodies.size()), c.anchored ? a(c.anchor) : "",
           number(c.mass), number(c.inertia), place(c.x), place(c.v),
           fmt::format("{} x {}", number(2.0 * c.box.half.x()), number(2.0 * c.box.half.y()))},
          static_cast<double>(c.bodies.size()));
    }
    return table.empty() ? "" : "\n" + table.text(filter_.most);
  }

  const Words& words_;
  const StepRecord& record_;
  const RowFilter& filter_;
};

}  // namespace

void TextTable::add(std::vector<std::string> row, double rank) {
  rows_.push_back({std::move(row), rank});
}

std::string TextTable::text(std::size_t most) const {
  if (rows_.empty()) return "(none)\n";
  std::vector<Row> rows = rows_;
  std::ranges::stable_sort(rows, std::ranges::greater{}, &Row::rank);
  const std::size_t left_out = rows.size() > most ? rows.size() - most : 0;
  rows.resize(rows.size() - left_out);
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < head_.size(); ++i) {
    std::size_t width = widthOf(head_[i]);
    for (const Row& row : rows) width = std::max(width, widthOf(row.cells[i]));
    widths.push_back(width);
  }
  std::string out;
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string room(widths[i] - widthOf(cells[i]), ' ');
      text += (i > 0 ? "  " : "") + (isNumber(cells[i]) ? room + cells[i] : cells[i] + room);
    }
    text.resize(text.find_last_not_of(' ') + 1);
    out += text + "\n";
  };
  line(head_);
  for (const Row& row : rows) line(row.cells);
  if (left_out > 0) out += fmt::format("… and {} more\n", left_out);
  return out;
}

bool RowFilter::wants(BodyId a, BodyId b) const {
  if (pair) return pair->first == std::min(a, b) && pair->second == std::max(a, b);
  return !body || *body == a || *body == b;
}

bool RowFilter::wants(BodyId a) const {
  if (pair) return a == pair->first || a == pair->second;
  return !body || *body == a;
}

const char* purpose(Stage stage) {
  static constexpr const char* kPurposes[kStages] = {
      "Which bodies touch, and where?",
      "Where is something new? A sweep by the paper's rule goes on from there.",
      "What has come to rest, and what is disturbed?",
      "Which collections bear a new load? Start from the contact impulses of the last step.",
      "One sweep (the paper's rule), or a search for the new loads, renews the forces inside.",
      "Which welds break, slide or turn, and which collections fall apart?",
      "Solve for the contact impulses of all that is simulated on its own.",
      "The solved velocities become the velocities.",
      "How does each touching pair move against each other, and for how long has it been still?",
      "Positions move on by h times the velocity.",
      "Which pairs were still for long enough, and may become one?"};
  return kPurposes[static_cast<std::size_t>(stage)];
}

std::string stageTable(const Words& words, const StepRecord& record, Stage stage,
                       const RowFilter& filter) {
  return StageTables(words, record, filter).of(stage);
}

}  // namespace merge2d
