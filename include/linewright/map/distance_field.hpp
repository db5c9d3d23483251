#pragma once

#include <vector>

#include "linewright/map/occupancy_grid.hpp"

namespace linewright {

/// For every cell the exact Euclidean distance, in cells, from its middle to the middle of the
/// nearest blocked cell (0 for a blocked cell); cells beyond the edge of the grid are blocked. Row
/// by row. Time and memory are linear in the number of cells (A. Meijster, J. Roerdink, W.
/// Hesselink: A general algorithm for computing distance transforms in linear time, 2000).
[[nodiscard]] std::vector<float> distance_field(const OccupancyGrid& grid);

}  // namespace linewright
