#include "linewright/routing/route_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "linewright/routing/route_cache.hpp"
#include "random_hall.hpp"

namespace linewright {
namespace {

struct Case {
  OccupancyGrid grid;
  std::shared_ptr<const ClearanceMap> map;
  std::vector<RouteRequest> requests;
};

Case random_case(std::uint64_t seed) {
  RandomStream random(seed);
  Case made{random_hall(random, 100, 80, 0.25, 12), nullptr, {}};
  made.map = std::make_shared<const ClearanceMap>(made.grid);
  made.requests = {{.kind = "human", .mover = {Footprint::circle(0.3), 0.0}},
                   {.kind = "robot", .mover = {Footprint::rectangle(1.4, 0.9), 0.8}}};
  for (RouteRequest& request : made.requests) {
    for (int i = 0; i < 6; ++i) {
      request.stops.push_back({"s" + std::to_string(i), random_free_pose(random, *made.map, 0.9)});
    }
  }
  return made;
}

TEST(RouteTable, IsTheSameForAnyNumberOfThreads) {
  const Case c = random_case(51);
  const std::uint64_t key = route_key(c.grid, c.requests);
  RouteBuildOptions options;
  options.threads = 1;
  const std::string one = encode_routes(build_route_tables(c.map, c.requests, options), key);
  for (const std::size_t threads : {2, 3, 16}) {
    options.threads = threads;
    EXPECT_EQ(encode_routes(build_route_tables(c.map, c.requests, options), key), one);
  }
}

TEST(RouteTable, ReportsProgressAndStopsWhenCancelled) {
  const Case c = random_case(52);
  RouteBuildOptions options;
  CancelToken cancel;
  std::atomic<std::size_t> calls{0};
  options.threads = 1;
  options.cancel = &cancel;
  options.progress = [&](std::size_t done, std::size_t total) {
    EXPECT_EQ(total, 60U);
    EXPECT_EQ(done, ++calls);
    if (done == 10) cancel.request();
  };
  const auto tables = build_route_tables(c.map, c.requests, options);
  EXPECT_EQ(calls, 10U);
  EXPECT_GE(tables[0].failed() + tables[1].failed(), 50U);
  EXPECT_TRUE(tables[1].path(2, 2).found());
}

TEST(RouteTable, SaysWhyAPairHasNoRoute) {
  const Case c = random_case(53);
  const RouteRequest& robot = c.requests[1];
  EXPECT_NE(explain_missing(robot, 0, 1, PathStatus::kStartOccupied).find("'s0'"),
            std::string::npos);
  EXPECT_NE(explain_missing(robot, 0, 1, PathStatus::kGoalOccupied).find("'s1'"),
            std::string::npos);
  EXPECT_NE(explain_missing(robot, 0, 1, PathStatus::kNoAisle).find("0.90 m"), std::string::npos);
  EXPECT_NE(explain_missing(robot, 0, 1, PathStatus::kNoManoeuvre).find("0.80 m"),
            std::string::npos);
}

TEST(RouteCache, GivesBackWhatWasStored) {
  const Case c = random_case(54);
  const std::uint64_t key = route_key(c.grid, c.requests);
  const auto tables = build_route_tables(c.map, c.requests);
  const std::string bytes = encode_routes(tables, key);
  const CachedRoutes cached = decode_routes(bytes, key, c.requests);
  ASSERT_TRUE(cached.usable()) << cached.complaint;
  EXPECT_EQ(encode_routes(cached.tables, key), bytes);
  EXPECT_EQ(cached.tables[1].path(0, 1).metres(), tables[1].path(0, 1).metres());
}

TEST(RouteCache, ItsKeyChangesWithEverythingThatRoutesFollowFrom) {
  const Case c = random_case(55);
  const std::uint64_t key = route_key(c.grid, c.requests);
  const auto changed = [&](auto&& change) {
    Case other = c;
    change(other);
    return route_key(other.grid, other.requests) != key;
  };
  EXPECT_FALSE(changed([](Case&) {}));
  EXPECT_TRUE(changed([](Case& o) { o.grid.set({0, 0}, CellState::kUnknown); }));
  EXPECT_TRUE(changed([](Case& o) { o.requests[0].mover.footprint = Footprint::circle(0.31); }));
  EXPECT_TRUE(changed([](Case& o) { o.requests[1].mover.turning_radius_m = 0.9; }));
  EXPECT_TRUE(changed([](Case& o) { o.requests[1].options.headings = 64; }));
  EXPECT_TRUE(changed([](Case& o) { o.requests[1].options.reverse_penalty = 2.0; }));
  EXPECT_TRUE(changed([](Case& o) { o.requests[0].stops[3].pose.heading_rad += 0.1; }));
  EXPECT_TRUE(changed([](Case& o) { o.requests[0].stops.pop_back(); }));
  EXPECT_TRUE(changed([](Case& o) { o.requests[0].planner = "dijkstra"; }));
}

TEST(RouteCache, DamageIsNoticedWhereverItIs) {
  const Case c = random_case(56);
  const std::uint64_t key = route_key(c.grid, c.requests);
  const std::string bytes = encode_routes(build_route_tables(c.map, c.requests), key);
  EXPECT_FALSE(decode_routes("", key, c.requests).complaint.empty());
  EXPECT_FALSE(decode_routes("something else entirely", key, c.requests).complaint.empty());
  EXPECT_TRUE(decode_routes(bytes, key + 1, c.requests).outdated);
  RandomStream random(57);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = bytes;
    const std::size_t at = random.below(damaged.size());
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << random.below(8)));
    EXPECT_FALSE(decode_routes(damaged, key, c.requests).usable()) << at;
    EXPECT_FALSE(decode_routes(bytes.substr(0, at), key, c.requests).usable()) << at;
  }
  // Sound in itself, but of another scenario that happens to have the key.
  std::vector<RouteRequest> fewer = c.requests;
  fewer[0].stops.pop_back();
  EXPECT_FALSE(decode_routes(bytes, key, fewer).complaint.empty());
}

}  // namespace
}  // namespace linewright
