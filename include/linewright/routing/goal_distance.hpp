#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "linewright/map/collision_checker.hpp"

namespace linewright {

/// Length of the shortest way over the cells of a map to one goal, for a point that keeps
/// `inscribed_m` from blocked cells: what no footprint with that inscribed disc can do without. The
/// holonomic-with-obstacles heuristic of Hybrid A* (D. Dolgov et al., 2010), computed once per goal
/// and only as far as it is asked for.
///
/// Dijkstra over eight neighbours with a bucket queue; steps of 1 and sqrt(2) cells, so that
/// lengths are up to 8 % above the straight ones. A cell is left out only where the disc cannot be
/// at any point of it.
class GoalDistance {
 public:
  static constexpr float kUnreachable = std::numeric_limits<float>::infinity();

  GoalDistance(std::shared_ptr<const ClearanceMap> map, double inscribed_m, Cell goal);

  /// In cells; kUnreachable when there is no way. Goes on with the search until the cell is
  /// settled.
  [[nodiscard]] float to_goal(std::size_t cell) {
    if (distance_[cell] < settled_below_) return distance_[cell];
    return settle(cell);
  }

  [[nodiscard]] Cell goal() const { return goal_; }
  [[nodiscard]] bool passable(std::size_t cell) const {
    return ((passable_[cell / 64] >> (cell % 64)) & 1U) != 0;
  }

  /// Takes over a map of the same frame with more cells blocked than before: only the ways that
  /// lead through them are searched again (the idea of D* Lite: what still holds is kept). Returns
  /// how many cells were looked at.
  std::size_t close(std::shared_ptr<const ClearanceMap> map);

  /// Cells whose distance is known.
  [[nodiscard]] std::size_t settled() const { return settled_; }

 private:
  struct Open {
    float cost;
    std::uint32_t cell;
  };

  [[nodiscard]] float settle(std::size_t cell);
  void expand(const Open& open);
  void push(float cost, std::uint32_t cell);
  [[nodiscard]] bool step_free(Cell from, int direction) const;
  [[nodiscard]] std::vector<Open> forget_ways_through_blocked(std::size_t& looked_at);
  void search_from(std::vector<Open> seeds, std::size_t& looked_at);

  std::shared_ptr<const ClearanceMap> map_;
  double inscribed_m_;
  std::vector<std::uint64_t> passable_;  ///< a bit per cell
  Cell goal_;
  std::vector<float> distance_;
  /// By whole part of the cost modulo 4: a step adds less than 2, so at most three are in use.
  std::array<std::vector<Open>, 4> open_;
  std::size_t whole_ = 0;  ///< whole part of the costs that are settled next
  std::size_t pending_ = 0;
  float settled_below_ = 0.0F;
  std::size_t settled_ = 0;
};

}  // namespace linewright
