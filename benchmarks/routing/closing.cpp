#include <fmt/format.h>

#include <algorithm>

#include "cases.hpp"
#include "linewright/routing/hybrid_a_star.hpp"
#include "report.hpp"
#include "sections.hpp"

namespace linewright::bench {
namespace {

using Distance = std::shared_ptr<GoalDistance>;

/// A zone of `size_m` x `size_m` in the middle of a path, and what is planned anew because of it.
struct Closure {
  std::shared_ptr<const ClearanceMap> map;
  std::vector<Query> affected;  ///< all with the same goal
};

struct Times {
  std::vector<double> heuristic;  ///< by goal
  std::vector<double> queries;    ///< by goal, all queries of it
  std::size_t expansions = 0;
};

bool is_free(const Path& path, const CollisionChecker& checker) {
  const std::vector<Pose2> poses = sampled(path, 0.1);
  return std::all_of(poses.begin(), poses.end(), [&](const Pose2& pose) {
    return checker.free(checker.map().frame().to_grid(pose));
  });
}

Closure close_on(const Case& c, const std::vector<Query>& queries, const std::vector<Path>& paths,
                 double size_m) {
  const std::vector<Pose2> poses = sampled(paths.front(), 0.5);
  const Pose2 middle = poses[poses.size() / 2];
  OccupancyGrid grid = *c.grid;
  const double half = size_m / 2.0;
  grid.add_obstacle(
      corners_of({middle.x_m - half, middle.x_m + half, middle.y_m - half, middle.y_m + half}));
  Closure closure{std::make_shared<const ClearanceMap>(grid), {}};
  const CollisionChecker checker(closure.map, c.mover.footprint);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const bool ends_free = checker.free(grid.frame().to_grid(queries[i].start)) &&
                           checker.free(grid.frame().to_grid(queries[i].goal));
    if (ends_free && !is_free(paths[i], checker)) closure.affected.push_back(queries[i]);
  }
  return closure;
}

/// Plans what is affected with the estimate that `make` gives; null: the planner's own.
template <class Make>
void measure(const Case& c, const Closure& closure, Times& times, Make&& make) {
  HybridAStar planner(closure.map, c.mover);
  double start = cpu_s();
  Distance distance = make();
  times.heuristic.push_back(cpu_s() - start);
  planner.use_goal_distance(distance);
  start = cpu_s();
  for (const Query& query : closure.affected) {
    (void)planner.plan(query.start, query.goal);
    times.expansions += planner.effort().expansions;
  }
  times.queries.push_back(cpu_s() - start);
}

std::vector<std::string> row(const std::string& name, const Times& times, std::size_t queries) {
  const double goals = static_cast<double>(std::max<std::size_t>(1, times.heuristic.size()));
  const double all = static_cast<double>(std::max<std::size_t>(1, queries));
  return {name, fmt::format("{:.2f}", 1e3 * sum_of(times.heuristic) / goals),
          fmt::format("{:.2f}", 1e3 * sum_of(times.queries) / all),
          fmt::format("{:.0f}", static_cast<double>(times.expansions) / all)};
}

/// Queries by goal.
std::vector<std::vector<Query>> goals_of(const Case& c, std::size_t starts) {
  std::vector<std::vector<Query>> goals;
  for (std::size_t i = 0; i + starts <= c.queries.size(); i += starts) {
    goals.emplace_back();
    for (std::size_t s = 0; s < starts; ++s) {
      goals.back().push_back({c.queries[i + s].start, c.queries[i].goal});
    }
  }
  return goals;
}

void measure_zone(const Case& c, std::size_t starts, double size_m) {
  Times anew;
  Times incremental;
  Times kept;
  std::size_t queries = 0;
  const double radius_m = c.mover.footprint.inscribed_m();
  for (const std::vector<Query>& goal : goals_of(c, starts)) {
    HybridAStar planner(c.map, c.mover);
    std::vector<Query> found;
    std::vector<Path> paths;
    for (const Query& query : goal) {
      Path path = planner.plan(query.start, query.goal);
      if (!path.found()) continue;
      found.push_back(query);
      paths.push_back(std::move(path));
    }
    if (paths.empty()) continue;
    const Closure closure = close_on(c, found, paths, size_m);
    if (closure.affected.empty()) continue;
    queries += closure.affected.size();
    const Distance old = planner.goal_distance();
    measure(c, closure, anew, [&] {
      auto made = std::make_shared<GoalDistance>(closure.map, radius_m, old->goal());
      for (const Query& query : closure.affected) {
        (void)made->to_goal(c.map->frame().index(c.map->frame().cell_at(query.start.point())));
      }
      return made;
    });
    const auto copy = std::make_shared<GoalDistance>(*old);
    measure(c, closure, incremental, [&] {
      (void)copy->close(closure.map);
      return copy;
    });
    measure(c, closure, kept, [&] { return old; });
  }
  print_table({{fmt::format("{}, zone {:.0f} m x {:.0f} m: {} queries, {} goals", c.name, size_m,
                            size_m, queries, kept.heuristic.size()),
                "heuristic ms per goal", "ms per query", "expansions"},
               row("computed anew", anew, queries),
               row("closed step by step", incremental, queries),
               row("the old one kept", kept, queries)});
  fmt::print("\n");
}

}  // namespace

void compare_closing(bool thorough) {
  print_title("Zones that close",
              "A zone on the way of the first start of each goal; the queries whose ways it blocks "
              "are planned anew. CPU time; the map of the zone is not counted.");
  const DuctHall hall = duct_hall();
  const Case robots = hall_case(hall, hall.requests.back());
  for (const double size_m : {1.0, 3.0, 8.0}) measure_zone(robots, 9, size_m);
  const Case large = random_case(1600, 10, long_robot(), thorough ? 48 : 12);
  for (const double size_m : {2.0, 10.0, 40.0}) measure_zone(large, 4, size_m);
}

}  // namespace linewright::bench
