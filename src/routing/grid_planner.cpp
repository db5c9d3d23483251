#include "grid_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "smoothing.hpp"

namespace linewright {
namespace {

using Kind = PathSegment::Kind;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::size_t kStart = std::numeric_limits<std::size_t>::max();

Mover disc_around(const Mover& mover) {
  return {Footprint::circle(mover.footprint.circumscribed_m()), 0.0};
}

}  // namespace

GridPlanner::GridPlanner(std::shared_ptr<const ClearanceMap> map, const Mover& mover,
                         const PathPlannerOptions& options, bool uses_estimate)
    : map_(std::move(map)),
      options_(options),
      checker_(map_, disc_around(mover).footprint.grown(options.clearance_m)),
      disc_(disc_around(mover)),
      steering_(checker_, disc_, options),
      uses_estimate_(uses_estimate),
      cost_(map_->frame().size(), kInfinite),
      from_(map_->frame().size(), kStart),
      last_(map_->frame().size(), -1.0) {}

Point2 GridPlanner::middle(std::size_t cell) const {
  const Cell c = map_->frame().cell(cell);
  return {(c.column + 0.5) * map_->frame().cell_m, (c.row + 0.5) * map_->frame().cell_m};
}

bool GridPlanner::segment_free(Point2 from, Point2 to) const {
  const PathSegment piece{Kind::kStraight, distance_m(from, to)};
  const double bearing = std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
  return checker_.free({to.x_m, to.y_m, 0.0}) &&
         steering_.free({from.x_m, from.y_m, bearing}, {&piece, 1});
}

std::vector<std::size_t> GridPlanner::cells_near(Point2 point) const {
  const GridFrame& frame = map_->frame();
  const Cell own{static_cast<std::int32_t>(std::floor(point.x_m / frame.cell_m)),
                 static_cast<std::int32_t>(std::floor(point.y_m / frame.cell_m))};
  std::vector<std::size_t> near;
  for (std::int32_t row = own.row - 1; row <= own.row + 1; ++row) {
    for (std::int32_t column = own.column - 1; column <= own.column + 1; ++column) {
      if (!frame.contains({column, row})) continue;
      const std::size_t cell = frame.index({column, row});
      if (segment_free(point, middle(cell))) near.push_back(cell);
    }
  }
  return near;
}

void GridPlanner::reach(std::size_t cell, double cost, std::size_t from, Point2 goal) {
  if (cost_[cell] <= cost) return;
  if (cost_[cell] == kInfinite) touched_.push_back(cell);
  cost_[cell] = cost;
  from_[cell] = from;
  const double left = uses_estimate_ ? distance_m(middle(cell), goal) : 0.0;
  open_.push_back({cost + left, cost, cell});
  std::push_heap(open_.begin(), open_.end());
}

void GridPlanner::expand(std::size_t cell, Point2 goal) {
  const Cell at = map_->frame().cell(cell);
  for (std::int32_t dy = -1; dy <= 1; ++dy) {
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      const Cell to{at.column + dx, at.row + dy};
      if ((dx == 0 && dy == 0) || !map_->frame().contains(to)) continue;
      const std::size_t next = map_->frame().index(to);
      const double cost = cost_[cell] + std::hypot(dx, dy) * map_->frame().cell_m;
      if (cost_[next] <= cost || !segment_free(middle(cell), middle(next))) continue;
      reach(next, cost, cell, goal);
    }
  }
}

bool GridPlanner::search(Point2 start, Point2 goal) {
  for (const std::size_t cell : touched_) cost_[cell] = kInfinite;
  touched_.clear();
  open_.clear();
  for (const std::size_t cell : cells_near(start)) {
    reach(cell, distance_m(start, middle(cell)), kStart, goal);
  }
  const std::vector<std::size_t> ends = cells_near(goal);
  for (const std::size_t cell : ends) last_[cell] = distance_m(middle(cell), goal);
  double best = kInfinite;
  while (!open_.empty() && open_.front().priority < best) {
    std::pop_heap(open_.begin(), open_.end());
    const Open open = open_.back();
    open_.pop_back();
    if (cost_[open.cell] < open.cost) continue;
    if (++effort_.expansions > options_.most_expansions) break;
    if (effort_.expansions % 4096 == 0 && options_.cancel != nullptr &&
        options_.cancel->requested()) {
      break;
    }
    if (last_[open.cell] >= 0.0 && open.cost + last_[open.cell] < best) {
      best = open.cost + last_[open.cell];
      end_ = open.cell;
    }
    expand(open.cell, goal);
  }
  for (const std::size_t cell : ends) last_[cell] = -1.0;
  return best < kInfinite;
}

Path GridPlanner::path_to(const Pose2& start, const Pose2& goal) const {
  std::vector<Point2> points{goal.point()};
  for (std::size_t cell = end_; cell != kStart; cell = from_[cell]) points.push_back(middle(cell));
  Path path;
  path.status = PathStatus::kFound;
  path.start = start;
  Pose2 pose = start;
  for (auto to = points.rbegin(); to != points.rend(); ++to) {
    const double metres = distance_m(pose.point(), *to);
    if (metres <= 0.0) continue;
    const double bearing = std::atan2(to->y_m - pose.y_m, to->x_m - pose.x_m);
    append_segment(
        path, {Kind::kTurn, std::remainder(bearing - pose.heading_rad, 2.0 * std::numbers::pi)});
    append_segment(path, {Kind::kStraight, metres});
    pose = {to->x_m, to->y_m, bearing};
  }
  append_segment(path, {Kind::kTurn, std::remainder(goal.heading_rad - pose.heading_rad,
                                                    2.0 * std::numbers::pi)});
  return path;
}

Path GridPlanner::plan(const Pose2& start_in_map, const Pose2& goal_in_map) {
  effort_ = {};
  const Pose2 start = map_->frame().to_grid(start_in_map);
  const Pose2 goal = map_->frame().to_grid(goal_in_map);
  Path path;
  if (!checker_.free(start)) {
    path.status = PathStatus::kStartOccupied;
  } else if (!checker_.free(goal)) {
    path.status = PathStatus::kGoalOccupied;
  } else if (!search(start.point(), goal.point())) {
    path.status = open_.empty() ? PathStatus::kNoAisle : PathStatus::kSearchLimit;
  } else {
    path = path_to(start, goal);
    smooth(path, steering_, options_.smoothing_passes);
    take_short_turns(path);
  }
  path.start = start_in_map;
  return path;
}

}  // namespace linewright
