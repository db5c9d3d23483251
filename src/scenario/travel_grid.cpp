#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "limits.hpp"
#include "linewright/map/occupancy_grid.hpp"
#include "linewright/routing/grid_routes.hpp"
#include "travel.hpp"

namespace linewright::loading {
namespace {

double cells_in(const Rectangle& r, double margin_m, double cell_m) {
  return ((r.x1_m - r.x0_m + 2 * margin_m) / cell_m + 2) *
         ((r.y1_m - r.y0_m + 2 * margin_m) / cell_m + 2);
}

/// Cell visits that building the grid and searching from every point will take at most.
double work_of(const HallMap& map, double radius_m, std::size_t points) {
  const double all = cells_in(map.bounds, 0.0, map.cell_m);
  double work = all * static_cast<double>(points);
  for (const Obstacle& obstacle : map.obstacles) {
    // Obstacles are cheaper per cell than searching.
    work += 0.1 * std::min(all, cells_in(bounds_of(obstacle.polygon),
                                         std::max(radius_m, map.cell_m), map.cell_m));
  }
  return work;
}

OccupancyGrid grid_of(const HallMap& map, double radius_m) {
  OccupancyGrid grid = *map.grid;
  for (const Obstacle& o : map.obstacles) {
    const Rectangle r = bounds_of(o.polygon);
    grid.add_obstacle(
        corners_of({r.x0_m - radius_m, r.x1_m + radius_m, r.y0_m - radius_m, r.y1_m + radius_m}));
  }
  return grid;
}

/// "obstacle 'table'", the one nearest to the point, or the map.
std::string culprit(const HallMap& map, Point2 point) {
  if (distance_to_m(point, corners_of(map.bounds)) > 0.0) return "the edge of the map";
  if (map.obstacles.empty())
    return map.occupancy.empty() ? "the edge of the map" : in_quotes(map.occupancy);
  const auto nearest = std::min_element(
      map.obstacles.begin(), map.obstacles.end(), [&](const Obstacle& a, const Obstacle& b) {
        return distance_to_m(point, a.polygon) < distance_to_m(point, b.polygon);
      });
  return "obstacle " + in_quotes(nearest->name);
}

/// The stations that workers of the kind can stand at, and where.
struct Stops {
  std::vector<StationId> stations;
  std::vector<Point2> points;
};

Stops stops_of(const BuildState& state, std::size_t kind) {
  Stops stops;
  for (std::size_t i = 0; i < state.line().stations.size(); ++i) {
    const auto& pose = state.line().stations[i].poses[kind];
    if (!pose) continue;
    stops.stations.emplace_back(i);
    stops.points.push_back(pose->point());
  }
  return stops;
}

/// Reports the stops that no free cell is near to. True when there are none of these.
bool check_stops(const BuildState& state, std::size_t kind, const Stops& stops,
                 const OccupancyGrid& grid, const GridRouteOptions& options) {
  const WorkerKind& worker = state.line().worker_kinds[kind];
  bool all_free = true;
  for (std::size_t i = 0; i < stops.points.size(); ++i) {
    if (free_cell_near(grid, stops.points[i], options.snap_m)) continue;
    all_free = false;
    const StationId station = stops.stations[i];
    state.problems.error(
        state.names.mark(Section::kStations, station.value),
        fmt::format("station {}: {} (radius {} m) cannot stand there because of {}",
                    in_quotes(state.line().stations[station.index()].name), in_quotes(worker.name),
                    worker.radius_m, culprit(*state.scenario.map, stops.points[i])),
        fmt::format("move the pose to within {} m of free space", options.snap_m));
  }
  return all_free;
}

}  // namespace

void fill_from_grid(BuildState& state, std::size_t kind, SourceMark mark) {
  // Inside of a map or a station that was reported there is nothing to search.
  if (!state.problems.none()) return;
  const HallMap& map = *state.scenario.map;
  const double radius_m = state.line().worker_kinds[kind].radius_m;
  const Stops stops = stops_of(state, kind);
  if (work_of(map, radius_m, stops.points.size()) > kMostGridWork) {
    state.problems.error(mark, "the map has too many cells to search the ways between all stations",
                         "make 'cell_m' larger");
    return;
  }
  const OccupancyGrid grid = grid_of(map, radius_m);
  const GridRouteOptions options;
  if (!check_stops(state, kind, stops, grid, options)) return;
  auto routes = grid_routes(grid, stops.points, options);
  TravelTable& table = state.line().travel[kind];
  for (std::size_t a = 0; a < routes.size(); ++a) {
    for (std::size_t b = 0; b < routes.size(); ++b) {
      GridRoute& route = routes[a][b];
      if (a == b || route.status != RouteStatus::kFound) continue;
      const auto ticks = ticks_for(state, kind, route.metres, mark);
      if (!ticks) return;
      table.set(stops.stations[a], stops.stations[b], {*ticks, route.metres});
      std::vector<WayPoint> way;
      double metres = 0.0;
      for (std::size_t i = 0; i < route.path.size(); ++i) {
        if (i > 0) metres += distance_m(route.path[i - 1], route.path[i]);
        way.push_back({{route.path[i].x_m, route.path[i].y_m, 0.0}, metres / route.metres});
      }
      table.set_path(stops.stations[a], stops.stations[b], std::move(way));
    }
  }
}

}  // namespace linewright::loading
