#include "linewright/base/geometry.hpp"

#include <cmath>

namespace linewright {

double distance_m(Point2 a, Point2 b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

}  // namespace linewright
