#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "linewright/base/geometry.hpp"
#include "linewright/map/occupancy_grid.hpp"

namespace linewright {

/// What became of the search for a way.
enum class RouteStatus : std::uint8_t {
  kFound,
  kStartOccupied,  ///< no free cell near the start: move the start, or make the obstacle smaller
  kGoalOccupied,   ///< no free cell near the goal: move the goal, or make the obstacle smaller
  kUnreachable,    ///< both ends are free, but no way is wide enough: widen an aisle
};

/// A way from one point to another.
struct GridRoute {
  RouteStatus status = RouteStatus::kUnreachable;
  double metres = 0.0;       ///< length of `path`; 0 unless found
  std::vector<Point2> path;  ///< both ends included; empty unless found
};

struct GridRouteOptions {
  /// A point in an occupied cell is reached through the nearest free cell whose centre is within
  /// this many metres (the last bit of the way then leads through the obstacle's margin).
  double snap_m = 1.5;
};

/// The free cell that stands for a point: its own, or the nearest one within `snap_m` of it
/// (equally near: the first one row by row). None when there is none.
[[nodiscard]] std::optional<Cell> free_cell_near(const OccupancyGrid& grid, Point2 point,
                                                 double snap_m);

/// The ways between all pairs of points, as `routes[from][to]`. The way back is the way there
/// reversed, so lengths are symmetric.
///
/// The search is 8-connected with octile cost and never cuts a corner; the polyline is then pulled
/// straight wherever all cells under it are free. One Dijkstra per point: the time is about
/// 25 ns * points * cells of the grid.
[[nodiscard]] std::vector<std::vector<GridRoute>> grid_routes(const OccupancyGrid& grid,
                                                              const std::vector<Point2>& points,
                                                              const GridRouteOptions& options = {});

/// Whether every cell that the segment passes through is free; through the corner of four cells it
/// passes all four.
[[nodiscard]] bool line_of_sight(const OccupancyGrid& grid, Point2 from, Point2 to);

}  // namespace linewright
