#include "src2d/trace/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace merge2d {

std::string csvField(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

CsvWriter::CsvWriter(std::ostream& out, bool timings, const Constants& constants)
    : out_(out), timings_(timings) {
  out_ << kCsvStart
       << "collections,asleep,contacts,internal_contacts,merges,unmerges,max_penetration,residual,"
          "kinetic_energy,potential_energy,momentum_x,momentum_y,angular_momentum"
       << (timings_ ? ",seconds" : "");
  for (const auto& [column, text] : constants) {
    out_ << ',' << csvField(column);
    end_ += ',' + csvField(text);
  }
  out_ << '\n';
}

void CsvWriter::add(const Snapshot& snapshot) {
  const Stats& s = snapshot.stats;
  const auto count = [&](EventType type) {
    return std::ranges::count(snapshot.events, type, &Event::type);
  };
  out_ << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", snapshot.step,
                      snapshot.time, s.bodies, s.active_bodies, s.collections, s.asleep, s.contacts,
                      s.internal_contacts, count(EventType::Merge), count(EventType::Unmerge),
                      s.max_penetration, s.residual, s.kinetic_energy, s.potential_energy,
                      s.momentum.x(), s.momentum.y(), s.angular_momentum);
  if (timings_)
    out_ << fmt::format(",{}", std::accumulate(s.seconds.begin(), s.seconds.end(), 0.0));
  out_ << end_ << '\n';
}

}  // namespace merge2d
