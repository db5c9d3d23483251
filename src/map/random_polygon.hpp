#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "linewright/base/random.hpp"
#include "linewright/map/polygon.hpp"

namespace linewright {

/// For tests: a number in [low, high).
inline double random_between(RandomStream& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

/// For tests: a simple polygon of 3 ... 9 corners around `middle`, counter-clockwise, seldom
/// convex. The middle sees all of it.
inline Polygon random_polygon(RandomStream& random, Point2 middle, double most_m) {
  const std::size_t corners = 3 + random.below(7);
  Polygon polygon;
  for (std::size_t i = 0; i < corners; ++i) {
    // One corner per sector, so that the middle stays inside.
    const double turn = (static_cast<double>(i) + random_between(random, 0.1, 0.6)) /
                        static_cast<double>(corners) * 2.0 * std::numbers::pi;
    const double radius_m = random_between(random, 0.2 * most_m, most_m);
    polygon.push_back(
        {middle.x_m + radius_m * std::cos(turn), middle.y_m + radius_m * std::sin(turn)});
  }
  return polygon;
}

}  // namespace linewright
