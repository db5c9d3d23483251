#include "linewright/routing/grid_routes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "grid_search.hpp"
#include "linewright/base/random.hpp"

namespace linewright {
namespace {

/// Random rectangles in a hall of 8 m x 6 m.
OccupancyGrid random_grid(RandomStream& random, double cell_m) {
  OccupancyGrid grid(GridFrame::covering({0.0, 8.0, 0.0, 6.0}, cell_m));
  const int obstacles = random.between(0, 8);
  for (int i = 0; i < obstacles; ++i) {
    const double x = 8 * random.uniform();
    const double y = 6 * random.uniform();
    grid.add_obstacle({x, x + 0.2 + 2 * random.uniform(), y, y + 0.2 + 2 * random.uniform()}, 0.2);
  }
  return grid;
}

Cell random_cell(const OccupancyGrid& grid, RandomStream& random) {
  return {random.between(0, grid.columns() - 1), random.between(0, grid.rows() - 1)};
}

/// Costs from `start` by relaxing every edge until nothing changes: slow, and plainly right.
std::vector<double> reference_costs(const OccupancyGrid& grid, Cell start) {
  std::vector<double> cost(grid.size(), std::numeric_limits<double>::infinity());
  cost[grid.frame().index(start)] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const Cell c = grid.frame().cell(i);
      if (grid.blocked(c)) continue;
      for (std::int32_t dx = -1; dx <= 1; ++dx) {
        for (std::int32_t dy = -1; dy <= 1; ++dy) {
          const Cell n{c.column + dx, c.row + dy};
          if ((dx == 0 && dy == 0) || grid.blocked(n)) continue;
          if (grid.blocked({c.column + dx, c.row}) || grid.blocked({c.column, c.row + dy}))
            continue;
          const double through = cost[i] + std::hypot(dx, dy);
          if (through < cost[grid.frame().index(n)] - 1e-9) {
            cost[grid.frame().index(n)] = through;
            changed = true;
          }
        }
      }
    }
  }
  return cost;
}

double length_of(const std::vector<Point2>& path) {
  double metres = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) metres += distance_m(path[i - 1], path[i]);
  return metres;
}

TEST(GridSearch, FindsTheCostsOfThePlainReference) {
  RandomStream random(7);
  for (int round = 0; round < 20; ++round) {
    const OccupancyGrid grid = random_grid(random, 0.5);
    const Cell start = random_cell(grid, random);
    if (grid.blocked(start)) continue;
    std::vector<Cell> goals;
    for (std::size_t i = 0; i < grid.size(); ++i) goals.push_back(grid.frame().cell(i));
    GridSearch search(grid);
    search.run(start, goals);
    const std::vector<double> expected = reference_costs(grid, start);
    for (const Cell goal : goals) {
      const double cost = expected[grid.frame().index(goal)];
      if (std::isinf(cost)) {
        ASSERT_LT(search.cost(goal), 0.0);
      } else {
        ASSERT_NEAR(search.cost(goal), cost, 1e-6);
      }
    }
  }
}

TEST(GridSearch, StoppingEarlyDoesNotChangeCosts) {
  RandomStream random(8);
  const OccupancyGrid grid(GridFrame::covering({0.0, 8.0, 0.0, 6.0}, 0.25));
  GridSearch search(grid);
  for (int round = 0; round < 50; ++round) {
    const Cell start = random_cell(grid, random);
    const Cell goal = random_cell(grid, random);
    search.run(start, {goal});
    const double dx = std::abs(start.column - goal.column);
    const double dy = std::abs(start.row - goal.row);
    const double octile = std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
    ASSERT_NEAR(search.cost(goal), octile, 1e-9);
  }
}

