#include "linewright/map/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace linewright {
namespace {

double cross(Point2 origin, Point2 a, Point2 b) {
  return (a.x_m - origin.x_m) * (b.y_m - origin.y_m) - (a.y_m - origin.y_m) * (b.x_m - origin.x_m);
}

}  // namespace

Footprint Footprint::circle(double radius_m) {
  Footprint footprint;
  footprint.inscribed_m_ = footprint.circumscribed_m_ = radius_m;
  return footprint;
}

Footprint Footprint::rectangle(double length_m, double width_m) {
  return polygon(corners_of(Rectangle{-length_m / 2, length_m / 2, -width_m / 2, width_m / 2}));
}

Footprint Footprint::polygon(Polygon corners) {
  Footprint footprint;
  if (doubled_area_m2(corners) < 0.0) std::reverse(corners.begin(), corners.end());
  footprint.corners_ = std::move(corners);
  footprint.convex_ = linewright::is_convex(footprint.corners_);
  const Polygon& polygon = footprint.corners_;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 a = polygon[i];
    footprint.circumscribed_m_ = std::max(footprint.circumscribed_m_, distance_m({}, a));
    // To the line of the side: for a convex polygon that is the distance to the side or less.
    const Point2 b = polygon[(i + 1) % polygon.size()];
    nearest = std::min(nearest, std::abs(cross(a, b, {})) / distance_m(a, b));
  }
  footprint.inscribed_m_ = contains(polygon, {}) ? nearest : 0.0;
  return footprint;
}

Footprint Footprint::grown(double margin_m) const {
  margin_m = std::max(margin_m, -inscribed_m_ / 2);  // something is left when it shrinks
  if (is_circle()) return circle(circumscribed_m_ + margin_m);
  return polygon(linewright::grown(convex_hull(corners_), margin_m));
}

Polygon Footprint::at(const Pose2& pose) const {
  const double c = std::cos(pose.heading_rad);
  const double s = std::sin(pose.heading_rad);
  Polygon placed;
  placed.reserve(corners_.size());
  for (const Point2 p : corners_) {
    placed.push_back({pose.x_m + c * p.x_m - s * p.y_m, pose.y_m + s * p.x_m + c * p.y_m});
  }
  return placed;
}

}  // namespace linewright
