#include "linewright/map/polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace linewright {
namespace {

double cross(Point2 origin, Point2 a, Point2 b) {
  return (a.x_m - origin.x_m) * (b.y_m - origin.y_m) - (a.y_m - origin.y_m) * (b.x_m - origin.x_m);
}

double distance_to_segment_m(Point2 point, Point2 a, Point2 b) {
  const double dx = b.x_m - a.x_m;
  const double dy = b.y_m - a.y_m;
  const double squared = dx * dx + dy * dy;
  double share = 0.0;
  if (squared > 0.0) {
    share = std::clamp(((point.x_m - a.x_m) * dx + (point.y_m - a.y_m) * dy) / squared, 0.0, 1.0);
  }
  return distance_m(point, {a.x_m + share * dx, a.y_m + share * dy});
}

bool on_segment(Point2 point, Point2 a, Point2 b) {
  return std::min(a.x_m, b.x_m) <= point.x_m && point.x_m <= std::max(a.x_m, b.x_m) &&
         std::min(a.y_m, b.y_m) <= point.y_m && point.y_m <= std::max(a.y_m, b.y_m);
}

bool segments_meet(Point2 a, Point2 b, Point2 c, Point2 d) {
  const double c_side = cross(a, b, c);
  const double d_side = cross(a, b, d);
  const double a_side = cross(c, d, a);
  const double b_side = cross(c, d, b);
  if (((c_side > 0) != (d_side > 0)) && ((a_side > 0) != (b_side > 0)) && c_side != 0 &&
      d_side != 0 && a_side != 0 && b_side != 0) {
    return true;
  }
  return (c_side == 0 && on_segment(c, a, b)) || (d_side == 0 && on_segment(d, a, b)) ||
         (a_side == 0 && on_segment(a, c, d)) || (b_side == 0 && on_segment(b, c, d));
}

/// The corner where the sides before and after it meet once both have moved out by `margin_m`.
Point2 moved_out(Point2 before, Point2 corner, Point2 after, double margin_m) {
  const auto normal = [](Point2 a, Point2 b) {
    const double length = distance_m(a, b);
    return Point2{(b.y_m - a.y_m) / length, (a.x_m - b.x_m) / length};
  };
  const Point2 n = normal(before, corner);
  const Point2 m = normal(corner, after);
  const double scale = margin_m / (1.0 + n.x_m * m.x_m + n.y_m * m.y_m);
  return {corner.x_m + (n.x_m + m.x_m) * scale, corner.y_m + (n.y_m + m.y_m) * scale};
}

}  // namespace

Polygon corners_of(const Rectangle& r) {
  return {{r.x0_m, r.y0_m}, {r.x1_m, r.y0_m}, {r.x1_m, r.y1_m}, {r.x0_m, r.y1_m}};
}

std::optional<std::string> polygon_fault(const Polygon& corners) {
  const std::size_t count = corners.size();
  if (count < 3) return fmt::format("it has {} corners, and needs three at least", count);
  for (std::size_t i = 0; i < count; ++i) {
    if (distance_m(corners[i], corners[(i + 1) % count]) > 0.0) continue;
    return fmt::format("corners {} and {} are one point", i + 1, (i + 1) % count + 1);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Point2 a = corners[i];
    const Point2 b = corners[(i + 1) % count];
    // The next side shares a corner with this one; it may only go on, not back.
    const Point2 next = corners[(i + 2) % count];
    if (cross(a, b, next) == 0.0 &&
        (b.x_m - a.x_m) * (next.x_m - b.x_m) + (b.y_m - a.y_m) * (next.y_m - b.y_m) < 0.0) {
      return fmt::format("it goes back on itself at corner {}", (i + 1) % count + 1);
    }
    for (std::size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j + 1 == count) continue;  // neighbours
      if (segments_meet(a, b, corners[j], corners[(j + 1) % count])) {
        return fmt::format("the sides after corners {} and {} cross or touch", i + 1, j + 1);
      }
    }
  }
  return std::nullopt;
}

double doubled_area_m2(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += cross(polygon[0], polygon[i], polygon[i + 1]);
  }
  return sum;
}

bool is_convex(const Polygon& polygon) {
  bool left = false;
  bool right = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const double turn =
        cross(polygon[i], polygon[(i + 1) % polygon.size()], polygon[(i + 2) % polygon.size()]);
    left = left || turn > 0.0;
    right = right || turn < 0.0;
  }
  return !(left && right);
}

bool contains(const Polygon& polygon, Point2 point) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2 a = polygon[i];
    const Point2 b = polygon[j];
    if ((a.y_m > point.y_m) == (b.y_m > point.y_m)) continue;
    if (point.x_m < a.x_m + (b.x_m - a.x_m) * (point.y_m - a.y_m) / (b.y_m - a.y_m)) {
      inside = !inside;
    }
  }
  return inside;
}

double distance_to_m(Point2 point, const Polygon& polygon) {
  if (contains(polygon, point)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    nearest = std::min(nearest,
                       distance_to_segment_m(point, polygon[i], polygon[(i + 1) % polygon.size()]));
  }
  return nearest;
}

Polygon convex_hull(Polygon points) {
  std::sort(points.begin(), points.end(),
            [](Point2 a, Point2 b) { return a.x_m != b.x_m ? a.x_m < b.x_m : a.y_m < b.y_m; });
  // Andrew's monotone chain.
  Polygon hull;
  const auto add = [&](Point2 point, std::size_t floor) {
    while (hull.size() >= floor + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0.0) {
      hull.pop_back();
    }
    hull.push_back(point);
  };
  for (const Point2 point : points) add(point, 0);
  const std::size_t floor = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], floor);
  hull.pop_back();
  return hull;
}

Polygon grown(const Polygon& convex, double margin_m) {
  Polygon grown;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    grown.push_back(moved_out(convex[(i + convex.size() - 1) % convex.size()], convex[i],
                              convex[(i + 1) % convex.size()], margin_m));
  }
  return grown;
}

Rectangle bounds_of(const Polygon& polygon) {
  Rectangle r{polygon[0].x_m, polygon[0].x_m, polygon[0].y_m, polygon[0].y_m};
  for (const Point2 corner : polygon) {
    r.x0_m = std::min(r.x0_m, corner.x_m);
    r.x1_m = std::max(r.x1_m, corner.x_m);
    r.y0_m = std::min(r.y0_m, corner.y_m);
    r.y1_m = std::max(r.y1_m, corner.y_m);
  }
  return r;
}

}  // namespace linewright