/// Checks one route of a random hall against everything that must hold for it.
void expect_sound(const OccupancyGrid& grid, const GridRoute& route, Point2 from, Point2 to) {
  if (route.status != RouteStatus::kFound) {
    EXPECT_TRUE(route.path.empty());
    return;
  }
  ASSERT_GE(route.path.size(), 2U);
  EXPECT_DOUBLE_EQ(route.path.front().x_m, from.x_m);
  EXPECT_DOUBLE_EQ(route.path.back().y_m, to.y_m);
  EXPECT_DOUBLE_EQ(route.metres, length_of(route.path));
  EXPECT_GE(route.metres, distance_m(from, to) - 1e-9);
  for (std::size_t i = 1; i < route.path.size(); ++i) {
    EXPECT_TRUE(line_of_sight(grid, route.path[i - 1], route.path[i]));
  }
}

TEST(GridRoutes, StayInFreeCellsAreSymmetricAndNoLongerThanTheCells) {
  RandomStream random(9);
  for (int round = 0; round < 60; ++round) {
    const OccupancyGrid grid = random_grid(random, 0.25);
    std::vector<Point2> points;
    while (points.size() < 6) {
      const Point2 point{8 * random.uniform(), 6 * random.uniform()};
      if (!grid.blocked(grid.frame().cell_at(point))) points.push_back(point);
    }
    const auto routes = grid_routes(grid, points);
    GridSearch search(grid);
    for (std::size_t a = 0; a < points.size(); ++a) {
      for (std::size_t b = 0; b < points.size(); ++b) {
        if (a == b) continue;
        expect_sound(grid, routes[a][b], points[a], points[b]);
        ASSERT_EQ(routes[a][b].status, routes[b][a].status);
        ASSERT_NEAR(routes[a][b].metres, routes[b][a].metres, 1e-9);
        search.run(grid.frame().cell_at(points[a]), {grid.frame().cell_at(points[b])});
        const double cells = search.cost(grid.frame().cell_at(points[b]));
        ASSERT_EQ(cells >= 0.0, routes[a][b].status == RouteStatus::kFound);
        // The exact ends are less than one cell diagonal from their cells' centres.
        ASSERT_LE(routes[a][b].metres, (std::max(cells, 0.0) + 2.0) * grid.cell_m());
      }
    }
  }
}

TEST(GridRoutes, AreStraightWhereNothingIsInTheWay) {
  const OccupancyGrid grid(GridFrame::covering({0.0, 10.0, 0.0, 10.0}, 0.25));
  const auto routes = grid_routes(grid, {{0.3, 0.4}, {9.1, 5.7}});
  EXPECT_EQ(routes[0][1].path.size(), 2U);
  EXPECT_DOUBLE_EQ(routes[0][1].metres, distance_m({0.3, 0.4}, {9.1, 5.7}));
}

TEST(GridRoutes, GoAroundAWall) {
  OccupancyGrid grid(GridFrame::covering({0.0, 10.0, 0.0, 10.0}, 0.1));
  grid.add_obstacle({4.0, 6.0, 0.0, 8.0}, 0.3);
  const auto routes = grid_routes(grid, {{2.0, 2.0}, {8.0, 2.0}});
  // The shortest way of a disc: a tangent to each corner's circle, two arcs, and the wall's top.
  const double tangent = std::sqrt(40.0 - 0.09);
  const double arc = 0.3 * (std::atan2(6.0, 2.0) + std::atan2(0.3, tangent));
  const double shortest = 2 * (tangent + arc) + 2.0;
  ASSERT_EQ(routes[0][1].status, RouteStatus::kFound);
  EXPECT_GT(routes[0][1].metres, 0.99 * shortest);
  EXPECT_LT(routes[0][1].metres, 1.03 * shortest);
}

TEST(GridRoutes, AisleNarrowerThanTheWorkerIsUnreachable) {
  OccupancyGrid grid(GridFrame::covering({0.0, 10.0, 0.0, 4.0}, 0.1));
  grid.add_obstacle({4.0, 6.0, 0.0, 1.7}, 0.4);
  grid.add_obstacle({4.0, 6.0, 2.3, 4.0}, 0.4);
  const auto routes = grid_routes(grid, {{1.0, 2.0}, {9.0, 2.0}});
  EXPECT_EQ(routes[0][1].status, RouteStatus::kUnreachable);
  EXPECT_EQ(routes[1][0].status, RouteStatus::kUnreachable);
}

