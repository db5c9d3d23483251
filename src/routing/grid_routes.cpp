#include "linewright/routing/grid_routes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grid_search.hpp"

namespace linewright {
namespace {

/// The last point that is seen from `points[from]`, found by doubling the distance and halving it
/// again: not always the very last one, but always one that is seen.
std::size_t last_seen(const OccupancyGrid& grid, const std::vector<Point2>& points,
                      std::size_t from) {
  const std::size_t end = points.size();
  std::size_t seen = from + 1;  // neighbours always see each other
  std::size_t step = 1;
  while (seen + step < end && line_of_sight(grid, points[from], points[seen + step])) {
    seen += step;
    step *= 2;
  }
  for (; step > 0; step /= 2) {
    if (seen + step < end && line_of_sight(grid, points[from], points[seen + step])) seen += step;
  }
  return seen;
}

/// Goes in straight lines from each point to one far ahead that is seen from there.
std::vector<Point2> pulled_tight(const OccupancyGrid& grid, const std::vector<Point2>& points) {
  std::vector<Point2> tight = {points.front()};
  for (std::size_t i = 0; i + 1 < points.size();) {
    i = last_seen(grid, points, i);
    tight.push_back(points[i]);
  }
  return tight;
}

double length_of(const std::vector<Point2>& path) {
  double metres = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) metres += distance_m(path[i - 1], path[i]);
  return metres;
}

/// An end of a way: where it is, and the free cell through which it is reached.
struct End {
  Point2 point;
  std::optional<Cell> cell;
};

/// From the cells to a polyline between the exact points. A point within its free cell is part of
/// what is pulled tight; another one is joined to the cell that stands for it.
GridRoute between(const OccupancyGrid& grid, const std::vector<Cell>& way, const End& from,
                  const End& to) {
  const bool start_inside = *from.cell == grid.frame().cell_at(from.point);
  const bool goal_inside = *to.cell == grid.frame().cell_at(to.point);
  std::vector<Point2> points;
  if (start_inside) points.push_back(from.point);
  for (const Cell cell : way) points.push_back(grid.frame().center(cell));
  if (goal_inside) points.push_back(to.point);
  GridRoute route;
  route.status = RouteStatus::kFound;
  // The second time works on the few corners that are left and takes out some more.
  route.path = pulled_tight(grid, pulled_tight(grid, points));
  if (!start_inside) route.path.insert(route.path.begin(), from.point);
  if (!goal_inside) route.path.push_back(to.point);
  route.metres = length_of(route.path);
  return route;
}

GridRoute reversed(GridRoute route) {
  std::reverse(route.path.begin(), route.path.end());
  if (route.status == RouteStatus::kStartOccupied) {
    route.status = RouteStatus::kGoalOccupied;
  } else if (route.status == RouteStatus::kGoalOccupied) {
    route.status = RouteStatus::kStartOccupied;
  }
  return route;
}

GridRoute route_to(const OccupancyGrid& grid, const GridSearch& search, const End& from,
                   const End& to) {
  if (!to.cell) return {RouteStatus::kGoalOccupied, 0.0, {}};
  if (search.cost(*to.cell) < 0.0) return {RouteStatus::kUnreachable, 0.0, {}};
  return between(grid, search.way_to(*to.cell), from, to);
}

std::vector<Cell> cells_of(const std::vector<End>& ends, std::size_t first) {
  std::vector<Cell> cells;
  for (std::size_t i = first; i < ends.size(); ++i) {
    if (ends[i].cell) cells.push_back(*ends[i].cell);
  }
  return cells;
}

}  // namespace

std::optional<Cell> free_cell_near(const OccupancyGrid& grid, Point2 point, double snap_m) {
  const Cell own = grid.frame().cell_at(point);
  if (!grid.blocked(own)) return own;
  const auto reach = static_cast<std::int32_t>(
      std::min(std::ceil(snap_m / grid.cell_m()) + 1.0,
               static_cast<double>(std::max(grid.columns(), grid.rows()))));
  const Cell low{std::max(own.column - reach, 0), std::max(own.row - reach, 0)};
  const Cell high{std::min(own.column + reach, grid.columns() - 1),
                  std::min(own.row + reach, grid.rows() - 1)};
  std::optional<Cell> best;
  double best_m = snap_m;
  for (std::int32_t row = low.row; row <= high.row; ++row) {
    for (std::int32_t column = low.column; column <= high.column; ++column) {
      const double metres = distance_m(grid.frame().center({column, row}), point);
      const bool nearer = best ? metres < best_m : metres <= best_m;
      if (!nearer || grid.blocked({column, row})) continue;
      best = Cell{column, row};
      best_m = metres;
    }
  }
  return best;
}

std::vector<std::vector<GridRoute>> grid_routes(const OccupancyGrid& grid,
                                                const std::vector<Point2>& points,
                                                const GridRouteOptions& options) {
  std::vector<End> ends;
  ends.reserve(points.size());
  for (const Point2 point : points) {
    ends.push_back({point, free_cell_near(grid, point, options.snap_m)});
  }
  std::vector<std::vector<GridRoute>> routes(points.size(), std::vector<GridRoute>(points.size()));
  GridSearch search(grid);
  for (std::size_t from = 0; from < ends.size(); ++from) {
    routes[from][from] = {RouteStatus::kFound, 0.0, {points[from]}};
    if (ends[from].cell) search.run(*ends[from].cell, cells_of(ends, from + 1));
    for (std::size_t to = from + 1; to < ends.size(); ++to) {
      routes[from][to] = ends[from].cell ? route_to(grid, search, ends[from], ends[to])
                                         : GridRoute{RouteStatus::kStartOccupied, 0.0, {}};
      routes[to][from] = reversed(routes[from][to]);
    }
  }
  return routes;
}

}  // namespace linewright
