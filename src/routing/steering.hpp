#pragma once

#include <array>
#include <span>

#include "linewright/map/collision_checker.hpp"
#include "linewright/routing/path_planner.hpp"

namespace linewright {

/// A connection of two poses on an empty floor.
struct Connection {
  ReedsSheppCurve curve;  ///< with turns on the spot when the turning radius is 0
  double cost_m = 0.0;
};

/// The local planner: cheapest connections on an empty floor, and whether they collide. Poses are
/// in the frame of the grid.
class Steering {
 public:
  /// The footprint of `checker` includes the clearance. The checker stays alive.
  Steering(const CollisionChecker& checker, const Mover& mover, const PathPlannerOptions& options);

  [[nodiscard]] Connection connect(const Pose2& from, const Pose2& to) const;
  /// The same connection as one between nearby poses; count 0 when that does not exist.
  [[nodiscard]] Connection reconnect(const Pose2& from, const Pose2& to,
                                     const Connection& like) const;

  /// Whether the whole of the pieces is free, looking every 5 cm or less, and where the distance
  /// field allows more, less often. The start is taken to be free.
  [[nodiscard]] bool free(const Pose2& from, std::span<const PathSegment> pieces) const;

  [[nodiscard]] double cost_m(std::span<const PathSegment> pieces) const;
  [[nodiscard]] const DrivingCosts& costs() const { return costs_; }
  /// A circle that turns on the spot: its heading matters to nothing but the ends.
  [[nodiscard]] bool ignores_heading() const { return ignores_heading_; }
  [[nodiscard]] double turning_radius_m() const { return radius_m_; }

 private:
  [[nodiscard]] Connection turn_and_go(const Pose2& from, const Pose2& to) const;
  [[nodiscard]] bool piece_free(const Pose2& from, const PathSegment& piece) const;
  [[nodiscard]] double look_ahead_m(const Pose2& at) const;

  const CollisionChecker& checker_;
  double radius_m_;
  DrivingCosts costs_;
  double steering_change_m_;
  bool ignores_heading_;
};

}  // namespace linewright
