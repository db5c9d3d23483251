#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "cases.hpp"
#include "linewright/routing/hybrid_a_star.hpp"
#include "report.hpp"
#include "sections.hpp"

namespace linewright::bench {
namespace {

struct Run {
  std::string name;  ///< map and mover
  Query query;
  PathStatus status;
  SearchEffort effort;
  double cold_s;  ///< planner made, heuristic and tables empty
  double warm_s;  ///< the same again: heuristic and tables known
  double metres;
  double bound_m;  ///< what the heuristic said at the start
};

struct Reachable {
  bool disc;   ///< by the disc around the footprint
  bool aisle;  ///< by the disc inside of it
};

Run run(const Case& c, const Query& query) {
  double start = cpu_s();
  HybridAStar planner(c.map, c.mover);
  Path path = planner.plan(query.start, query.goal);
  const double cold_s = cpu_s() - start;
  start = cpu_s();
  path = planner.plan(query.start, query.goal);
  const double warm_s = cpu_s() - start;
  const auto cell = c.map->frame().index(c.map->frame().cell_at(query.start.point()));
  const double bound_m = planner.goal_distance()->to_goal(cell) * c.map->frame().cell_m;
  return {c.name, query, path.status, planner.effort(), cold_s, warm_s, path.metres(), bound_m};
}

Reachable reachable(const Case& c, const Query& query) {
  const auto dijkstra = make_path_planner("dijkstra", c.map, c.mover);
  GoalDistance distance(c.map, c.mover.footprint.inscribed_m(),
                        c.map->frame().cell_at(query.goal.point()));
  const auto start = c.map->frame().index(c.map->frame().cell_at(query.start.point()));
  return {dijkstra->plan(query.start, query.goal).found(),
          distance.to_goal(start) < GoalDistance::kUnreachable};
}

std::vector<std::string> row(const Case& c, const std::vector<Run>& runs) {
  std::vector<double> cold;
  std::vector<double> warm;
  double expansions = 0.0;
  std::map<PathStatus, int> count;
  double metres = 0.0;
  double bound = 0.0;
  int disc = 0;
  int disc_found = 0;
  int aisle = 0;
  for (const Run& r : runs) {
    cold.push_back(r.cold_s);
    warm.push_back(r.warm_s);
    expansions += static_cast<double>(r.effort.expansions);
    ++count[r.status];
    const Reachable can = reachable(c, r.query);
    if (r.status == PathStatus::kFound) {
      metres += r.metres;
      bound += std::max(1.0, distance_m(r.query.start.point(), r.query.goal.point()));
    }
    aisle += can.aisle ? 1 : 0;
    disc += can.disc ? 1 : 0;
    disc_found += can.disc && r.status == PathStatus::kFound ? 1 : 0;
  }
  return {c.name,
          fmt::format("{} of {}", count[PathStatus::kFound], runs.size()),
          fmt::format("{} of {}", disc_found, disc),
          fmt::format("{}", aisle),
          fmt::format("{} / {} / {}", count[PathStatus::kNoAisle], count[PathStatus::kNoManoeuvre],
                      count[PathStatus::kSearchLimit]),
          spread_ms(cold),
          spread_ms(warm),
          fmt::format("{:.3f}", metres / bound),
          fmt::format("{:.0f}", expansions / static_cast<double>(runs.size())),
          fmt::format("{:.2f}", expansions / sum_of(warm) / 1e6)};
}

void print_slowest(std::vector<Run>& runs) {
  std::sort(runs.begin(), runs.end(),
            [](const Run& a, const Run& b) { return a.warm_s > b.warm_s; });
  std::vector<std::vector<std::string>> rows{{"slowest queries", "warm ms", "expansions",
                                              "connections", "status", "heuristic m", "path m",
                                              "from", "to"}};
  const auto text = [](const Pose2& pose) {
    return fmt::format("{:.1f},{:.1f},{:.2f}", pose.x_m, pose.y_m, pose.heading_rad);
  };
  for (std::size_t i = 0; i < std::min<std::size_t>(10, runs.size()); ++i) {
    const Run& r = runs[i];
    rows.push_back({r.name, fmt::format("{:.1f}", 1e3 * r.warm_s),
                    fmt::format("{}", r.effort.expansions), fmt::format("{}", r.effort.connections),
                    name_of(r.status), fmt::format("{:.1f}", r.bound_m),
                    fmt::format("{:.1f}", r.metres), text(r.query.start), text(r.query.goal)});
  }
  fmt::print("\n");
  print_table(rows);
}

}  // namespace

void measure_random_maps(bool thorough) {
  print_title("Random halls",
              "Milliseconds as median / p95 / max. Cold: planner, tables and heuristic made for "
              "the query; warm: the same query again.");
  struct Body {
    std::string name;
    Mover mover;
  };
  for (const Body& body : {Body{"robot 1.4 m x 0.9 m, radius 0.8 m", long_robot()},
                           Body{"disc 0.4 m, radius 0.6 m", round_robot()}}) {
    std::vector<Run> all;
    std::vector<std::vector<std::string>> rows{
        {body.name, "found", "of disc's", "aisle", "no aisle / manoeuvre / limit", "cold ms",
         "warm ms", "metres / straight", "expansions", "M exp/s"}};
    for (const std::int32_t size : {384, 1600}) {
      for (const std::size_t percent : {10, 20, 30}) {
        const std::size_t queries = (size == 384 ? 50U : 10U) * (thorough ? 8U : 1U);
        const Case c = random_case(size, percent, body.mover, queries);
        std::vector<Run> runs;
        for (const Query& query : c.queries) runs.push_back(run(c, query));
        rows.push_back(row(c, runs));
        all.insert(all.end(), runs.begin(), runs.end());
      }
    }
    print_table(rows);
    print_slowest(all);
    fmt::print("\n");
  }
}

}  // namespace linewright::bench
