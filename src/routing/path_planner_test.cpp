#include "linewright/routing/path_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linewright/base/diagnostic.hpp"
#include "linewright/routing/hybrid_a_star.hpp"
#include "random_hall.hpp"

namespace linewright {
namespace {

struct Body {
  std::string name;
  Mover mover;
};

std::vector<Body> bodies() {
  return {{"person", {Footprint::circle(0.3), 0.0}},
          {"round robot that turns in arcs", {Footprint::circle(0.4), 0.6}},
          {"long robot that turns on the spot", {Footprint::rectangle(1.4, 0.9), 0.0}},
          {"long robot that turns in arcs", {Footprint::rectangle(1.4, 0.9), 0.8}}};
}

/// Everything that holds for every path of every planner: exact ends, free every 5 cm, curvature.
void expect_sound(const Path& path, const Pose2& start, const Pose2& goal, const Mover& mover,
                  const std::shared_ptr<const ClearanceMap>& map) {
  ASSERT_TRUE(path.found()) << name_of(path.status);
  EXPECT_EQ(distance_m(path.start.point(), start.point()), 0.0);
  const Pose2 end = path.end();
  EXPECT_NEAR(end.x_m, goal.x_m, 1e-6);
  EXPECT_NEAR(end.y_m, goal.y_m, 1e-6);
  EXPECT_NEAR(std::remainder(end.heading_rad - goal.heading_rad, 2 * std::numbers::pi), 0.0, 1e-6);
  const CollisionChecker checker(map, mover.footprint);
  for (const Pose2& pose : sampled(path, 0.05, 0.02)) {
    EXPECT_TRUE(checker.free(map->frame().to_grid(pose)))
        << pose.x_m << " " << pose.y_m << " " << pose.heading_rad;
  }
  for (const PathSegment& segment : path.segments) {
    const bool arc =
        segment.kind == PathSegment::Kind::kLeft || segment.kind == PathSegment::Kind::kRight;
    EXPECT_TRUE(!arc || path.turning_radius_m >= mover.turning_radius_m);
    if (mover.turning_radius_m > 0.0 && path.turning_radius_m > 0.0) {
      EXPECT_NE(segment.kind, PathSegment::Kind::kTurn);
    }
  }
}

class EveryPlanner : public testing::TestWithParam<std::string> {
 protected:
  static std::unique_ptr<PathPlanner> planner(const std::shared_ptr<const ClearanceMap>& map,
                                              const Mover& mover) {
    return make_path_planner(GetParam(), map, mover);
  }
};

TEST_P(EveryPlanner, FindsSoundPathsInRandomHalls) {
  RandomStream random(31);
  int found = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const OccupancyGrid grid = random_hall(random, 120, 90, 0.25, 5 + 4 * (trial % 4));
    const auto map = std::make_shared<const ClearanceMap>(grid);
    for (const Body& body : bodies()) {
      const auto plan = planner(map, body.mover);
      for (int query = 0; query < 3; ++query) {
        const Pose2 start = random_free_pose(random, *map, 0.9);
        const Pose2 goal = random_free_pose(random, *map, 0.9);
        const Path path = plan->plan(start, goal);
        if (!path.found()) continue;
        ++found;
        SCOPED_TRACE(body.name);
        expect_sound(path, start, goal, body.mover, map);
        EXPECT_GE(path.metres(), distance_m(start.point(), goal.point()) - 1e-9);
        EXPECT_GE(plan->effort().expansions, 1U);
      }
    }
  }
  EXPECT_GT(found, 100);
}

TEST_P(EveryPlanner, AnswersDependOnTheArgumentsAlone) {
  RandomStream random(32);
  const OccupancyGrid grid = random_hall(random, 120, 90, 0.25, 12);
  const auto map = std::make_shared<const ClearanceMap>(grid);
  for (const Body& body : bodies()) {
    const auto used = planner(map, body.mover);
    for (int query = 0; query < 6; ++query) {
      const Pose2 start = random_free_pose(random, *map, 0.9);
      const Pose2 goal = random_free_pose(random, *map, 0.9);
      const Path first = used->plan(start, goal);
      const Path fresh = planner(map, body.mover)->plan(start, goal);
      ASSERT_EQ(first.status, fresh.status);
      ASSERT_EQ(first.segments.size(), fresh.segments.size());
      for (std::size_t i = 0; i < fresh.segments.size(); ++i) {
        EXPECT_EQ(first.segments[i].kind, fresh.segments[i].kind);
        EXPECT_EQ(first.segments[i].amount, fresh.segments[i].amount);
      }
    }
  }
}

TEST_P(EveryPlanner, NamesWhatIsWrong) {
  OccupancyGrid grid({.origin = {}, .cell_m = 0.25, .columns = 80, .rows = 80});
  grid.add_obstacle(corners_of({9.0, 10.0, 0.0, 20.0}));  // a wall from side to side
  const auto map = std::make_shared<const ClearanceMap>(grid);
  for (const Body& body : bodies()) {
    SCOPED_TRACE(body.name);
    const auto plan = planner(map, body.mover);
    EXPECT_EQ(plan->plan({9.5, 5, 0}, {5, 5, 0}).status, PathStatus::kStartOccupied);
    EXPECT_EQ(plan->plan({5, 5, 0}, {9.5, 5, 0}).status, PathStatus::kGoalOccupied);
    EXPECT_EQ(plan->plan({-5, 5, 0}, {5, 5, 0}).status, PathStatus::kStartOccupied);
    EXPECT_EQ(plan->plan({5, 5, 0}, {15, 5, 0}).status, PathStatus::kNoAisle);
    EXPECT_TRUE(plan->plan({5, 5, 0}, {7, 15, 0}).found());
    const Path stay = plan->plan({5, 5, 1}, {5, 5, 1});
    EXPECT_TRUE(stay.found());
    EXPECT_NEAR(stay.metres(), 0.0, 1e-9);
  }
}

TEST_P(EveryPlanner, WorksInAGridThatIsTurnedAndMoved) {
  RandomStream random(33);
  OccupancyGrid grid = random_hall(random, 100, 80, 0.25, 10);
  OccupancyGrid turned({.origin = {-7.0, 3.0, 0.7}, .cell_m = 0.25, .columns = 100, .rows = 80});
  for (std::size_t i = 0; i < grid.size(); ++i) turned.set(turned.frame().cell(i), grid.cells()[i]);
  const auto map = std::make_shared<const ClearanceMap>(turned);
  for (const Body& body : bodies()) {
    const Pose2 start = turned.frame().to_map(random_free_pose(random, *map, 0.9));
    const Pose2 goal = turned.frame().to_map(random_free_pose(random, *map, 0.9));
    const Path path = planner(map, body.mover)->plan(start, goal);
    if (path.found()) expect_sound(path, start, goal, body.mover, map);
  }
}

TEST_P(EveryPlanner, IsNeverShorterThanTheWayOfItsNarrowestPart) {
  // The disc inside of the footprint, planned any-angle on a map with all doubt left to it.
  RandomStream random(34);
  const OccupancyGrid grid = random_hall(random, 120, 90, 0.25, 10);
  const auto map = std::make_shared<const ClearanceMap>(grid);
  for (const Body& body : bodies()) {
    const auto plan = planner(map, body.mover);
    for (int query = 0; query < 5; ++query) {
      const Pose2 start = random_free_pose(random, *map, 0.9);
      const Pose2 goal = random_free_pose(random, *map, 0.9);
      const Path path = plan->plan(start, goal);
      if (!path.found()) continue;
      GoalDistance bound(map, body.mover.footprint.inscribed_m(),
                         grid.frame().cell_at(goal.point()));
      // Eight directions make a way up to 8.24 % longer; the ends lie anywhere in their cells.
      const double cells = bound.to_goal(grid.frame().index(grid.frame().cell_at(start.point())));
      EXPECT_GE(path.metres(), cells * 0.25 / 1.0824 - 2 * 0.25 * 1.4143);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Planners, EveryPlanner, testing::ValuesIn(path_planner_names()));

TEST(PathPlanner, UnknownNamesAreErrors) {
  const auto map = std::make_shared<const ClearanceMap>(
      OccupancyGrid({.origin = {}, .cell_m = 1.0, .columns = 4, .rows = 4}));
  EXPECT_THROW((void)make_path_planner("hybrid_astar", map, {}), ScenarioError);
}

TEST(PathPlanner, DijkstraAndAStarFindWaysOfEqualLength) {
  RandomStream random(35);
  PathPlannerOptions unsmoothed;
  unsmoothed.smoothing_passes = 0;
  const Mover person{Footprint::circle(0.3), 0.0};
  for (int trial = 0; trial < 8; ++trial) {
    const OccupancyGrid grid = random_hall(random, 60, 60, 0.25, 15);
    const auto map = std::make_shared<const ClearanceMap>(grid);
    const auto quick = make_path_planner("a_star", map, person, unsmoothed);
    const auto plain = make_path_planner("dijkstra", map, person, unsmoothed);
    for (int query = 0; query < 4; ++query) {
      const Pose2 start = random_free_pose(random, *map, 0.3);
      const Pose2 goal = random_free_pose(random, *map, 0.3);
      const Path a = quick->plan(start, goal);
      const Path b = plain->plan(start, goal);
      ASSERT_EQ(a.status, b.status);
      EXPECT_NEAR(a.metres(), b.metres(), 1e-9);
      EXPECT_LE(quick->effort().expansions, plain->effort().expansions);
    }
  }
}

TEST(HybridAStar, ReachesWhatADiscCanReachAndBothWays) {
  RandomStream random(36);
  int found = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const OccupancyGrid grid = random_hall(random, 100, 100, 0.25, 10 + 2 * trial);
    const auto map = std::make_shared<const ClearanceMap>(grid);
    for (const Body& body : bodies()) {
      HybridAStar hybrid(map, body.mover);
      const auto disc = make_path_planner("dijkstra", map, body.mover);
      for (int query = 0; query < 3; ++query) {
        const Pose2 a = random_free_pose(random, *map, 0.9);
        const Pose2 b = random_free_pose(random, *map, 0.9);
        const Path there = hybrid.plan(a, b);
        EXPECT_EQ(there.found(), hybrid.plan(b, a).found());
        found += there.found() ? 1 : 0;
        // Who turns on the spot gets wherever the disc around it gets.
        if (body.mover.turning_radius_m == 0.0 && disc->plan(a, b).found()) {
          EXPECT_TRUE(there.found()) << body.name;
        }
      }
    }
  }
  EXPECT_GT(found, 80);
}

TEST(HybridAStar, SaysWhenOnlyTheTurningRadiusIsInTheWay) {
  // A corridor with a right angle, wide enough to drive but not to drive around the corner.
  OccupancyGrid grid({.origin = {}, .cell_m = 0.1, .columns = 100, .rows = 100});
  grid.add_obstacle(corners_of({0.0, 10.0, 0.0, 10.0}));
  for (std::int32_t i = 10; i < 90; ++i) {
    for (std::int32_t w = 0; w < 12; ++w) {
      grid.set({i, 10 + w}, CellState::kFree);
      grid.set({78 + w, i}, CellState::kFree);
    }
  }
  const auto map = std::make_shared<const ClearanceMap>(grid);
  const Footprint body = Footprint::rectangle(0.9, 0.8);
  const Pose2 start{2.0, 1.6, 0.0};
  const Pose2 goal{8.4, 8.0, std::numbers::pi / 2};
  PathPlannerOptions options;
  options.most_expansions = 400'000;
  EXPECT_TRUE(HybridAStar(map, {body, 0.0}, options).plan(start, goal).found());
  EXPECT_EQ(HybridAStar(map, {body, 40.0}, options).plan(start, goal).status,
            PathStatus::kNoManoeuvre);
  options.most_expansions = 10;
  EXPECT_EQ(HybridAStar(map, {body, 0.0}, options).plan(start, goal).status,
            PathStatus::kSearchLimit);
}

}  // namespace
}  // namespace linewright
