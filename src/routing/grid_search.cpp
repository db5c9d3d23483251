#include "grid_search.hpp"

#include <algorithm>
#include <numbers>

namespace linewright {
namespace {

// Straight steps first: among ways of equal cost the one that was found first stays, and straight
// ways are easier to pull tight.
constexpr std::array<Cell, 8> kSteps = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

constexpr std::size_t kStraight = 4;  // steps before this one

}  // namespace

GridSearch::GridSearch(const OccupancyGrid& grid)
    : grid_(grid), steps_(grid.size()), cost_(grid.size(), -1.0), parent_(grid.size(), 0) {
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    offset_[i] = std::int64_t{kSteps[i].row} * grid.columns() + kSteps[i].column;
  }
  for (std::size_t i = 0; i < steps_.size(); ++i) steps_[i] = allowed_steps(grid.frame().cell(i));
}

std::uint8_t GridSearch::allowed_steps(Cell cell) const {
  if (grid_.blocked(cell)) return 0;
  unsigned steps = 0;
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    const Cell step = kSteps[i];
    const bool free = !grid_.blocked({cell.column + step.column, cell.row + step.row}) &&
                      !grid_.blocked({cell.column + step.column, cell.row}) &&
                      !grid_.blocked({cell.column, cell.row + step.row});
    if (free) steps |= 1U << i;
  }
  return static_cast<std::uint8_t>(steps);
}

void GridSearch::clear() {
  for (const std::uint32_t index : touched_) cost_[index] = -1.0;
  touched_.clear();
  for (auto& list : open_) list.clear();
  settled_below_ = 0.0;
}

bool GridSearch::all_settled(const std::vector<Cell>& goals) const {
  return std::all_of(goals.begin(), goals.end(), [this](Cell goal) { return cost(goal) >= 0.0; });
}

void GridSearch::run(Cell start, const std::vector<Cell>& goals) {
  clear();
  const auto first = static_cast<std::uint32_t>(grid_.frame().index(start));
  reach(first, 0.0, first);
  std::size_t empty_lists = 0;
  for (std::size_t whole = 0; empty_lists < open_.size(); ++whole) {
    std::vector<Open>& list = open_[whole % open_.size()];
    empty_lists = list.empty() ? empty_lists + 1 : 0;
    for (const Open& open : list) expand(open);  // adds to other lists only
    list.clear();
    settled_below_ += 1.0;
    // Looking at the goals takes time, too: not after every list.
    if (whole % 16 == 0 && all_settled(goals)) return;
  }
}

void GridSearch::expand(const Open& open) {
  if (cost_[open.index] < open.cost) return;  // a shorter way was found meanwhile
  const std::uint8_t steps = steps_[open.index];
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    if ((steps >> i & 1) == 0) continue;
    const double cost = open.cost + (i < kStraight ? 1.0 : std::numbers::sqrt2);
    reach(static_cast<std::uint32_t>(open.index + offset_[i]), cost, open.index);
  }
}

void GridSearch::reach(std::uint32_t index, double cost, std::uint32_t parent) {
  if (cost_[index] < 0.0) {
    touched_.push_back(index);
  } else if (cost_[index] <= cost) {
    return;
  }
  cost_[index] = cost;
  parent_[index] = parent;
  open_[static_cast<std::size_t>(cost) % open_.size()].push_back({cost, index});
}

double GridSearch::cost(Cell cell) const {
  const double cost = cost_[grid_.frame().index(cell)];
  return cost < settled_below_ ? cost : -1.0;
}

std::vector<Cell> GridSearch::way_to(Cell goal) const {
  std::vector<Cell> way = {goal};
  auto index = static_cast<std::uint32_t>(grid_.frame().index(goal));
  while (parent_[index] != index) {
    index = parent_[index];
    way.push_back(grid_.frame().cell(index));
  }
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace linewright
