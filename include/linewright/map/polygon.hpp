#pragma once

#include <optional>
#include <string>
#include <vector>

#include "linewright/base/geometry.hpp"

namespace linewright {

/// An axis-parallel rectangle, metres. x0 < x1 and y0 < y1.
struct Rectangle {
  double x0_m = 0.0;
  double x1_m = 0.0;
  double y0_m = 0.0;
  double y1_m = 0.0;
};

/// Corners of a simple polygon in order, metres, without the first one repeated at the end.
using Polygon = std::vector<Point2>;

/// Its four corners, counter-clockwise from the smallest one.
[[nodiscard]] Polygon corners_of(const Rectangle& rectangle);

/// What keeps the corners from being a simple polygon with an area (fewer than three corners, sides
/// that cross or touch, no area), in words; none when nothing does.
[[nodiscard]] std::optional<std::string> polygon_fault(const Polygon& corners);

/// Twice the area: positive when the corners go counter-clockwise.
[[nodiscard]] double doubled_area_m2(const Polygon& polygon);

/// Whether all corners turn the same way.
[[nodiscard]] bool is_convex(const Polygon& polygon);

/// Whether the point lies within the polygon (on its edge: either answer).
[[nodiscard]] bool contains(const Polygon& polygon, Point2 point);

/// Distance from the point to the polygon's area; 0 inside of it.
[[nodiscard]] double distance_to_m(Point2 point, const Polygon& polygon);

/// The smallest convex polygon around the points (three at least, not all in a line),
/// counter-clockwise, without corners on straight sides.
[[nodiscard]] Polygon convex_hull(Polygon points);

/// A counter-clockwise convex polygon with all sides moved out by `margin_m`; the corners stay
/// corners.
[[nodiscard]] Polygon grown(const Polygon& convex, double margin_m);

/// The smallest axis-parallel rectangle around the points, of which there must be one at least.
[[nodiscard]] Rectangle bounds_of(const Polygon& polygon);

}  // namespace linewright