TEST(GridRoutes, NeverPassBetweenTwoCellsThatTouchAtACorner) {
  OccupancyGrid grid(GridFrame::covering({0.0, 2.0, 0.0, 2.0}, 1.0));
  grid.add_obstacle({0.0, 1.0, 1.0, 2.0}, 0.0);
  grid.add_obstacle({1.0, 2.0, 0.0, 1.0}, 0.0);
  const auto routes = grid_routes(grid, {{0.5, 0.5}, {1.5, 1.5}}, {.snap_m = 0.1});
  EXPECT_EQ(routes[0][1].status, RouteStatus::kUnreachable);
}

TEST(GridRoutes, PointInAnObstaclesMarginIsReachedThroughTheNearestFreeCell) {
  OccupancyGrid grid(GridFrame::covering({0.0, 10.0, 0.0, 4.0}, 0.1));
  grid.add_obstacle({4.0, 6.0, 0.0, 2.0}, 0.5);
  const Point2 at_the_table{5.0, 2.1};
  const auto routes = grid_routes(grid, {{1.0, 3.0}, at_the_table});
  ASSERT_EQ(routes[0][1].status, RouteStatus::kFound);
  EXPECT_DOUBLE_EQ(routes[0][1].path.back().y_m, at_the_table.y_m);
  const Cell cell = *free_cell_near(grid, at_the_table, 1.5);
  EXPECT_NEAR(grid.frame().center(cell).x_m, 5.0, 0.06);
  EXPECT_NEAR(grid.frame().center(cell).y_m, 2.55, 0.06);
}

TEST(GridRoutes, SayWhichEndIsOccupied) {
  OccupancyGrid grid(GridFrame::covering({0.0, 10.0, 0.0, 10.0}, 0.25));
  grid.add_obstacle({5.0, 10.0, 0.0, 10.0}, 0.0);
  const auto routes = grid_routes(grid, {{1.0, 1.0}, {9.0, 9.0}});
  EXPECT_EQ(routes[0][1].status, RouteStatus::kGoalOccupied);
  EXPECT_EQ(routes[1][0].status, RouteStatus::kStartOccupied);
  EXPECT_FALSE(free_cell_near(grid, {9.0, 9.0}, 1.5).has_value());
}

TEST(GridRoutes, PointsInOneCellAreJoinedDirectly) {
  const OccupancyGrid grid(GridFrame::covering({0.0, 2.0, 0.0, 2.0}, 1.0));
  const auto routes = grid_routes(grid, {{0.1, 0.1}, {0.9, 0.9}});
  EXPECT_EQ(routes[0][1].path.size(), 2U);
  EXPECT_NEAR(routes[0][1].metres, std::hypot(0.8, 0.8), 1e-12);
}

TEST(LineOfSight, AgreesWithSamplingTheSegment) {
  RandomStream random(10);
  int blocked = 0;
  int agreed = 0;
  for (int round = 0; round < 2000; ++round) {
    const OccupancyGrid grid = random_grid(random, 0.5);
    const Point2 a{8 * random.uniform(), 6 * random.uniform()};
    const Point2 b{8 * random.uniform(), 6 * random.uniform()};
    bool sampled_free = true;
    for (int i = 0; i <= 4000; ++i) {
      const double t = i / 4000.0;
      const Point2 p{a.x_m + t * (b.x_m - a.x_m), a.y_m + t * (b.y_m - a.y_m)};
      sampled_free = sampled_free && !grid.blocked(grid.frame().cell_at(p));
    }
    // Sampling may miss the tip of a cell, so it can only be too optimistic.
    ASSERT_TRUE(sampled_free || !line_of_sight(grid, a, b));
    agreed += sampled_free == line_of_sight(grid, a, b) ? 1 : 0;
    blocked += sampled_free ? 0 : 1;
  }
  EXPECT_GT(blocked, 100);
  EXPECT_GT(agreed, 1980);
}

}  // namespace
}  // namespace linewright
