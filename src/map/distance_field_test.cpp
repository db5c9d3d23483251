#include "linewright/map/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linewright/base/random.hpp"

namespace linewright {
namespace {

float by_looking_everywhere(const OccupancyGrid& grid, Cell cell) {
  double nearest = 1e300;
  for (std::int32_t row = -1; row <= grid.rows(); ++row) {
    for (std::int32_t column = -1; column <= grid.columns(); ++column) {
      if (!grid.blocked({column, row})) continue;
      nearest = std::min(nearest, std::hypot(column - cell.column, row - cell.row));
    }
  }
  return static_cast<float>(nearest);
}

TEST(DistanceField, IsExactOnRandomGrids) {
  RandomStream random(5);
  for (int trial = 0; trial < 60; ++trial) {
    OccupancyGrid grid({.origin = {},
                        .cell_m = 0.5,
                        .columns = random.between(1, 40),
                        .rows = random.between(1, 30)});
    const std::size_t obstacles = random.below(1 + grid.size() / 5);
    for (std::size_t i = 0; i < obstacles; ++i) {
      grid.set(grid.frame().cell(random.below(grid.size())),
               random.below(4) == 0 ? CellState::kUnknown : CellState::kOccupied);
    }
    const std::vector<float> field = distance_field(grid);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      ASSERT_EQ(field[i], by_looking_everywhere(grid, grid.frame().cell(i))) << trial << " " << i;
    }
  }
}

TEST(DistanceField, OfAnEmptyHallIsTheDistanceToItsEdge) {
  const OccupancyGrid grid({.origin = {}, .cell_m = 0.1, .columns = 5, .rows = 9});
  const std::vector<float> field = distance_field(grid);
  EXPECT_EQ(field[grid.frame().index({2, 4})], 3.0F);
  EXPECT_EQ(field[grid.frame().index({0, 4})], 1.0F);
}

}  // namespace
}  // namespace linewright
