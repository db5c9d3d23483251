#include "linewright/routing/goal_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <queue>

#include "random_hall.hpp"

namespace linewright {
namespace {

/// Plain Dijkstra with a binary heap, by the words of the header.
std::vector<double> plain(const GoalDistance& rules, const GridFrame& frame) {
  std::vector<double> cost(frame.size(), 1e300);
  using Open = std::pair<double, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  cost[frame.index(rules.goal())] = 0.0;
  open.emplace(0.0, frame.index(rules.goal()));
  const auto passable = [&](Cell cell) {
    return frame.contains(cell) && rules.passable(frame.index(cell));
  };
  while (!open.empty()) {
    const auto [at, cell] = open.top();
    open.pop();
    if (at > cost[cell]) continue;
    const Cell c = frame.cell(cell);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const Cell to{c.column + dx, c.row + dy};
        if ((dx == 0 && dy == 0) || !passable(to)) continue;
        if (dx != 0 && dy != 0 && !passable({to.column, c.row}) && !passable({c.column, to.row})) {
          continue;
        }
        const double next = at + std::hypot(dx, dy);
        if (next >= cost[frame.index(to)] - 1e-12) continue;
        cost[frame.index(to)] = next;
        open.emplace(next, frame.index(to));
      }
    }
  }
  return cost;
}

void expect_equal(GoalDistance& distance, const GridFrame& frame, std::size_t stride) {
  const std::vector<double> reference = plain(distance, frame);
  for (std::size_t cell = 0; cell < frame.size(); cell += stride) {
    const float found = distance.to_goal(cell);
    if (reference[cell] > 1e299) {
      ASSERT_EQ(found, GoalDistance::kUnreachable) << cell;
    } else {
      ASSERT_NEAR(found, reference[cell], 1e-3 * (1.0 + reference[cell])) << cell;
    }
  }
}

TEST(GoalDistance, EqualsPlainDijkstraHoweverFarItIsAskedFor) {
  RandomStream random(21);
  for (int trial = 0; trial < 20; ++trial) {
    const OccupancyGrid grid = random_hall(random, 80, 60, 0.25, 25);
    const auto map = std::make_shared<const ClearanceMap>(grid);
    const Cell goal = grid.frame().cell_at(random_free_pose(random, *map, 0.4).point());
    GoalDistance distance(map, 0.4, goal);
    expect_equal(distance, grid.frame(), 1 + random.below(50));
  }
}

TEST(GoalDistance, ClosingCellsIsTheSameAsSearchingAnew) {
  RandomStream random(22);
  for (int trial = 0; trial < 40; ++trial) {
    OccupancyGrid grid = random_hall(random, 80, 60, 0.25, 15);
    const auto map = std::make_shared<const ClearanceMap>(grid);
    const Point2 goal = random_free_pose(random, *map, 0.4).point();
    GoalDistance distance(map, 0.4, grid.frame().cell_at(goal));
    const bool partly = trial % 2 == 0;
    (void)distance.to_goal(partly ? random.below(grid.size()) : 0);
    if (!partly) {
      for (std::size_t cell = 0; cell < grid.size(); ++cell) (void)distance.to_goal(cell);
    }
    const double x = 20.0 * random.uniform();
    const double y = 15.0 * random.uniform();
    grid.add_obstacle(corners_of({x, x + 3.0, y, y + 1.0 + 4.0 * random.uniform()}));
    if (grid.blocked(grid.frame().cell_at(goal))) continue;
    const auto closed = std::make_shared<const ClearanceMap>(grid);
    EXPECT_LE(distance.close(closed), 2 * grid.size());
    expect_equal(distance, grid.frame(), 1);
  }
}

}  // namespace
}  // namespace linewright
