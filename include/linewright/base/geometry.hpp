#pragma once

namespace linewright {

/// A point in the frame `map`, metres (REP-103: x forward, y left).
struct Point2 {
  double x_m = 0.0;
  double y_m = 0.0;
};

/// A pose in the frame `map`: metres and radians, yaw counter-clockwise from +x.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;

  [[nodiscard]] Point2 point() const { return {x_m, y_m}; }
};

/// Euclidean distance in metres.
[[nodiscard]] double distance_m(Point2 a, Point2 b);

}  // namespace linewright
