#pragma once

#include <numbers>

#include "linewright/base/random.hpp"
#include "linewright/map/collision_checker.hpp"

namespace linewright {

/// A hall with random boxes until about `percent` of its cells are occupied. For tests and
/// benchmarks.
inline OccupancyGrid random_hall(RandomStream& random, std::int32_t columns, std::int32_t rows,
                                 double cell_m, std::size_t percent) {
  OccupancyGrid grid({.origin = {}, .cell_m = cell_m, .columns = columns, .rows = rows});
  std::size_t occupied = 0;
  while (occupied * 100 < percent * grid.size()) {
    const std::int32_t width = random.between(2, 12);
    const std::int32_t height = random.between(2, 12);
    const std::int32_t left = random.between(0, columns - 1);
    const std::int32_t low = random.between(0, rows - 1);
    for (std::int32_t row = low; row < std::min(rows, low + height); ++row) {
      for (std::int32_t column = left; column < std::min(columns, left + width); ++column) {
        occupied += grid.blocked({column, row}) ? 0 : 1;
        grid.set({column, row}, CellState::kOccupied);
      }
    }
  }
  return grid;
}

/// A pose at which a disc of this radius is free, in the frame of the grid.
inline Pose2 random_free_pose(RandomStream& random, const ClearanceMap& map, double radius_m) {
  const GridFrame& frame = map.frame();
  while (true) {
    const Pose2 pose{random.uniform() * frame.columns * frame.cell_m,
                     random.uniform() * frame.rows * frame.cell_m,
                     std::numbers::pi * (2.0 * random.uniform() - 1.0)};
    const Cell cell{static_cast<std::int32_t>(pose.x_m / frame.cell_m),
                    static_cast<std::int32_t>(pose.y_m / frame.cell_m)};
    if (map.distance_cells(cell) * frame.cell_m > radius_m + 1.5 * frame.cell_m) return pose;
  }
}

}  // namespace linewright
