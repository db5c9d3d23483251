#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "areas.hpp"
#include "build_state.hpp"
#include "limits.hpp"
#include "linewright/base/files.hpp"
#include "linewright/map/map_file.hpp"
#include "linewright/scenario/values.hpp"

namespace linewright::loading {
namespace {

/// Also true for a value that was reported as wrong already.
bool has_key(const SourceNode& node, std::string_view key) {
  return std::any_of(node.entries.begin(), node.entries.end(),
                     [&](const SourceEntry& entry) { return entry.key == key; });
}

std::vector<Obstacle> obstacles_in(BuildState& state, const SourceNode& map) {
  std::vector<Obstacle> obstacles;
  const SourceNode* node = map.find("obstacles");
  if (node == nullptr) return obstacles;
  for (const SourceEntry& entry : node->entries) {
    auto area = read_area(state, entry.value, fmt::format("obstacle {}", in_quotes(entry.key)));
    if (!area) continue;
    obstacles.push_back({entry.key, std::move(*area), real_or(entry.value, "height_m", 1.0)});
  }
  return obstacles;
}

/// Cells and sides to look at for drawing the obstacle into the grid, at most.
double raster_work(const GridFrame& frame, const Polygon& obstacle) {
  Polygon in_grid;
  for (const Point2 corner : obstacle) in_grid.push_back(frame.to_grid(corner));
  const Rectangle r = bounds_of(in_grid);
  const auto cells = [&](double low_m, double high_m, std::int32_t most) {
    return std::clamp((high_m - low_m) / frame.cell_m + 2.0, 0.0, static_cast<double>(most));
  };
  const double rows = cells(r.y0_m, r.y1_m, frame.rows);
  return rows * (static_cast<double>(obstacle.size()) + cells(r.x0_m, r.x1_m, frame.columns));
}

/// The last column and row may stick out of the hall: nobody drives there.
OccupancyGrid walled_in(OccupancyGrid grid, const Rectangle& hall) {
  const GridFrame& frame = grid.frame();
  const double beyond_m = 2.0 * frame.cell_m;
  grid.add_obstacle(corners_of({hall.x1_m, hall.x1_m + beyond_m, hall.y0_m, hall.y1_m + beyond_m}));
  grid.add_obstacle(corners_of({hall.x0_m, hall.x1_m + beyond_m, hall.y1_m, hall.y1_m + beyond_m}));
  return grid;
}

/// The free grid over `bounds`; reports one that is too large.
std::optional<OccupancyGrid> free_grid(BuildState& state, const SourceNode& map,
                                       const SourceNode& bounds) {
  const auto hall = read_rectangle(state, bounds, "the map");
  if (!hall) return std::nullopt;
  const double cell_m = real_or(map, "cell_m", 0.25);
  const double area_m2 = (hall->x1_m - hall->x0_m) * (hall->y1_m - hall->y0_m);
  const double cells =
      std::ceil((hall->x1_m - hall->x0_m) / cell_m) * std::ceil((hall->y1_m - hall->y0_m) / cell_m);
  if (cells <= static_cast<double>(kMostGridCells)) {
    return walled_in(OccupancyGrid(GridFrame::covering(*hall, cell_m)), *hall);
  }
  const double fitting_m = std::sqrt(area_m2 / static_cast<double>(kMostGridCells));
  state.problems.error(mark_of(map, "cell_m"), fmt::format("the map: {}", too_many_cells(cells)),
                       fmt::format("make 'cell_m' larger: about {:.2g}", 1.1 * fitting_m));
  return std::nullopt;
}

/// Passes on what a file that the scenario names has to say about itself.
void report_all(BuildState& state, const ScenarioError& error) {
  for (const Diagnostic& d : error.diagnostics()) {
    state.problems.error({state.problems.add_file(d.file), d.line, d.column}, d.message, d.hint);
  }
}

/// The grid of the file that `occupancy` names; reports what keeps it from being read.
std::optional<OccupancyGrid> grid_from_file(BuildState& state, const SourceNode& occupancy,
                                            std::string& file) {
  if (!state.may_read_files) {
    state.problems.error(occupancy.mark, "'occupancy' needs a file, and this text has no folder",
                         "load the scenario from a file");
    return std::nullopt;
  }
  const std::string& scenario_file = state.problems.file_name(occupancy.mark.file);
  file = beside(scenario_file, occupancy.text);
  std::string reason = "the name is empty";
  if (occupancy.text.empty() || !read_file(file, 0, reason)) {
    state.problems.error(occupancy.mark, fmt::format("cannot read {}: {}", in_quotes(file), reason),
                         fmt::format("the name is relative to the folder of {}", scenario_file));
    return std::nullopt;
  }
  try {
    MapFile map = load_map_file(file);
    state.map_hash = map.content_hash;
    return std::move(map.grid);
  } catch (const ScenarioError& error) {
    report_all(state, error);
  }
  return std::nullopt;
}

/// Reports keys that contradict one another or are missing. True when there is one way to a grid.
bool check_keys(BuildState& state, const SourceNode& map) {
  const bool has_bounds = has_key(map, "bounds");
  const bool has_occupancy = has_key(map, "occupancy");
  if (!has_bounds && !has_occupancy) {
    state.problems.error(map.mark, "'map' has neither 'bounds' nor 'occupancy'",
                         "write bounds: [x0, x1, y0, y1], or occupancy: FILE.yaml");
  } else if (has_bounds && has_occupancy) {
    state.problems.error(mark_of(map, "occupancy"),
                         "'map' has both 'bounds' and 'occupancy': the map file has its own bounds",
                         "remove one of them; to remove one of an extended file write null");
  } else if (has_occupancy && has_key(map, "cell_m")) {
    state.problems.error(mark_of(map, "cell_m"),
                         "'cell_m' does not go with 'occupancy': a cell is a pixel of the image",
                         "remove it; 'resolution' in the map file says how large a pixel is");
  }
  return has_bounds != has_occupancy;
}

Rectangle bounds_of_grid(const GridFrame& frame) {
  const double width_m = frame.columns * frame.cell_m;
  const double height_m = frame.rows * frame.cell_m;
  return bounds_of({frame.to_map(Point2{0.0, 0.0}), frame.to_map(Point2{width_m, 0.0}),
                    frame.to_map(Point2{width_m, height_m}), frame.to_map(Point2{0.0, height_m})});
}

/// Draws the obstacles into the grid; reports when that would take too long.
void add_obstacles(BuildState& state, SourceMark mark, const std::vector<Obstacle>& obstacles,
                   OccupancyGrid& grid) {
  double work = 0.0;
  for (const Obstacle& obstacle : obstacles) work += raster_work(grid.frame(), obstacle.polygon);
  if (work > kMostRasterWork) {
    state.problems.error(mark, "the obstacles cover too many cells of the map",
                         "make 'cell_m' larger, or the obstacles smaller");
    return;
  }
  for (const Obstacle& obstacle : obstacles) grid.add_obstacle(obstacle.polygon);
}

}  // namespace

void build_map(BuildState& state) {
  const SourceNode* node = state.root.find("map");
  if (node == nullptr) return;
  HallMap map;
  map.obstacles = obstacles_in(state, *node);
  if (!check_keys(state, *node)) return;
  const SourceNode* bounds = node->find("bounds");
  const SourceNode* occupancy = node->find("occupancy");
  std::optional<OccupancyGrid> grid;
  if (bounds != nullptr) grid = free_grid(state, *node, *bounds);
  if (occupancy != nullptr) grid = grid_from_file(state, *occupancy, map.occupancy);
  if (!grid) return;
  add_obstacles(state, node->mark, map.obstacles, *grid);
  map.bounds = bounds_of_grid(grid->frame());
  map.cell_m = grid->cell_m();
  if (bounds != nullptr) map.bounds = *read_rectangle(state, *bounds, "the map");
  map.grid = std::make_shared<const OccupancyGrid>(std::move(*grid));
  state.scenario.map = std::move(map);
}

}  // namespace linewright::loading
