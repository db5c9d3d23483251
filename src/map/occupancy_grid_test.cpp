#include "linewright/map/occupancy_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "random_polygon.hpp"

namespace linewright {
namespace {

GridFrame random_frame(RandomStream& random) {
  return {.origin = {random_between(random, -3, 3), random_between(random, -3, 3),
                     random.below(3) == 0 ? 0.0 : random_between(random, -4, 4)},
          .cell_m = random_between(random, 0.2, 0.6),
          .columns = 12 + static_cast<std::int32_t>(random.below(8)),
          .rows = 12 + static_cast<std::int32_t>(random.below(8))};
}

/// The part of `polygon` where side(point) >= 0, side being linear (Sutherland and Hodgman).
Polygon cut(const Polygon& polygon, const std::function<double(Point2)>& side) {
  Polygon left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 a = polygon[i];
    const Point2 b = polygon[(i + 1) % polygon.size()];
    const double at_a = side(a);
    const double at_b = side(b);
    if (at_a >= 0.0) left.push_back(a);
    if ((at_a >= 0.0) == (at_b >= 0.0)) continue;
    const double share = at_a / (at_a - at_b);
    left.push_back({a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m)});
  }
  return left;
}

/// How much of the cell an obstacle (in the frame `map`) covers, in m2.
double covered_m2(const GridFrame& frame, Cell cell, const Polygon& obstacle) {
  Polygon part;
  for (const Point2 corner : obstacle) part.push_back(frame.to_grid(corner));
  const double x = cell.column * frame.cell_m;
  const double y = cell.row * frame.cell_m;
  part = cut(part, [&](Point2 p) { return p.x_m - x; });
  part = cut(part, [&](Point2 p) { return x + frame.cell_m - p.x_m; });
  part = cut(part, [&](Point2 p) { return p.y_m - y; });
  part = cut(part, [&](Point2 p) { return y + frame.cell_m - p.y_m; });
  return part.size() < 3 ? 0.0 : 0.5 * std::abs(doubled_area_m2(part));
}

/// Whether one of 10 x 10 points within the cell lies in the obstacle.
bool sampled(const GridFrame& frame, Cell cell, const Polygon& obstacle) {
  for (int i = 0; i < 100; ++i) {
    const Point2 p{(cell.column + 0.05 + 0.1 * (i % 10)) * frame.cell_m,
                   (cell.row + 0.05 + 0.1 * (i / 10)) * frame.cell_m};
    if (contains(obstacle, frame.to_map(p))) return true;
  }
  return false;
}

TEST(GridFrame, GoesToTheGridAndBack) {
  RandomStream random(1);
  for (int i = 0; i < 200; ++i) {
    const GridFrame frame = random_frame(random);
    const Pose2 pose{random_between(random, -9, 9), random_between(random, -9, 9),
                     random_between(random, -3, 3)};
    const Pose2 back = frame.to_map(frame.to_grid(pose));
    EXPECT_NEAR(back.x_m, pose.x_m, 1e-12);
    EXPECT_NEAR(back.y_m, pose.y_m, 1e-12);
    EXPECT_NEAR(back.heading_rad, pose.heading_rad, 1e-12);
  }
}

TEST(GridFrame, TheMiddleOfACellLiesInIt) {
  RandomStream random(2);
  for (int i = 0; i < 50; ++i) {
    const GridFrame frame = random_frame(random);
    for (std::size_t index = 0; index < frame.size(); ++index) {
      EXPECT_EQ(frame.cell_at(frame.center(frame.cell(index))), frame.cell(index));
      EXPECT_EQ(frame.index(frame.cell(index)), index);
    }
  }
}

TEST(GridFrame, AQuarterTurnPutsTheColumnsAlongY) {
  const GridFrame frame{{1.0, 2.0, std::acos(0.0)}, 0.5, 4, 2};
  const Point2 middle = frame.center({3, 0});
  EXPECT_NEAR(middle.x_m, 1.0 - 0.25, 1e-12);
  EXPECT_NEAR(middle.y_m, 2.0 + 3.5 * 0.5, 1e-12);
}

TEST(GridFrame, CoversItsBoundsWithoutACellTooMany) {
  const GridFrame even = GridFrame::covering({-1, 9, 0, 0.7}, 0.1);
  EXPECT_EQ(even.columns, 100);
  EXPECT_EQ(even.rows, 7);
  EXPECT_EQ(GridFrame::covering({0, 1.01, 0, 0.01}, 0.1).columns, 11);
  EXPECT_EQ(GridFrame::covering({0, 1.01, 0, 0.01}, 0.1).rows, 1);
}

