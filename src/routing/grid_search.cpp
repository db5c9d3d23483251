#include "grid_search.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <unordered_set>

namespace linewright {
namespace {

struct Neighbour {
  std::int32_t column;
  std::int32_t row;
};

// Straight steps first: among ways of equal cost the one with the earlier step wins, and straight
// ways are easier to pull tight.
constexpr std::array<Neighbour, 8> kNeighbours = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

}  // namespace

GridSearch::GridSearch(const OccupancyGrid& grid)
    : grid_(grid), cost_(grid.size(), -1.0), settled_(grid.size(), 0), parent_(grid.size(), 0) {}

void GridSearch::clear() {
  for (const std::size_t index : touched_) {
    cost_[index] = -1.0;
    settled_[index] = 0;
  }
  touched_.clear();
  open_.clear();
}

void GridSearch::run(Cell start, const std::vector<Cell>& goals) {
  clear();
  std::unordered_set<std::size_t> missing;
  for (const Cell goal : goals) missing.insert(grid_.index(goal));
  reach(start, 0.0, grid_.index(start));
  // Equal costs are ordered by index, so that the result does not depend on the heap's inner order.
  const auto later = [](const Open& a, const Open& b) {
    return a.cost != b.cost ? a.cost > b.cost : a.index > b.index;
  };
  while (!open_.empty() && !missing.empty()) {
    std::pop_heap(open_.begin(), open_.end(), later);
    const Open best = open_.back();
    open_.pop_back();
    if (settled_[best.index] != 0) continue;
    settled_[best.index] = 1;
    missing.erase(best.index);
    const std::size_t before = open_.size();
    expand(grid_.cell(best.index), best.cost);
    for (std::size_t end = before + 1; end <= open_.size(); ++end) {
      std::push_heap(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(end), later);
    }
  }
  // What is still open was not proven to be reached by its shortest way.
  for (const std::size_t index : touched_) {
    if (settled_[index] == 0) cost_[index] = -1.0;
  }
}

void GridSearch::expand(Cell cell, double cost) {
  for (const Neighbour& step : kNeighbours) {
    const Cell next{cell.column + step.column, cell.row + step.row};
    if (grid_.occupied(next)) continue;
    const bool diagonal = step.column != 0 && step.row != 0;
    if (diagonal && (grid_.occupied({cell.column + step.column, cell.row}) ||
                     grid_.occupied({cell.column, cell.row + step.row}))) {
      continue;
    }
    reach(next, cost + (diagonal ? std::numbers::sqrt2 : 1.0), grid_.index(cell));
  }
}

void GridSearch::reach(Cell cell, double cost, std::size_t parent) {
  const std::size_t index = grid_.index(cell);
  if (settled_[index] != 0) return;
  if (cost_[index] < 0.0) {
    touched_.push_back(index);
  } else if (cost_[index] <= cost) {
    return;
  }
  cost_[index] = cost;
  parent_[index] = parent;
  open_.push_back({cost, index});
}

std::vector<Cell> GridSearch::way_to(Cell goal) const {
  std::vector<Cell> way;
  std::size_t index = grid_.index(goal);
  way.push_back(goal);
  while (parent_[index] != index) {
    index = parent_[index];
    way.push_back(grid_.cell(index));
  }
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace linewright
