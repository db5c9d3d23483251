#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "linewright/base/geometry.hpp"
#include "linewright/map/polygon.hpp"

namespace linewright {

/// One cell of a grid: column and row, both counted from the grid's origin.
struct Cell {
  std::int32_t column = 0;
  std::int32_t row = 0;
  friend bool operator==(Cell, Cell) = default;
};

/// Where a grid lies in the frame `map` (ROS map_server): `origin` is the pose of the lower left
/// corner of cell (0, 0), columns run along its x axis and rows along its y axis.
struct GridFrame {
  Pose2 origin;
  double cell_m = 0.25;  ///< > 0
  std::int32_t columns = 1;
  std::int32_t rows = 1;

  /// A frame without yaw that covers the rectangle; its last column and row may stick out.
  [[nodiscard]] static GridFrame covering(const Rectangle& bounds, double cell_m);

  /// From the frame `map` to metres along the grid's own axes, and back.
  [[nodiscard]] Point2 to_grid(Point2 in_map) const;
  [[nodiscard]] Pose2 to_grid(Pose2 in_map) const;
  [[nodiscard]] Point2 to_map(Point2 in_grid) const;
  [[nodiscard]] Pose2 to_map(Pose2 in_grid) const;

  [[nodiscard]] bool contains(Cell cell) const {
    return cell.column >= 0 && cell.column < columns && cell.row >= 0 && cell.row < rows;
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  /// Row by row; the cell must be contained.
  [[nodiscard]] std::size_t index(Cell cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(cell.column);
  }
  [[nodiscard]] Cell cell(std::size_t index) const;
  /// The cell around a point of the frame `map`, which may lie outside of the grid (then so does
  /// the cell). The coordinates must be finite.
  [[nodiscard]] Cell cell_at(Point2 in_map) const;
  /// The middle of the cell, in the frame `map`.
  [[nodiscard]] Point2 center(Cell cell) const;
};

/// What a grid may have at most: 4000 x 4000 cells, 400 m x 400 m at 0.1 m. A grid takes one byte
/// per cell, the search for routes on it several times as much.
inline constexpr std::int64_t kMostGridCells = 16'000'000;

/// "400000000 cells, more than 16000000; ..." with the memory they would take. For messages.
[[nodiscard]] std::string too_many_cells(double cells);

enum class CellState : std::uint8_t { kFree, kOccupied, kUnknown };

/// A hall cut into square cells. Only free cells may be driven on: what is unknown, and everything
/// outside, blocks the way as an obstacle does. One byte per cell.
class OccupancyGrid {
 public:
  /// All cells free. The caller keeps the number of cells in bounds.
  explicit OccupancyGrid(const GridFrame& frame);

  /// Occupies every cell that the obstacle (in the frame `map`) covers a part of; touching is not
  /// covering.
  void add_obstacle(const Polygon& obstacle);

  void set(Cell cell, CellState state) { cells_[frame_.index(cell)] = state; }
  [[nodiscard]] CellState state(Cell cell) const { return cells_[frame_.index(cell)]; }
  /// Occupied, unknown or outside.
  [[nodiscard]] bool blocked(Cell cell) const {
    return !frame_.contains(cell) || cells_[frame_.index(cell)] != CellState::kFree;
  }
  [[nodiscard]] std::size_t count(CellState state) const;

  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] std::int32_t columns() const { return frame_.columns; }
  [[nodiscard]] std::int32_t rows() const { return frame_.rows; }
  [[nodiscard]] double cell_m() const { return frame_.cell_m; }
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] const std::vector<CellState>& cells() const { return cells_; }

 private:
  GridFrame frame_;
  std::vector<CellState> cells_;
};

}  // namespace linewright
