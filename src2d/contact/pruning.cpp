/// Contact pruning per pair of bodies: compounds touch with several pairs of shapes, and a flat
/// side made of many pieces would otherwise rest on many points (Section 2, "Collision Detection").

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "src2d/contact/detection.h"
#include "src2d/dynamics/scratch.h"

namespace merge2d {
namespace {

/// Points belong to one flat region when their normals differ by less than this angle [rad] …
constexpr double kSameNormal = 0.02;
/// … and they lie in one line along the tangent up to this height [m], relative to the region.
constexpr double kSameLine = 0.005;
/// The outermost two stand for what is between them, unless it is nearer than they let it [m].
constexpr double kNearer = 1e-4;

double placeIn(const FlatRegion& region, const ContactPoint& point) {
  return perpendicular(region.normal).dot(point.position);
}

/// The gap between the outermost points, as that of a straight line.
double gapAt(const FlatRegion& r, double at) {
  const double part = r.high_at > r.low_at ? (at - r.low_at) / (r.high_at - r.low_at) : 0.0;
  return r.low->gap + part * (r.high->gap - r.low->gap);
}

bool keeps(const FlatRegion& region, const ContactPoint& point) {
  if (&point == region.low || &point == region.high) return true;
  return point.gap < gapAt(region, placeIn(region, point)) - kNearer;
}

/// Where a point belongs, or the end.
auto regionOf(std::vector<FlatRegion>& regions, const Vec2& normal, const ContactPoint& point) {
  return std::find_if(regions.begin(), regions.end(), [&](const FlatRegion& r) {
    return std::abs(cross(r.normal, normal)) < kSameNormal && r.normal.dot(normal) > 0.0 &&
           std::abs(r.normal.dot(point.position) - r.height) < kSameLine;
  });
}

void addTo(std::vector<FlatRegion>& regions, const Vec2& normal, const ContactPoint& point) {
  auto region = regionOf(regions, normal, point);
  if (region == regions.end()) {
    regions.push_back({.normal = normal, .height = normal.dot(point.position)});
    region = regions.end() - 1;
  }
  const double at = placeIn(*region, point);
  if (!region->low || at < region->low_at) region->low = &point, region->low_at = at;
  if (!region->high || at > region->high_at) region->high = &point, region->high_at = at;
}

/// Calls `visit(contact, point)` for all points of a pair, which are in the frame of its first body
/// already.
template <class Visit>
void forEachPoint(ContactTable& table, const BodyPair& pair, Visit&& visit) {
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    Contact& contact = table[table.order[i]];
    for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
      visit(contact, contact.points[k]);
    }
  }
}

}  // namespace

void prunePair(ContactTable& table, const BodyPair& pair, PruneMemory& memory) {
  auto& regions = memory.regions;
  regions.clear();
  memory.keeps.clear();
  forEachPoint(table, pair, [&](Contact& contact, ContactPoint& point) {
    addTo(regions, contact.normal, point);
  });
  forEachPoint(table, pair, [&](Contact& contact, ContactPoint& point) {
    const auto region = regionOf(regions, contact.normal, point);
    memory.keeps.push_back(keeps(*region, point) ? 1 : 0);
  });
  auto kept = memory.keeps.begin();
  for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
    Contact& contact = table[table.order[i]];
    const auto count = std::exchange(contact.count, std::int16_t{0});
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      if (*kept++) contact.points[static_cast<std::size_t>(contact.count++)] = contact.points[k];
    }
  }
}

}  // namespace merge2d
