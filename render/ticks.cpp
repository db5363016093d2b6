#include "render/ticks.h"

#include <algorithm>
#include <cmath>

#include "render/camera.h"

namespace merge2d {

std::vector<double> ticks(double low, double high, int wanted) {
  std::vector<double> out;
  const double step = roundLength((high - low) / std::max(1, wanted) * 1.5);
  const double slack = 1e-9 * (high - low);
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; k += 1.0) {
    out.push_back(k * step == 0.0 ? 0.0 : k * step);
  }
  return out;
}

}  // namespace merge2d
