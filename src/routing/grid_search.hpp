#pragma once

#include <cstddef>
#include <vector>

#include "linewright/map/occupancy_grid.hpp"

namespace linewright {

/// Shortest 8-connected ways from one cell to all others (Dijkstra; a straight step costs 1, a
/// diagonal one sqrt(2) and needs both cells beside it free). Reuses its memory from run to run.
class GridSearch {
 public:
  explicit GridSearch(const OccupancyGrid& grid);

  /// Searches until all of `goals` are settled or nothing is left. `start` must be free.
  void run(Cell start, const std::vector<Cell>& goals);

  /// Cost in cells; negative when the cell was not reached.
  [[nodiscard]] double cost(Cell cell) const { return cost_[grid_.index(cell)]; }

  /// The cells from the start to `goal`, which must have been reached.
  [[nodiscard]] std::vector<Cell> way_to(Cell goal) const;

 private:
  struct Open {
    double cost;
    std::size_t index;
  };
  void clear();
  void expand(Cell cell, double cost);
  void reach(Cell cell, double cost, std::size_t parent);

  const OccupancyGrid& grid_;
  std::vector<double> cost_;           ///< by cell index; -1: not reached
  std::vector<std::uint8_t> settled_;  ///< by cell index
  std::vector<std::size_t> parent_;    ///< by cell index
  std::vector<std::size_t> touched_;   ///< what the last run has to clear
  std::vector<Open> open_;             ///< binary heap
};

}  // namespace linewright
