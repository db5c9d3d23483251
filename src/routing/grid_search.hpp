#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "linewright/map/occupancy_grid.hpp"

namespace linewright {

/// Shortest 8-connected ways from one cell to all others (Dijkstra; a straight step costs 1, a
/// diagonal one sqrt(2) and needs both cells beside it free). Reuses its memory from run to run.
///
/// No step costs less than 1, so cells whose costs have the same whole part cannot improve each
/// other: they are expanded in any order, and lists of such cells take the place of a heap.
class GridSearch {
 public:
  explicit GridSearch(const OccupancyGrid& grid);

  /// Searches until all of `goals` are settled or nothing is left. `start` must be free.
  void run(Cell start, const std::vector<Cell>& goals);

  /// Cost in cells; negative when the cell was not settled.
  [[nodiscard]] double cost(Cell cell) const;

  /// The cells from the start to `goal`, which must have been settled.
  [[nodiscard]] std::vector<Cell> way_to(Cell goal) const;

 private:
  struct Open {
    double cost;
    std::uint32_t index;
  };
  void clear();
  [[nodiscard]] std::uint8_t allowed_steps(Cell cell) const;
  void expand(const Open& open);
  void reach(std::uint32_t index, double cost, std::uint32_t parent);
  [[nodiscard]] bool all_settled(const std::vector<Cell>& goals) const;

  const OccupancyGrid& grid_;
  std::vector<std::uint8_t> steps_;       ///< by cell index: bit i for step i
  std::array<std::int64_t, 8> offset_{};  ///< by step: what it adds to the index
  std::vector<double> cost_;              ///< by cell index; -1: not reached
  std::vector<std::uint32_t> parent_;     ///< by cell index
  std::vector<std::uint32_t> touched_;    ///< what the last run has to clear
  /// By whole part of the cost modulo 4: a step adds less than 2, so at most three are in use.
  std::array<std::vector<Open>, 4> open_;
  double settled_below_ = 0.0;
};

}  // namespace linewright
