#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "linewright/map/collision_checker.hpp"

namespace linewright {

/// One bit per cell of the map, by index, 64 in a word: set unless a disc of this radius fits at no
/// point of the cell. To the safe side by at most a fifth of a cell where the disc is small; by 0.7
/// cells where it is many cells wide.
[[nodiscard]] std::vector<std::uint64_t> passable_cells(const ClearanceMap& map, double radius_m);

}  // namespace linewright
