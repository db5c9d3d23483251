#include "aisles.hpp"

#include <gtest/gtest.h>

#include "random_hall.hpp"

namespace linewright {
namespace {

bool passable(const std::vector<std::uint64_t>& bits, std::size_t cell) {
  return ((bits[cell / 64] >> (cell % 64)) & 1U) != 0;
}

TEST(Aisles, NoCellIsLeftOutInWhichTheDiscFitsSomewhere) {
  RandomStream random(71);
  for (int trial = 0; trial < 40; ++trial) {
    const OccupancyGrid grid = random_hall(random, 61 + trial, 50, 0.25, 20);
    const auto map = std::make_shared<const ClearanceMap>(grid);
    const double radius_m = 1.3 * random.uniform();
    const auto bits = passable_cells(*map, radius_m);
    const CollisionChecker disc(map, Footprint::circle(radius_m));
    for (int i = 0; i < 5000; ++i) {
      const Pose2 pose{random.uniform() * grid.columns() * 0.25,
                       random.uniform() * grid.rows() * 0.25, 0.0};
      if (disc.free_exactly(pose)) {
        ASSERT_TRUE(passable(bits, grid.frame().index(grid.frame().cell_at(pose.point()))));
      }
    }
  }
}

TEST(Aisles, AnAisleThatIsTooNarrowIsClosed) {
  // Aisles of 1 ... 8 cells between walls.
  OccupancyGrid grid({.origin = {}, .cell_m = 0.25, .columns = 60, .rows = 30});
  std::vector<std::int32_t> middles;
  for (std::int32_t width = 1, column = 2; width <= 8; column += width + 1, ++width) {
    for (std::int32_t row = 0; row < 30; ++row) grid.set({column - 1, row}, CellState::kOccupied);
    for (std::int32_t row = 0; row < 30; ++row) {
      grid.set({column + width, row}, CellState::kOccupied);
    }
    middles.push_back(column + (width - 1) / 2);
  }
  const ClearanceMap map(grid);
  for (const double radius_m : {0.2, 0.3, 0.45, 0.6, 0.8}) {
    const auto bits = passable_cells(map, radius_m);
    for (std::size_t i = 0; i < middles.size(); ++i) {
      const double width_m = 0.25 * static_cast<double>(i + 1);
      const bool open = passable(bits, grid.frame().index({middles[i], 15}));
      if (width_m >= 2.0 * radius_m) {
        EXPECT_TRUE(open) << radius_m << " in " << width_m;
      }
      if (width_m < 2.0 * radius_m - 0.1) {
        EXPECT_FALSE(open) << radius_m << " in " << width_m;
      }
    }
  }
}

}  // namespace
}  // namespace linewright
