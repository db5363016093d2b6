#include "render/outline_path.h"

#include <fmt/format.h>

#include <cmath>

namespace merge2d {
namespace {

float dot(Pixel a, Pixel b) { return a.x * b.x + a.y * b.y; }

Pixel unit(Pixel v) {
  const float length = std::hypot(v.x, v.y);
  return length > 0.0F ? v * (1.0F / length) : Pixel{1.0F, 0.0F};
}

/// To the outside of an edge of corners that go clockwise as seen (y points down).
Pixel outward(Pixel along) { return unit({along.y, -along.x}); }

/// The part at least `depth` inside of the line through `from` along `along`.
std::vector<Pixel> clipped(const std::vector<Pixel>& corners, Pixel from, Pixel along,
                           float depth) {
  const Pixel normal = outward(along);
  const auto beyond = [&](Pixel p) { return dot(p - from, normal) + depth; };
  std::vector<Pixel> out;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Pixel a = corners[i], b = corners[(i + 1) % corners.size()];
    const float da = beyond(a), db = beyond(b);
    if (da <= 0.0F) out.push_back(a);
    if ((da < 0.0F && db > 0.0F) || (da > 0.0F && db < 0.0F)) {
      out.push_back(a + (b - a) * (da / (da - db)));
    }
  }
  return out;
}

std::vector<Pixel> shrunk(const std::vector<Pixel>& core, float depth) {
  std::vector<Pixel> inner = core;
  for (std::size_t i = 0; i < core.size(); ++i) {
    inner = clipped(inner, core[i], core[(i + 1) % core.size()] - core[i], depth);
  }
  return inner.size() < 3 ? std::vector<Pixel>() : inner;
}

std::string point(Pixel p) { return shortNumber(p.x) + " " + shortNumber(p.y); }

std::string straightPath(const std::vector<Pixel>& corners) {
  std::string path;
  for (const Pixel corner : corners) path += (path.empty() ? "M" : "L") + point(corner);
  return path.empty() ? path : path + "Z";
}

std::string circlePath(Pixel center, float radius) {
  const std::string r = shortNumber(radius);
  const std::string arc = fmt::format("A{} {} 0 1 1 ", r, r);
  return fmt::format("M{}{}{}{}{}Z", point(center - Pixel{radius, 0.0F}), arc,
                     point(center + Pixel{radius, 0.0F}), arc, point(center - Pixel{radius, 0.0F}));
}

}  // namespace

std::string shortNumber(float value) {
  const double rounded = std::round(100.0 * static_cast<double>(value)) / 100.0;
  return fmt::format("{}", rounded == 0.0 ? 0.0 : rounded);
}

std::vector<Pixel> coreOf(const ShapeInstance& shape, const std::vector<Edge>& edges) {
  const Pixel u = shape.axis, v{-shape.axis.y, shape.axis.x};
  const auto placed = [&](float x, float y) { return shape.center + u * x + v * y; };
  if (shape.edge_count > 0) {
    std::vector<Pixel> corners;
    const auto first = static_cast<std::size_t>(shape.first_edge);
    for (std::size_t i = 0; i < static_cast<std::size_t>(shape.edge_count); ++i) {
      const Pixel from = edges[first + i].from;
      corners.push_back(placed(from.x, from.y));
    }
    return corners;
  }
  const Pixel h = shape.half;
  if (h.x == 0.0F && h.y == 0.0F) return {shape.center};
  if (h.y == 0.0F) return {placed(-h.x, 0.0F), placed(h.x, 0.0F)};
  if (h.x == 0.0F) return {placed(0.0F, -h.y), placed(0.0F, h.y)};
  return {placed(-h.x, -h.y), placed(h.x, -h.y), placed(h.x, h.y), placed(-h.x, h.y)};
}

std::string outlinePath(const std::vector<Pixel>& core, float radius) {
  constexpr float kNothing = 1e-3F;  // px
  if (radius < -kNothing) return core.size() < 3 ? "" : straightPath(shrunk(core, -radius));
  if (radius <= kNothing) return core.size() < 3 ? "" : straightPath(core);
  if (core.size() == 1) return circlePath(core[0], radius);
  const std::string r = shortNumber(radius);
  std::string path;
  for (std::size_t i = 0; i < core.size(); ++i) {
    const Pixel from = core[i], to = core[(i + 1) % core.size()];
    const Pixel after = core[(i + 2) % core.size()];
    const Pixel out = outward(to - from) * radius, next = outward(after - to) * radius;
    path += (path.empty() ? "M" : "L") + point(from + out) + "L" + point(to + out);
    path += fmt::format("A{} {} 0 0 1 {}", r, r, point(to + next));
  }
  return path + "Z";
}

}  // namespace merge2d
