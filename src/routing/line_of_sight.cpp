#include <cmath>
#include <limits>

#include "linewright/routing/grid_routes.hpp"

namespace linewright {
namespace {

/// Walks along one axis: at which share of the segment the next cell edge is crossed.
struct Axis {
  std::int32_t step = 0;                                    ///< -1, 0 or 1
  double next = std::numeric_limits<double>::infinity();    ///< share at the next crossing
  double stride = std::numeric_limits<double>::infinity();  ///< share between two crossings

  /// `start` and `delta` in cells.
  Axis(double start, double delta) {
    if (delta == 0.0) return;
    step = delta > 0.0 ? 1 : -1;
    stride = std::abs(1.0 / delta);
    const double inside = start - std::floor(start);
    next = (delta > 0.0 ? 1.0 - inside : inside) * stride;
  }
};

}  // namespace

bool line_of_sight(const OccupancyGrid& grid, Point2 from, Point2 to) {
  const Cell last = grid.frame().cell_at(to);
  Cell cell = grid.frame().cell_at(from);
  if (grid.blocked(cell) || grid.blocked(last)) return false;
  // In units of cells, relative to a cell centre, so that the fractions are exact enough
  // everywhere.
  const Point2 origin = grid.frame().center({0, 0});
  const auto in_cells = [&](double value, double zero) {
    return (value - zero) / grid.cell_m() + 0.5;
  };
  const double x = in_cells(from.x_m, origin.x_m);
  const double y = in_cells(from.y_m, origin.y_m);
  Axis columns(x, in_cells(to.x_m, origin.x_m) - x);
  Axis rows(y, in_cells(to.y_m, origin.y_m) - y);
  constexpr double kCorner = 1e-9;  // crossings closer than this share count as one corner
  // Both end cells are inside, so the walk takes at most this many crossings.
  const std::int32_t most = std::abs(last.column - cell.column) + std::abs(last.row - cell.row);
  for (std::int32_t crossings = 0; crossings < most && cell != last; ++crossings) {
    const bool corner = std::abs(columns.next - rows.next) < kCorner;
    if (corner && (grid.blocked({cell.column + columns.step, cell.row}) ||
                   grid.blocked({cell.column, cell.row + rows.step}))) {
      return false;
    }
    const bool cross_column = corner || columns.next < rows.next;
    const bool cross_row = corner || !cross_column;
    if (cross_column) {
      cell.column += columns.step;
      columns.next += columns.stride;
    }
    if (cross_row) {
      cell.row += rows.step;
      rows.next += rows.stride;
    }
    if (grid.blocked(cell)) return false;
  }
  return true;
}

}  // namespace linewright
