#pragma once

#include <cstdint>
#include <vector>

#include "linewright/base/geometry.hpp"
#include "linewright/line/workers.hpp"

namespace linewright {

/// What became of the search for a path.
enum class PathStatus : std::uint8_t {
  kFound,
  kStartOccupied,  ///< the footprint collides at the start: move the start or the obstacle
  kGoalOccupied,   ///< the footprint collides at the goal: move the goal or the obstacle
  kNoAisle,        ///< no aisle is wide enough even for the footprint's narrowest part: widen one
  kNoManoeuvre,    ///< aisles are wide enough, but not to turn in: smaller turning radius or
                   ///< footprint, or a finer grid
  kSearchLimit,    ///< given up after PathPlannerOptions::most_expansions: allow more
};

/// "found", "start occupied", ...
[[nodiscard]] const char* name_of(PathStatus status);

/// A piece of a path: straight, on an arc of the path's turning radius, or a turn on the spot.
struct PathSegment {
  enum class Kind : std::uint8_t { kStraight, kLeft, kRight, kTurn };

  Kind kind = Kind::kStraight;
  /// Metres along the piece, negative: backwards. kTurn: radians, positive counter-clockwise.
  double amount = 0.0;
};

/// A path in closed form: curvature and ends are exact.
struct Path {
  PathStatus status = PathStatus::kNoAisle;
  Pose2 start;
  double turning_radius_m = 0.0;
  std::vector<PathSegment> segments;  ///< empty unless found, or when nothing is to be done

  [[nodiscard]] bool found() const { return status == PathStatus::kFound; }
  /// Length, backwards pieces included; turns on the spot have none.
  [[nodiscard]] double metres() const;
  /// Sum of all turns on the spot, radians.
  [[nodiscard]] double turned_rad() const;
  /// Pieces that are driven in the other direction than the one before.
  [[nodiscard]] int direction_changes() const;
  [[nodiscard]] Pose2 end() const;
};

/// The pose after the first `amount` (of the piece's sign) of a segment of that kind.
[[nodiscard]] Pose2 advanced(const Pose2& from, PathSegment::Kind kind, double amount,
                             double turning_radius_m);

/// Poses on the path: both ends, every joint, and between them at most `step_m` apart (turns on the
/// spot: `step_rad`). `step_m`, `step_rad` > 0.
[[nodiscard]] std::vector<Pose2> sampled(const Path& path, double step_m, double step_rad = 0.1);

/// How fast a path is driven.
struct Motion {
  double speed_mps = 1.0;          ///< > 0
  double turn_rate_radps = 0.0;    ///< 0: turning on the spot takes no time
  double acceleration_mps2 = 0.0;  ///< 0: full speed at once. The worker stands still at both ends,
                                   ///< at each change of direction and at each turn on the spot
};

/// Seconds from standing start to standstill.
[[nodiscard]] double travel_seconds(const Path& path, const Motion& motion);

/// The path as poses with shares of its travel time: `sampled` at steps fit for drawing and
/// simulating (straight pieces need two points only).
[[nodiscard]] std::vector<WayPoint> way_points(const Path& path, const Motion& motion);

}  // namespace linewright
