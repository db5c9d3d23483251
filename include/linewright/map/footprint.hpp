#pragma once

#include "linewright/map/polygon.hpp"

namespace linewright {

/// The floor that a worker covers, seen from the point that its pose names: x forward, y left,
/// metres. A disc around that point, or a simple polygon anywhere around it.
class Footprint {
 public:
  /// A disc. `radius_m` >= 0.
  [[nodiscard]] static Footprint circle(double radius_m);
  /// A rectangle with the pose in its middle. Both lengths > 0.
  [[nodiscard]] static Footprint rectangle(double length_m, double width_m);
  /// A polygon without fault (`polygon_fault`), convex or not.
  [[nodiscard]] static Footprint polygon(Polygon corners);

  [[nodiscard]] bool is_circle() const { return corners_.empty(); }
  [[nodiscard]] bool is_convex() const { return convex_; }
  /// Empty for a circle; counter-clockwise.
  [[nodiscard]] const Polygon& corners() const { return corners_; }

  /// Radius of the largest disc around the pose that is all covered; 0 when the pose lies outside.
  [[nodiscard]] double inscribed_m() const { return inscribed_m_; }
  /// Radius of the smallest disc around the pose that covers all of it.
  [[nodiscard]] double circumscribed_m() const { return circumscribed_m_; }

  /// The same, larger by `margin_m` on all sides (convex polygons: the sides move out, the corners
  /// stay corners), or smaller when negative, by at most half the inscribed radius. Other polygons
  /// become their convex hull first, to the safe side.
  [[nodiscard]] Footprint grown(double margin_m) const;

  /// The corners of a polygon at a pose.
  [[nodiscard]] Polygon at(const Pose2& pose) const;

 private:
  Polygon corners_;
  bool convex_ = true;
  double inscribed_m_ = 0.0;
  double circumscribed_m_ = 0.0;
};

}  // namespace linewright
