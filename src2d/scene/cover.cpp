#include "src2d/scene/cover.h"

#include <algorithm>
#include <map>
#include <utility>

namespace merge2d {
namespace {

using Rects = std::vector<PixelRect>;

/// Runs of filled pixels in each row; equal runs in successive rows grow together.
Rects cutInRows(const Mask& mask) {
  Rects done;
  std::map<std::pair<int, int>, PixelRect> growing;  // by begin and width of the run
  for (int y = 0; y <= mask.height(); ++y) {
    std::map<std::pair<int, int>, PixelRect> next;
    for (int x = 0; x < mask.width(); ++x) {
      if (!mask.filled(x, y)) continue;
      const int begin = x;
      while (mask.filled(x, y)) ++x;
      const auto above = growing.extract({begin, x - begin});
      PixelRect run = above ? above.mapped() : PixelRect{begin, y, x - begin, 0};
      ++run.height;
      next.emplace(std::pair(begin, x - begin), run);
    }
    for (const auto& [key, finished] : growing) done.push_back(finished);
    growing.swap(next);
  }
  return done;
}

Mask transposed(const Mask& mask) {
  Mask result(mask.height(), mask.width());
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) result.set(y, x, mask.filled(x, y));
  }
  return result;
}

Rects cutInColumns(const Mask& mask) {
  Rects rects = cutInRows(transposed(mask));
  for (PixelRect& r : rects) r = {r.y, r.x, r.height, r.width};
  return rects;
}

/// The largest filled rectangle: below a row of column heights, each pixel asks how far its own
/// height reaches left and right (the histogram algorithm, with a stack).
PixelRect largestRectangle(const Mask& mask) {
  PixelRect best;
  std::vector<int> heights(static_cast<std::size_t>(mask.width()) + 1, 0);  // ends with a 0
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      int& height = heights[static_cast<std::size_t>(x)];
      height = mask.filled(x, y) ? height + 1 : 0;
    }
    std::vector<std::pair<int, int>> rising;  // (where a height begins, the height)
    for (int x = 0; x <= mask.width(); ++x) {
      const int height = heights[static_cast<std::size_t>(x)];
      int begin = x;
      while (!rising.empty() && rising.back().second >= height) {
        const auto [from, tall] = rising.back();
        if ((x - from) * tall > best.width * best.height) {
          best = {from, y - tall + 1, x - from, tall};
        }
        begin = from;
        rising.pop_back();
      }
      rising.emplace_back(begin, height);
    }
  }
  return best;
}

/// The largest rectangle first, then the largest of what is left. Empty when that takes too long.
Rects cutLargestFirst(Mask mask) {
  constexpr int kMostPixels = 1 << 16;
  constexpr std::size_t kMostRects = 200;
  Rects rects;
  if (mask.width() > kMostPixels / mask.height()) return rects;
  for (;;) {
    const PixelRect rect = largestRectangle(mask);
    if (rect.width == 0) return rects;
    if (rects.size() == kMostRects) return {};
    rects.push_back(rect);
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
      for (int x = rect.x; x < rect.x + rect.width; ++x) mask.set(x, y, false);
    }
  }
}

/// Cuts that end on the horizontal outer sides: a rectangle's left end, where the side goes on.
int horizontalSideCuts(const Mask& mask, const Rects& rects) {
  int cuts = 0;
  for (const PixelRect& r : rects) {
    for (const auto& [inside, outside] :
         {std::pair(r.y, r.y - 1), std::pair(r.y + r.height - 1, r.y + r.height)}) {
      const bool on_side = !mask.filled(r.x, outside);
      const bool goes_on = mask.filled(r.x - 1, inside) && !mask.filled(r.x - 1, outside);
      if (on_side && goes_on) ++cuts;
    }
  }
  return cuts;
}

}  // namespace

int sideCuts(const Mask& mask, const std::vector<PixelRect>& rectangles) {
  Rects turned = rectangles;
  for (PixelRect& r : turned) r = {r.y, r.x, r.height, r.width};
  return horizontalSideCuts(mask, rectangles) + horizontalSideCuts(transposed(mask), turned);
}

std::vector<PixelRect> coverByRectangles(const Mask& mask) {
  Rects best = cutInRows(mask);
  const auto cost = [&](const Rects& rects) {
    return std::pair(sideCuts(mask, rects), rects.size());
  };
  for (Rects other : {cutInColumns(mask), cutLargestFirst(mask)}) {
    if (!other.empty() && cost(other) < cost(best)) best = std::move(other);
  }
  return best;
}

}  // namespace merge2d
