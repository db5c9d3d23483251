#include "linewright/map/collision_checker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "linewright/base/random.hpp"

namespace linewright {
namespace {

OccupancyGrid random_grid(RandomStream& random, double cell_m, std::size_t permille) {
  OccupancyGrid grid({.origin = {}, .cell_m = cell_m, .columns = 150, .rows = 70});
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (random.below(1000) < permille) grid.set(grid.frame().cell(i), CellState::kOccupied);
  }
  return grid;
}

/// Whether one of many points of the footprint lies clearly inside of a blocked cell.
bool sampled_hit(const OccupancyGrid& grid, const Footprint& footprint, const Pose2& pose,
                 double size_m) {
  constexpr int kPoints = 120;
  const double reach = footprint.circumscribed_m() + size_m;
  const double c = std::cos(pose.heading_rad);
  const double s = std::sin(pose.heading_rad);
  for (int i = 0; i <= kPoints; ++i) {
    for (int j = 0; j <= kPoints; ++j) {
      const Point2 body{reach * (2.0 * i / kPoints - 1.0), reach * (2.0 * j / kPoints - 1.0)};
      const bool inside = footprint.is_circle()
                              ? std::hypot(body.x_m, body.y_m) < footprint.circumscribed_m()
                              : contains(footprint.corners(), body);
      if (!inside) continue;
      const Point2 at{pose.x_m + c * body.x_m - s * body.y_m,
                      pose.y_m + s * body.x_m + c * body.y_m};
      if (grid.blocked(grid.frame().cell_at(at))) return true;
    }
  }
  return false;
}

std::vector<Footprint> shapes() {
  return {Footprint::circle(0.3), Footprint::rectangle(1.4, 0.9),
          Footprint::polygon({{0.9, 0.0}, {-0.5, 0.4}, {-0.3, 0.0}, {-0.5, -0.4}}),  // an arrow
          Footprint::polygon({{0.2, 0.2}, {1.2, 0.2}, {1.2, 0.8}, {0.2, 0.8}})};  // beside its pose
}

TEST(CollisionChecker, FindsWhatSamplingFindsAndLittleMore) {
  RandomStream random(11);
  for (const double cell_m : {0.05, 0.25}) {
    const OccupancyGrid grid = random_grid(random, cell_m, cell_m < 0.1 ? 2 : 40);
    const auto map = std::make_shared<const ClearanceMap>(grid);
    for (const Footprint& footprint : shapes()) {
      const CollisionChecker checker(map, footprint);
      int free = 0;
      for (int i = 0; i < 400; ++i) {
        const Pose2 pose{random.uniform() * grid.columns() * cell_m,
                         random.uniform() * grid.rows() * cell_m, 7.0 * random.uniform() - 3.5};
        const bool is_free = checker.free(pose);
        EXPECT_EQ(is_free, checker.free_exactly(pose));
        if (is_free) {
          ++free;
          EXPECT_FALSE(sampled_hit(grid, footprint, pose, 0.0));
        } else {
          // Grown by a little more than the sampling can miss, it is hit there, too.
          EXPECT_TRUE(sampled_hit(grid, footprint.grown(0.03), pose, 0.03));
        }
      }
      EXPECT_GT(free, 10);
    }
  }
}

TEST(CollisionChecker, TouchingIsNotColliding) {
  OccupancyGrid grid({.origin = {}, .cell_m = 0.5, .columns = 20, .rows = 20});
  grid.set({10, 10}, CellState::kOccupied);  // 5.0 ... 5.5
  const auto map = std::make_shared<const ClearanceMap>(grid);
  const CollisionChecker box(map, Footprint::rectangle(2.0, 1.0));
  EXPECT_TRUE(box.free({4.0, 5.2, 0.0}));
  EXPECT_FALSE(box.free({4.001, 5.2, 0.0}));
  EXPECT_TRUE(box.free({5.2, 4.0, std::numbers::pi / 2}));
  EXPECT_FALSE(box.free({5.2, 4.01, std::numbers::pi / 2}));
  const CollisionChecker disc(map, Footprint::circle(1.0));
  EXPECT_TRUE(disc.free({4.0, 5.2, 0.0}));
  EXPECT_FALSE(disc.free({4.001, 5.2, 0.0}));
}

TEST(CollisionChecker, BeyondTheEdgeEverythingIsBlocked) {
  const OccupancyGrid grid({.origin = {}, .cell_m = 0.5, .columns = 20, .rows = 20});
  const auto map = std::make_shared<const ClearanceMap>(grid);
  for (const Footprint& footprint : shapes()) {
    const CollisionChecker checker(map, footprint);
    EXPECT_TRUE(checker.free({5.0, 5.0, 1.0}));
    EXPECT_FALSE(checker.free({-0.3, 5.0, 0.0}));
    EXPECT_FALSE(checker.free({1e6, -1e6, 0.0}));
  }
  const CollisionChecker box(map, Footprint::rectangle(2.0, 1.0));
  EXPECT_TRUE(box.free({1.0, 0.5, 0.0}));
  EXPECT_FALSE(box.free({1.0, 0.49, 0.0}));
}

TEST(Footprint, KnowsItsDiscs) {
  const Footprint box = Footprint::rectangle(1.4, 0.9);
  EXPECT_DOUBLE_EQ(box.inscribed_m(), 0.45);
  EXPECT_DOUBLE_EQ(box.circumscribed_m(), std::hypot(0.7, 0.45));
  EXPECT_NEAR(box.grown(0.1).inscribed_m(), 0.55, 1e-12);
  EXPECT_NEAR(box.grown(0.1).circumscribed_m(), std::hypot(0.8, 0.55), 1e-12);
  EXPECT_DOUBLE_EQ(Footprint::circle(0.3).grown(0.05).inscribed_m(), 0.35);
  EXPECT_DOUBLE_EQ(shapes()[3].inscribed_m(), 0.0);
}

}  // namespace
}  // namespace linewright
