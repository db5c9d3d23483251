#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "../../src/routing/any_angle_bound.hpp"
#include "cases.hpp"
#include "linewright/routing/hybrid_a_star.hpp"
#include "linewright/routing/reeds_shepp.hpp"
#include "linewright/routing/route_cache.hpp"
#include "report.hpp"
#include "sections.hpp"

namespace linewright::bench {
namespace {

/// Median seconds of five calls.
template <class Call>
double median_s(Call&& call) {
  std::vector<double> seconds;
  for (int i = 0; i < 5; ++i) {
    const double start = wall_s();
    call();
    seconds.push_back(wall_s() - start);
  }
  return quantile(seconds, 0.5);
}

void measure_time(const DuctHall& hall) {
  std::vector<RouteTable> tables;
  const auto build = [&](std::size_t threads) {
    return [&, threads] {
      const auto map = std::make_shared<const ClearanceMap>(*hall.grid);
      tables = build_route_tables(map, hall.requests, {.threads = threads});
    };
  };
  const double one_s = median_s(build(1));
  const double two_s = median_s(build(2));
  const std::uint64_t key = route_key(*hall.grid, hall.requests);
  const std::string bytes = encode_routes(tables, key);
  std::size_t read = 0;
  const double cached_s = median_s([&] {
    const std::uint64_t now = route_key(*hall.grid, hall.requests);
    read += decode_routes(bytes, now, hall.requests).tables.size();
  });
  std::size_t pairs = 0;
  std::size_t failed = 0;
  for (const RouteTable& table : tables) {
    pairs += table.pairs();
    failed += table.failed();
  }
  print_table({{"whole tables (wall clock)", "ms"},
               {fmt::format("{} pairs, {} not found, 1 thread", pairs, failed),
                fmt::format("{:.1f}", 1e3 * one_s)},
               {"2 threads", fmt::format("{:.1f}", 1e3 * two_s)},
               {fmt::format("from the cache ({} bytes, {} tables): key and decoding", bytes.size(),
                            read / 5),
                fmt::format("{:.2f}", 1e3 * cached_s)}});
  fmt::print("\n");
}

/// Every cell cut into `parts` x `parts`.
std::shared_ptr<const ClearanceMap> refined(const OccupancyGrid& grid, int parts) {
  GridFrame frame = grid.frame();
  frame.cell_m /= parts;
  frame.columns *= parts;
  frame.rows *= parts;
  OccupancyGrid fine(frame);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const Cell cell = frame.cell(i);
    fine.set(cell, grid.state({cell.column / parts, cell.row / parts}));
  }
  return std::make_shared<const ClearanceMap>(fine);
}

struct Setting {
  std::string name;
  int parts = 1;  ///< of a cell, in each direction
  PathPlannerOptions options;
};

std::vector<Setting> settings(bool thorough) {
  PathPlannerOptions by_default;
  PathPlannerOptions careful = by_default;
  careful.greed = 1.0;
  careful.headings = 144;
  careful.smoothing_passes = 10;
  PathPlannerOptions shortest = careful;
  shortest.reverse_penalty = 1.0;
  shortest.direction_change_m = 0.0;
  shortest.steering_change_m = 0.0;
  std::vector<Setting> made{{"default", 1, by_default},
                            {"144 headings, greed 1, 10 passes", 1, careful},
                            {"the same, length alone", 1, shortest},
                            {"the same, cells of 0.125 m", 2, shortest}};
  shortest.greed = 1.1;
  made.push_back({"the same, greed 1.1", 2, shortest});
  shortest.greed = 1.05;
  made.push_back({"cells of 0.0625 m, greed 1.05", 4, shortest});
  if (thorough) {
    shortest.greed = 1.0;
    made.push_back({"cells of 0.0625 m, greed 1", 4, shortest});
  }
  return made;
}

struct Lengths {
  std::string name;
  std::vector<double> metres;  ///< by query; infinite: not found
  double seconds = 0.0;
};

/// Both ways round: a path can be driven back, and the search from the other end finds others.
Lengths lengths(const Case& c, const Setting& setting) {
  const auto map = setting.parts == 1 ? c.map : refined(*c.grid, setting.parts);
  Lengths made{setting.name, {}, 0.0};
  HybridAStar planner(map, c.mover, setting.options);
  const double start = cpu_s();
  for (const Query& query : c.queries) {
    const Path path = planner.plan(query.start, query.goal);
    made.metres.push_back(path.found() ? path.metres() : std::numeric_limits<double>::infinity());
  }
  made.seconds = cpu_s() - start;
  if (setting.name == "default") return made;
  for (std::size_t i = 0; i < c.queries.size(); ++i) {
    const Path back = planner.plan(c.queries[i].goal, c.queries[i].start);
    if (back.found()) made.metres[i] = std::min(made.metres[i], back.metres());
  }
  return made;
}

std::vector<double> bounds(const Case& c) {
  const AnyAngleBound bound(*c.grid, c.mover.footprint.inscribed_m());
  std::vector<double> made;
  for (const Query& query : c.queries) {
    double least = bound.metres(query.start.point(), query.goal.point());
    if (c.mover.turning_radius_m > 0.0) {
      least = std::max(least, reeds_shepp_m(query.start, query.goal, c.mover.turning_radius_m));
    }
    made.push_back(least);
  }
  return made;
}

/// "1.012 / 1.050": mean and worst ratio.
std::string ratios(const std::vector<double>& lengths, const std::vector<double>& to) {
  std::vector<double> found;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (lengths[i] < 1e9) found.push_back(lengths[i] / to[i]);
  }
  return fmt::format("{:.4f} / {:.4f}", mean_of(found), quantile(found, 1.0));
}

void measure_quality(const Case& c, bool thorough) {
  std::vector<Lengths> all;
  for (const Setting& setting : settings(thorough)) all.push_back(lengths(c, setting));
  std::vector<double> best = all.front().metres;
  for (const Lengths& one : all) {
    for (std::size_t i = 0; i < best.size(); ++i) best[i] = std::min(best[i], one.metres[i]);
  }
  const std::vector<double> least = bounds(c);
  std::vector<std::vector<std::string>> rows{
      {c.name + ": length, mean / worst", "to the lower bound", "to the best known", "CPU s"}};
  for (const Lengths& one : all) {
    rows.push_back({one.name, ratios(one.metres, least), ratios(one.metres, best),
                    fmt::format("{:.2f}", one.seconds)});
  }
  rows.push_back({"best known", ratios(best, least), "", ""});
  print_table(rows);
  fmt::print("\n");
}

}  // namespace

void measure_hall(bool thorough) {
  print_title("Duct hall",
              "All routes of the duct line on its map. Lower bound: the shortest way of the "
              "footprint's inner disc in any direction, or the Reeds-Shepp curve.");
  const DuctHall hall = duct_hall();
  measure_time(hall);
  for (const RouteRequest& request : hall.requests) {
    measure_quality(hall_case(hall, request), thorough);
  }
}

}  // namespace linewright::bench