TEST(GridFrame, PointsFarOutsideAreInNoCell) {
  const OccupancyGrid grid({{0, 0, 0.3}, 0.01, 5, 5});
  for (const double far : {-1e300, -1.0, 1.0, 1e300}) {
    EXPECT_TRUE(grid.blocked(grid.frame().cell_at({far, 0.0})));
    EXPECT_TRUE(grid.blocked(grid.frame().cell_at({0.0, far})));
  }
}

TEST(OccupancyGrid, OccupiesExactlyTheCellsThatTheObstacleCoversAPartOf) {
  RandomStream random(3);
  int occupied = 0;
  for (int i = 0; i < 300; ++i) {
    const GridFrame frame = random_frame(random);
    const Point2 middle = frame.center(
        {static_cast<std::int32_t>(random.below(12)), static_cast<std::int32_t>(random.below(12))});
    const Polygon obstacle = random_polygon(random, middle, random_between(random, 0.1, 4.0));
    OccupancyGrid grid(frame);
    grid.add_obstacle(obstacle);
    for (std::size_t index = 0; index < frame.size(); ++index) {
      const Cell cell = frame.cell(index);
      const double area_m2 = covered_m2(frame, cell, obstacle);
      if (grid.blocked(cell)) {
        ++occupied;
        EXPECT_GT(area_m2, 0.0);
      } else {
        EXPECT_LT(area_m2, 1e-8);
        EXPECT_FALSE(sampled(frame, cell, obstacle));
      }
    }
  }
  EXPECT_GT(occupied, 5000);
}

TEST(OccupancyGrid, TheDirectionOfTheCornersDoesNotMatter) {
  RandomStream random(4);
  for (int i = 0; i < 100; ++i) {
    const GridFrame frame = random_frame(random);
    const Polygon obstacle = random_polygon(random, frame.center({6, 6}), 3.0);
    OccupancyGrid one(frame);
    OccupancyGrid other(frame);
    one.add_obstacle(obstacle);
    other.add_obstacle({obstacle.rbegin(), obstacle.rend()});
    EXPECT_EQ(one.cells(), other.cells());
  }
}

TEST(OccupancyGrid, TouchingIsNotCovering) {
  OccupancyGrid grid(GridFrame::covering({0, 3, 0, 3}, 0.1));
  grid.add_obstacle(corners_of({0.3, 0.7, 0.6, 0.9}));  // 0.3 / 0.1 is not quite 3
  EXPECT_EQ(grid.count(CellState::kOccupied), 4U * 3U);
  EXPECT_TRUE(grid.blocked({3, 6}));
  EXPECT_TRUE(grid.blocked({6, 8}));
  EXPECT_FALSE(grid.blocked({2, 6}));
  EXPECT_FALSE(grid.blocked({7, 8}));
  EXPECT_FALSE(grid.blocked({6, 9}));
  // A corner on the middle of a cell's edge, from outside.
  OccupancyGrid tip({{0, 0, 0}, 1.0, 3, 3});
  tip.add_obstacle({{1.0, 1.5}, {0.2, 1.9}, {0.2, 1.1}});
  EXPECT_EQ(tip.count(CellState::kOccupied), 1U);
}

TEST(OccupancyGrid, AThinObstacleIsNotLostBetweenTheMiddles) {
  OccupancyGrid grid({{0, 0, 0}, 1.0, 5, 5});
  grid.add_obstacle(corners_of({0.5, 4.5, 2.01, 2.02}));
  EXPECT_EQ(grid.count(CellState::kOccupied), 5U);
  grid.add_obstacle({{0.1, 4.9}, {0.1, 4.8}, {4.9, 3.1}});
  EXPECT_GE(grid.count(CellState::kOccupied), 5U + 6U);
}

TEST(OccupancyGrid, AHoleBetweenArmsStaysFree) {
  OccupancyGrid grid({{0, 0, 0}, 1.0, 5, 5});
  grid.add_obstacle({{0, 0}, {5, 0}, {5, 5}, {4, 5}, {4, 1}, {1, 1}, {1, 5}, {0, 5}});
  EXPECT_EQ(grid.count(CellState::kOccupied), 5U + 2U * 4U);
  EXPECT_FALSE(grid.blocked({2, 3}));
}

TEST(OccupancyGrid, ObstaclesBeyondTheEdgeAreCutOff) {
  OccupancyGrid grid({{0, 0, 0}, 1.0, 3, 3});
  grid.add_obstacle(corners_of({-1e5, 1.0, -1e5, 1e5}));
  EXPECT_EQ(grid.count(CellState::kOccupied), 3U);
  grid.add_obstacle(corners_of({50, 60, 50, 60}));
  EXPECT_EQ(grid.count(CellState::kFree), 6U);
}

}  // namespace
}  // namespace linewright
