#include "linewright/routing/goal_distance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "aisles.hpp"

namespace linewright {
namespace {

constexpr std::array<Cell, 8> kSteps = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
constexpr int kStraight = 4;  // steps before this one
constexpr float kDiagonal = 1.41421356F;

}  // namespace

GoalDistance::GoalDistance(std::shared_ptr<const ClearanceMap> map, double inscribed_m, Cell goal)
    : map_(std::move(map)),
      inscribed_m_(inscribed_m),
      passable_(passable_cells(*map_, inscribed_m)),
      goal_(goal),
      distance_(map_->frame().size(), kUnreachable) {
  if (!map_->frame().contains(goal)) return;
  const auto cell = static_cast<std::uint32_t>(map_->frame().index(goal));
  distance_[cell] = 0.0F;
  push(0.0F, cell);
}

void GoalDistance::push(float cost, std::uint32_t cell) {
  open_[static_cast<std::size_t>(cost) % open_.size()].push_back({cost, cell});
  ++pending_;
}

float GoalDistance::settle(std::size_t cell) {
  while (pending_ > 0 && distance_[cell] >= settled_below_) {
    std::vector<Open>& list = open_[whole_ % open_.size()];
    pending_ -= list.size();
    // No step costs less than 1: what has the same whole part cannot improve each other.
    for (const Open& open : list) expand(open);
    list.clear();
    ++whole_;
    settled_below_ = static_cast<float>(whole_);
  }
  if (pending_ == 0) settled_below_ = kUnreachable;
  return distance_[cell];
}

bool GoalDistance::step_free(Cell from, int direction) const {
  const Cell step = kSteps[static_cast<std::size_t>(direction)];
  const Cell to{from.column + step.column, from.row + step.row};
  const GridFrame& frame = map_->frame();
  if (!frame.contains(to) || !passable(frame.index(to))) return false;
  if (direction < kStraight) return true;
  // Between two blocked cells that touch at a corner nothing fits through.
  return passable(frame.index({to.column, from.row})) ||
         passable(frame.index({from.column, to.row}));
}

void GoalDistance::expand(const Open& open) {
  if (distance_[open.cell] < open.cost) return;  // a shorter way was found meanwhile
  ++settled_;
  const Cell from = map_->frame().cell(open.cell);
  for (int i = 0; i < 8; ++i) {
    if (!step_free(from, i)) continue;
    const Cell step = kSteps[static_cast<std::size_t>(i)];
    const auto to = static_cast<std::uint32_t>(
        map_->frame().index({from.column + step.column, from.row + step.row}));
    const float cost = open.cost + (i < kStraight ? 1.0F : kDiagonal);
    if (cost >= distance_[to]) continue;
    distance_[to] = cost;
    push(cost, to);
  }
}

/// Forgets every distance that may belong to a way through a cell that is impassable now, and
/// returns what the search has to go on from.
std::vector<GoalDistance::Open> GoalDistance::forget_ways_through_blocked(std::size_t& looked_at) {
  const GridFrame& frame = map_->frame();
  std::vector<Open> forgotten;
  const std::size_t goal = frame.contains(goal_) ? frame.index(goal_) : distance_.size();
  const auto forget = [&](std::size_t cell) {
    if (distance_[cell] == kUnreachable || cell == goal) return;
    forgotten.push_back({distance_[cell], static_cast<std::uint32_t>(cell)});
    distance_[cell] = kUnreachable;
  };
  const auto each_neighbour = [&](std::size_t cell, auto&& visit) {
    const Cell at = frame.cell(cell);
    for (std::size_t s = 0; s < kSteps.size(); ++s) {
      const Cell to{at.column + kSteps[s].column, at.row + kSteps[s].row};
      if (frame.contains(to)) visit(frame.index(to), s < kStraight ? 1.0F : kDiagonal);
    }
  };
  for (std::size_t cell = 0; cell < distance_.size(); ++cell) {
    if (distance_[cell] == kUnreachable || passable(cell)) continue;
    forget(cell);
    // Diagonal steps past it may be gone, too.
    each_neighbour(cell, [&](std::size_t near, float) { forget(near); });
  }
  constexpr float kRounding = 1e-3F;
  for (std::size_t i = 0; i < forgotten.size(); ++i) {
    const Open from = forgotten[i];
    each_neighbour(from.cell, [&](std::size_t near, float step) {
      if (distance_[near] >= from.cost + step - kRounding) forget(near);
    });
  }
  looked_at += forgotten.size();

  std::vector<Open> seeds;
  for (auto& list : open_) {
    for (const Open& open : list) {
      if (distance_[open.cell] == open.cost) seeds.push_back(open);
    }
    list.clear();
  }
  for (const Open& gone : forgotten) {
    each_neighbour(gone.cell, [&](std::size_t near, float) {
      if (distance_[near] < kUnreachable) {
        seeds.push_back({distance_[near], static_cast<std::uint32_t>(near)});
      }
    });
  }
  return seeds;
}

void GoalDistance::search_from(std::vector<Open> seeds, std::size_t& looked_at) {
  std::sort(seeds.begin(), seeds.end(), [](const Open& a, const Open& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.cell < b.cell;
  });
  // The bucket queue has room for three units of cost, so the seeds enter as the search gets there.
  pending_ = 0;
  for (std::size_t next = 0; next < seeds.size() || pending_ > 0; ++whole_) {
    if (pending_ == 0) whole_ = static_cast<std::size_t>(seeds[next].cost);
    for (; next < seeds.size() && static_cast<std::size_t>(seeds[next].cost) <= whole_; ++next) {
      push(seeds[next].cost, seeds[next].cell);
    }
    std::vector<Open>& list = open_[whole_ % open_.size()];
    pending_ -= list.size();
    looked_at += list.size();
    for (const Open& open : list) expand(open);
    list.clear();
  }
  settled_below_ = kUnreachable;
}

std::size_t GoalDistance::close(std::shared_ptr<const ClearanceMap> map) {
  map_ = std::move(map);
  passable_ = passable_cells(*map_, inscribed_m_);
  std::size_t looked_at = 0;
  search_from(forget_ways_through_blocked(looked_at), looked_at);
  return looked_at;
}

}  // namespace linewright
