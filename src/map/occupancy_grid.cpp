#include "linewright/map/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>

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

double gap(double value, double low, double high) {
  return std::max({low - value, 0.0, value - high});
}

}  // namespace

double distance_to_m(Point2 point, const Rectangle& r) {
  return std::hypot(gap(point.x_m, r.x0_m, r.x1_m), gap(point.y_m, r.y0_m, r.y1_m));
}

OccupancyGrid::OccupancyGrid(const Rectangle& bounds, double cell_m)
    : bounds_(bounds),
      cell_m_(cell_m),
      columns_(cells_along(bounds.x1_m - bounds.x0_m, cell_m)),
      rows_(cells_along(bounds.y1_m - bounds.y0_m, cell_m)),
      occupied_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0) {}

void OccupancyGrid::add_obstacle(const Rectangle& obstacle, double clearance_m) {
  const double reach = std::max(clearance_m, cell_m_);
  const Cell low = cell_at({obstacle.x0_m - reach, obstacle.y0_m - reach});
  const Cell high = cell_at({obstacle.x1_m + reach, obstacle.y1_m + reach});
  const double half = cell_m_ / 2;
  // Touching is not covering: an obstacle that ends on a cell's edge leaves the cell free.
  constexpr double kSlack = 1e-9;
  for (std::int32_t row = std::max(0, low.row); row <= std::min(high.row, rows_ - 1); ++row) {
    for (std::int32_t column = std::max(0, low.column);
         column <= std::min(high.column, columns_ - 1); ++column) {
      const Point2 middle = center({column, row});
      const bool covered = gap(middle.x_m, obstacle.x0_m, obstacle.x1_m) < half - kSlack &&
                           gap(middle.y_m, obstacle.y0_m, obstacle.y1_m) < half - kSlack;
      const bool close = distance_to_m(middle, obstacle) < clearance_m - kSlack;
      if (covered || close) occupied_[index({column, row})] = 1;
    }
  }
}

bool OccupancyGrid::contains(Cell cell) const {
  return cell.column >= 0 && cell.column < columns_ && cell.row >= 0 && cell.row < rows_;
}

Cell OccupancyGrid::cell_at(Point2 point) const {
  return {to_index((point.x_m - bounds_.x0_m) / cell_m_),
          to_index((point.y_m - bounds_.y0_m) / cell_m_)};
}

Point2 OccupancyGrid::center(Cell cell) const {
  return {bounds_.x0_m + (cell.column + 0.5) * cell_m_, bounds_.y0_m + (cell.row + 0.5) * cell_m_};
}

Cell OccupancyGrid::cell(std::size_t index) const {
  const auto columns = static_cast<std::size_t>(columns_);
  return {static_cast<std::int32_t>(index % columns), static_cast<std::int32_t>(index / columns)};
}

}  // namespace linewright
