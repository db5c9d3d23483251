#include "linewright/map/occupancy_grid.hpp"

#include <gtest/gtest.h>

namespace linewright {
namespace {

TEST(OccupancyGrid, CoversItsBoundsAndNothingElse) {
  const OccupancyGrid grid({-1.0, 1.0, 0.0, 0.7}, 0.1);
  EXPECT_EQ(grid.columns(), 20);
  EXPECT_EQ(grid.rows(), 7);
  EXPECT_FALSE(grid.occupied({0, 0}));
  EXPECT_FALSE(grid.occupied({19, 6}));
  EXPECT_TRUE(grid.occupied({-1, 0}));
  EXPECT_TRUE(grid.occupied({20, 0}));
  EXPECT_TRUE(grid.occupied({0, 7}));
}

TEST(OccupancyGrid, CellCentreAndIndexBelongTogether) {
  const OccupancyGrid grid({-3.0, 5.0, 2.0, 9.0}, 0.25);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Cell cell = grid.cell(i);
    ASSERT_EQ(grid.index(cell), i);
    ASSERT_EQ(grid.cell_at(grid.center(cell)), cell);
  }
}

TEST(OccupancyGrid, PointsFarOutsideAreInNoCell) {
  const OccupancyGrid grid({0.0, 1.0, 0.0, 1.0}, 0.01);
  EXPECT_FALSE(grid.contains(grid.cell_at({1e300, -1e300})));
  EXPECT_TRUE(grid.occupied(grid.cell_at({-1e9, 0.5})));
}

TEST(OccupancyGrid, ObstacleOccupiesTheCellsItCoversPartOf) {
  OccupancyGrid grid({0.0, 4.0, 0.0, 4.0}, 1.0);
  grid.add_obstacle({1.0, 2.0, 1.0, 2.1}, 0.0);
  for (std::int32_t row = 0; row < 4; ++row) {
    for (std::int32_t column = 0; column < 4; ++column) {
      const bool covered = column == 1 && (row == 1 || row == 2);
      EXPECT_EQ(grid.occupied({column, row}), covered) << column << ", " << row;
    }
  }
}

TEST(OccupancyGrid, WallThinnerThanACellStillBlocks) {
  OccupancyGrid grid({0.0, 4.0, 0.0, 1.0}, 1.0);
  grid.add_obstacle({2.2, 2.3, 0.0, 1.0}, 0.0);
  EXPECT_TRUE(grid.occupied({2, 0}));
}

TEST(OccupancyGrid, ClearanceOccupiesExactlyTheCentresThatAreTooClose) {
  const Rectangle obstacle{2.0, 3.0, 2.0, 2.5};
  const double clearance_m = 0.7;
  OccupancyGrid grid({0.0, 6.0, 0.0, 6.0}, 0.1);
  grid.add_obstacle(obstacle, clearance_m);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double metres = distance_to_m(grid.center(grid.cell(i)), obstacle);
    if (metres < clearance_m - 1e-6) {
      EXPECT_TRUE(grid.occupied(grid.cell(i)));
    } else if (metres > clearance_m + 1e-6) {
      EXPECT_FALSE(grid.occupied(grid.cell(i)));
    }
  }
}

TEST(OccupancyGrid, DistanceToARectangleIsZeroInsideAndDiagonalAtCorners) {
  const Rectangle r{0.0, 2.0, 0.0, 1.0};
  EXPECT_DOUBLE_EQ(distance_to_m({1.0, 0.5}, r), 0.0);
  EXPECT_DOUBLE_EQ(distance_to_m({-3.0, 0.5}, r), 3.0);
  EXPECT_DOUBLE_EQ(distance_to_m({5.0, 5.0}, r), 5.0);
}

}  // namespace
}  // namespace linewright
