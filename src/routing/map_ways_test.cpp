#include "linewright/routing/map_ways.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace linewright {
namespace {

/// A hall of 20 m x 10 m with a wall in the middle that has two doors, at y = 1 ... 3 and 7 ... 9.
MapWaysData hall_with_two_doors() {
  OccupancyGrid grid({.origin = {}, .cell_m = 0.25, .columns = 80, .rows = 40});
  grid.add_obstacle(corners_of({9.5, 10.5, 0.0, 1.0}));
  grid.add_obstacle(corners_of({9.5, 10.5, 3.0, 7.0}));
  grid.add_obstacle(corners_of({9.5, 10.5, 9.0, 10.0}));
  MapWaysData data{.grid = grid};
  data.zones = {{"south", corners_of({9.0, 11.0, 0.5, 3.5}), {}},
                {"north", corners_of({9.0, 11.0, 6.5, 9.5}), {}}};
  const std::vector<Pose2> poses{{2.0, 2.0, 0.0}, {18.0, 2.0, 0.0}, {2.0, 8.0, 0.0}};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    data.stations.push_back({"s" + std::to_string(i), {poses[i], poses[i]}, {1, 1}});
  }
  const std::vector<Mover> movers{{Footprint::circle(0.3), 0.0},
                                  {Footprint::rectangle(1.2, 0.8), 0.7}};
  const auto map = std::make_shared<const ClearanceMap>(grid);
  for (std::size_t k = 0; k < movers.size(); ++k) {
    KindRoutes kind;
    kind.request = {.kind = k == 0 ? "human" : "robot", .mover = movers[k]};
    for (std::size_t i = 0; i < poses.size(); ++i) {
      kind.request.stops.push_back({data.stations[i].name, poses[i]});
      kind.stations.emplace_back(i);
    }
    kind.motion = {.speed_mps = 1.0};
    kind.routes = build_route_tables(map, {kind.request})[0];
    data.motions.push_back(kind.motion);
    data.base.push_back(travel_table(kind, poses.size(), 1.0));
    data.kinds.emplace_back(std::move(kind));
  }
  return data;
}

constexpr ZoneSet kSouth = 1;
constexpr ZoneSet kNorth = 2;

TEST(MapWays, PlansAnewOnlyWhatLeadsThroughAClosedZone) {
  const MapWaysData data = hall_with_two_doors();
  const MapWays ways(data);
  for (const WorkerKindId kind : {WorkerKindId(0), WorkerKindId(1)}) {
    const TravelTable& open = ways.table(kind, 0);
    const TravelTable& closed = ways.table(kind, kSouth);
    const StationId a(0);
    const StationId b(1);
    const StationId c(2);
    EXPECT_NEAR(open.leg(a, b).metres, 16.0, 0.1);
    EXPECT_GT(closed.leg(a, b).metres, 18.0);
    EXPECT_GT(closed.leg(a, b).ticks, open.leg(a, b).ticks);
    EXPECT_EQ(closed.leg(a, c).ticks, open.leg(a, c).ticks);
    EXPECT_FALSE(ways.crosses(kind, closed.path(a, b), 0.0, 0));
    EXPECT_TRUE(ways.crosses(kind, closed.path(a, b), 0.0, 1));
    EXPECT_FALSE(ways.crosses(kind, closed.path(a, b), 0.9, 1));  // it is past it then
    EXPECT_EQ(ways.table(kind, kSouth | kNorth).leg(a, b).ticks, -1);
    EXPECT_EQ(&ways.table(kind, kSouth), &closed);
  }
}

TEST(MapWays, FindsTheWayFromAnywhere) {
  const MapWays ways(hall_with_two_doors());
  const WorkerKindId robot(1);
  const Pose2 middle{6.0, 5.0, 1.0};
  const Way& open = ways.way(robot, middle, StationId(1), 0);
  EXPECT_NEAR(open.path.front().pose.x_m, 6.0, 1e-9);
  EXPECT_NEAR(open.path.back().pose.x_m, 18.0, 1e-6);
  EXPECT_TRUE(ways.crosses(robot, open.path, 0.0, 0));
  const Way& around = ways.way(robot, middle, StationId(1), kSouth);
  EXPECT_FALSE(ways.crosses(robot, around.path, 0.0, 0));
  EXPECT_GT(around.leg.metres, open.leg.metres);
  EXPECT_EQ(ways.way(robot, middle, StationId(1), kSouth | kNorth).leg.ticks, -1);
  EXPECT_EQ(&ways.way(robot, middle, StationId(1), kSouth), &around);
}

TEST(MapWays, WhoIsInsideOfAClosedZoneMayLeaveIt) {
  const MapWays ways(hall_with_two_doors());
  const Pose2 door{10.0, 2.0, 0.0};
  for (const WorkerKindId kind : {WorkerKindId(0), WorkerKindId(1)}) {
    EXPECT_TRUE(ways.inside(kind, door, 0));
    EXPECT_FALSE(ways.inside(kind, door, 1));
    EXPECT_NEAR(ways.way(kind, door, StationId(1), kSouth).leg.metres, 8.0, 0.1);
  }
}

TEST(MapWays, AStationInsideOfAClosedZoneCanBeLeftButNotEntered) {
  MapWaysData data = hall_with_two_doors();
  data.zones[0].polygon = corners_of({1.0, 11.0, 0.5, 3.5});  // station s0 is in it
  const MapWays ways(std::move(data));
  for (const WorkerKindId kind : {WorkerKindId(0), WorkerKindId(1)}) {
    EXPECT_GE(ways.table(kind, kSouth).leg(StationId(0), StationId(2)).ticks, 0);
    EXPECT_EQ(ways.table(kind, kSouth).leg(StationId(2), StationId(0)).ticks, -1);
  }
}

TEST(MapWays, FindsAWayFromEveryPoseOnAnArcAlongAWall) {
  MapWaysData data = hall_with_two_doors();
  const TravelTable table = data.base[1];
  const MapWays ways(std::move(data));
  for (int from = 0; from < 3; ++from) {
    for (int to = 0; to < 3; ++to) {
      if (from == to) continue;
      const auto& path = table.path(StationId(from), StationId(to));
      for (int i = 1; i < 40; ++i) {
        const Pose2 pose = pose_on(path, i / 40.0);
        EXPECT_GE(ways.way(WorkerKindId(1), pose, StationId(to), 0).leg.ticks, 0);
      }
    }
  }
}

TEST(MapWays, KindsWithoutRoutesGoStraight) {
  MapWaysData data = hall_with_two_doors();
  data.kinds[0].reset();
  const MapWays ways(std::move(data));
  EXPECT_NEAR(ways.way(WorkerKindId(0), {2.0, 2.0, 0.0}, StationId(1), kSouth).leg.metres, 16.0,
              1e-9);
  EXPECT_FALSE(ways.inside(WorkerKindId(0), {10.0, 2.0, 0.0}, 0));
}

}  // namespace
}  // namespace linewright
