#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "linewright/base/geometry.hpp"

namespace linewright {

/// An axis-parallel rectangle in the frame `map`, metres. x0 < x1 and y0 < y1.
struct Rectangle {
  double x0_m = 0.0;
  double x1_m = 0.0;
  double y0_m = 0.0;
  double y1_m = 0.0;
};

/// Distance from the point to the rectangle in metres; 0 inside of it.
[[nodiscard]] double distance_to_m(Point2 point, const Rectangle& rectangle);

/// One cell of a grid: column and row, both counted from the corner with the smallest coordinates.
struct Cell {
  std::int32_t column = 0;
  std::int32_t row = 0;
  friend bool operator==(Cell, Cell) = default;
};

/// A hall cut into square cells, each free or occupied. Free for one kind of worker: its centre can
/// stand there. Everything outside of the bounds is occupied.
class OccupancyGrid {
 public:
  /// All cells free. Cells cover the bounds from their lower left corner on; the last column and
  /// row may stick out. `cell_m` > 0. The memory is one byte per cell: keep the number of cells in
  /// bounds.
  OccupancyGrid(const Rectangle& bounds, double cell_m);

  /// Occupies the cells that the obstacle covers a part of, and those whose centre is closer than
  /// `clearance_m` to it (the radius of a worker).
  void add_obstacle(const Rectangle& obstacle, double clearance_m);

  [[nodiscard]] std::int32_t columns() const { return columns_; }
  [[nodiscard]] std::int32_t rows() const { return rows_; }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] std::size_t size() const { return occupied_.size(); }

  [[nodiscard]] bool contains(Cell cell) const;
  /// True outside of the grid, too.
  [[nodiscard]] bool occupied(Cell cell) const {
    return !contains(cell) || occupied_[index(cell)] != 0;
  }

  /// The cell around a point, which may lie outside of the grid. The coordinates must be finite.
  [[nodiscard]] Cell cell_at(Point2 point) const;
  [[nodiscard]] Point2 center(Cell cell) const;

  /// Row by row; `cell` must be contained.
  [[nodiscard]] std::size_t index(Cell cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(cell.column);
  }
  [[nodiscard]] Cell cell(std::size_t index) const;

 private:
  Rectangle bounds_;
  double cell_m_;
  std::int32_t columns_;
  std::int32_t rows_;
  std::vector<std::uint8_t> occupied_;
};

}  // namespace linewright
