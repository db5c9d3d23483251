#include "any_angle_bound.hpp"

#include <gtest/gtest.h>

#include "linewright/routing/hybrid_a_star.hpp"
#include "random_hall.hpp"

namespace linewright {
namespace {

TEST(AnyAngleBound, IsTheTautWayAroundOneBox) {
  // A box of 2 m x 4 m between the two points, and a disc of 0.5 m.
  OccupancyGrid grid({.origin = {-3.0, 1.0, 0.3}, .cell_m = 0.5, .columns = 40, .rows = 40});
  for (std::int32_t column = 18; column < 22; ++column) {
    for (std::int32_t row = 16; row < 24; ++row) grid.set({column, row}, CellState::kOccupied);
  }
  const AnyAngleBound bound(grid, 0.5);
  const Point2 a = grid.frame().to_map(Point2{5.0, 10.0});
  const Point2 b = grid.frame().to_map(Point2{15.0, 10.0});
  // Two tangents to the rounded corners, two arcs, and the straight piece along the side.
  const double dx = 4.0;
  const double dy = 2.0;
  const double tangent = std::sqrt(dx * dx + dy * dy - 0.25);
  const double angle = std::atan2(dy, dx) + std::asin(0.5 / std::hypot(dx, dy));
  const double exact = 2.0 * tangent + 2.0 * 0.5 * angle + 2.0;
  EXPECT_LE(bound.metres(a, b), exact + 1e-9);
  EXPECT_GE(bound.metres(a, b), exact - 0.02);
  EXPECT_NEAR(bound.metres(a, grid.frame().to_map(Point2{5.0, 19.0})), 9.0, 1e-9);
}

TEST(AnyAngleBound, SaysWhenThereIsNoWay) {
  OccupancyGrid grid({.origin = {}, .cell_m = 0.5, .columns = 20, .rows = 20});
  for (std::int32_t i = 5; i <= 15; ++i) {
    for (const std::int32_t edge : {5, 15}) {
      grid.set({i, edge}, CellState::kOccupied);
      grid.set({edge, i}, CellState::kOccupied);
    }
  }
  const AnyAngleBound bound(grid, 0.2);
  EXPECT_EQ(bound.metres({5.0, 5.0}, {1.0, 1.0}), std::numeric_limits<double>::infinity());
  EXPECT_LT(bound.metres({5.0, 5.0}, {6.0, 6.5}), 2.0);
}

TEST(AnyAngleBound, NoPlannedWayIsShorter) {
  RandomStream random(81);
  for (int trial = 0; trial < 6; ++trial) {
    const OccupancyGrid grid = random_hall(random, 60, 60, 0.25, 12);
    const auto map = std::make_shared<const ClearanceMap>(grid);
    for (const Mover& mover :
         {Mover{Footprint::circle(0.3), 0.0}, Mover{Footprint::rectangle(1.4, 0.9), 0.8}}) {
      const AnyAngleBound bound(grid, mover.footprint.inscribed_m());
      HybridAStar planner(map, mover);
      for (int query = 0; query < 4; ++query) {
        const Pose2 start = random_free_pose(random, *map, 0.9);
        const Pose2 goal = random_free_pose(random, *map, 0.9);
        const Path path = planner.plan(start, goal);
        if (!path.found()) continue;
        EXPECT_GE(path.metres(), bound.metres(start.point(), goal.point()) - 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace linewright
