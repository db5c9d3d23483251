#include "linewright/map/occupancy_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linewright/map/row_spans.hpp"

namespace linewright {
namespace {

/// Cell counts and coordinates are int32; anything beyond is outside of every grid anyway.
std::int32_t to_index(double cells) {
  constexpr double kLimit = 1e9;
  return static_cast<std::int32_t>(std::clamp(std::floor(cells), -kLimit, kLimit));
}

std::int32_t cells_along(double length_m, double cell_m) {
  // 10 m in cells of 0.1 m are 100 cells, not 101 because of the last bit.
  constexpr double kSlack = 1e-9;
  return std::max(1, to_index(std::ceil(length_m / cell_m - kSlack)));
}

}  // namespace

GridFrame GridFrame::covering(const Rectangle& bounds, double cell_m) {
  return {.origin = {bounds.x0_m, bounds.y0_m, 0.0},
          .cell_m = cell_m,
          .columns = cells_along(bounds.x1_m - bounds.x0_m, cell_m),
          .rows = cells_along(bounds.y1_m - bounds.y0_m, cell_m)};
}

Point2 GridFrame::to_grid(Point2 p) const {
  const double dx = p.x_m - origin.x_m;
  const double dy = p.y_m - origin.y_m;
  if (origin.heading_rad == 0.0) return {dx, dy};
  const double c = std::cos(origin.heading_rad);
  const double s = std::sin(origin.heading_rad);
  return {c * dx + s * dy, c * dy - s * dx};
}

Pose2 GridFrame::to_grid(Pose2 p) const {
  const Point2 point = to_grid(p.point());
  return {point.x_m, point.y_m, p.heading_rad - origin.heading_rad};
}

Point2 GridFrame::to_map(Point2 p) const {
  if (origin.heading_rad == 0.0) return {origin.x_m + p.x_m, origin.y_m + p.y_m};
  const double c = std::cos(origin.heading_rad);
  const double s = std::sin(origin.heading_rad);
  return {origin.x_m + c * p.x_m - s * p.y_m, origin.y_m + s * p.x_m + c * p.y_m};
}

Pose2 GridFrame::to_map(Pose2 p) const {
  const Point2 point = to_map(p.point());
  return {point.x_m, point.y_m, p.heading_rad + origin.heading_rad};
}

Cell GridFrame::cell(std::size_t index) const {
  const auto width = static_cast<std::size_t>(columns);
  return {static_cast<std::int32_t>(index % width), static_cast<std::int32_t>(index / width)};
}

Cell GridFrame::cell_at(Point2 in_map) const {
  const Point2 p = to_grid(in_map);
  return {to_index(p.x_m / cell_m), to_index(p.y_m / cell_m)};
}

Point2 GridFrame::center(Cell cell) const {
  return to_map(Point2{(cell.column + 0.5) * cell_m, (cell.row + 0.5) * cell_m});
}

std::string too_many_cells(double cells) {
  return fmt::format(
      "{:.0f} cells, more than {}: the grid would take about {:.0f} MB, and routes on it several "
      "times as much",
      cells, kMostGridCells, std::ceil(cells / 1e6));
}

OccupancyGrid::OccupancyGrid(const GridFrame& frame)
    : frame_(frame), cells_(frame.size(), CellState::kFree) {}

void OccupancyGrid::add_obstacle(const Polygon& obstacle) {
  Polygon in_cells;
  in_cells.reserve(obstacle.size());
  for (const Point2 corner : obstacle) {
    const Point2 p = frame_.to_grid(corner);
    in_cells.push_back({p.x_m / frame_.cell_m, p.y_m / frame_.cell_m});
  }
  RowSpans spans(in_cells, is_convex(in_cells));
  const std::int32_t last_row = std::min(spans.last_row(), frame_.rows - 1);
  for (std::int32_t row = std::max(0, spans.first_row()); row <= last_row; ++row) {
    spans.any_in_row(row, [&](ColumnSpan span) {
      const std::int32_t last = std::min(span.last, frame_.columns - 1);
      for (std::int32_t column = std::max(0, span.first); column <= last; ++column) {
        set({column, row}, CellState::kOccupied);
      }
      return false;
    });
  }
}

std::size_t OccupancyGrid::count(CellState state) const {
  return static_cast<std::size_t>(std::count(cells_.begin(), cells_.end(), state));
}

}  // namespace linewright
