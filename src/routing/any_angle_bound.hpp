#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "linewright/map/occupancy_grid.hpp"

namespace linewright {

/// The shortest way of a disc among the blocked cells of a map, in any direction: no body around
/// that disc has a shorter one. For tests and benchmarks.
///
/// A visibility graph: blocked cells are joined to rectangles, which are grown by a polygon of 16
/// corners inside of the disc. That is a little less than the disc (1 % of its radius at most), so
/// the way is never longer than the true one. What lies outside of the map is taken to be free.
class AnyAngleBound {
 public:
  AnyAngleBound(const OccupancyGrid& grid, double radius_m)
      : frame_(grid.frame()), radius_m_(radius_m) {
    join_cells(grid);
    for (const Obstacle& obstacle : obstacles_) add_corners(obstacle);
    seen_.resize(corners_.size());
    for (std::size_t a = 0; a < corners_.size(); ++a) {
      for (std::size_t b = a + 1; b < corners_.size(); ++b) {
        if (!sees(corners_[a], corners_[b])) continue;
        seen_[a].push_back(b);
        seen_[b].push_back(a);
      }
    }
  }

  /// Between two points of the frame `map`; infinite when there is no way.
  [[nodiscard]] double metres(Point2 from_in_map, Point2 to_in_map) const {
    const Point2 from = frame_.to_grid(from_in_map);
    const Point2 to = frame_.to_grid(to_in_map);
    if (sees(from, to)) return distance_m(from, to);
    std::vector<double> cost(corners_.size(), kNever);
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    const auto reach = [&](std::size_t corner, double metres) {
      if (metres >= cost[corner]) return;
      cost[corner] = metres;
      open.emplace(metres, corner);
    };
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      if (sees(from, corners_[c])) reach(c, distance_m(from, corners_[c]));
    }
    double best = kNever;
    while (!open.empty() && open.top().first < best) {
      const auto [at, corner] = open.top();
      open.pop();
      if (at > cost[corner]) continue;
      if (sees(corners_[corner], to)) best = std::min(best, at + distance_m(corners_[corner], to));
      for (const std::size_t next : seen_[corner]) {
        reach(next, at + distance_m(corners_[corner], corners_[next]));
      }
    }
    return best;
  }

  [[nodiscard]] std::size_t corners() const { return corners_.size(); }

 private:
  using Open = std::pair<double, std::size_t>;

  static constexpr double kNever = std::numeric_limits<double>::infinity();
  static constexpr int kCorners = 16;
  static constexpr double kTouching_m = 1e-7;

  /// Inside: x * nx + y * ny < limit for all sides.
  struct Side {
    double nx, ny, limit;
  };
  struct Obstacle {
    double x0, x1, y0, y1;
    std::array<Side, kCorners + 4> sides;
  };

  /// Rectangles of blocked cells: runs in a row, joined with equal runs in the row below.
  void join_cells(const OccupancyGrid& grid) {
    struct Run {
      std::int32_t first, last, low;
    };
    std::vector<Run> before;
    for (std::int32_t row = 0; row <= grid.rows(); ++row) {
      std::vector<Run> runs;
      for (std::int32_t c = 0; row < grid.rows() && c < grid.columns(); ++c) {
        if (!grid.blocked({c, row})) continue;
        if (runs.empty() || runs.back().last + 1 < c) runs.push_back({c, c, row});
        runs.back().last = c;
      }
      for (const Run& old : before) {
        const auto same = std::find_if(runs.begin(), runs.end(), [&](const Run& run) {
          return run.first == old.first && run.last == old.last;
        });
        if (same != runs.end()) {
          same->low = old.low;
        } else {
          add_rectangle(old.first, old.last + 1, old.low, row);
        }
      }
      before = std::move(runs);
    }
  }

  void add_rectangle(std::int32_t x0, std::int32_t x1, std::int32_t y0, std::int32_t y1) {
    const double cell_m = frame_.cell_m;
    Obstacle made{x0 * cell_m, x1 * cell_m, y0 * cell_m, y1 * cell_m, {}};
    const double step = 2.0 * std::numbers::pi / kCorners;
    const auto side = [&](double angle, double away_m) {
      const double nx = std::cos(angle);
      const double ny = std::sin(angle);
      const double limit =
          std::max(nx * made.x0, nx * made.x1) + std::max(ny * made.y0, ny * made.y1);
      return Side{nx, ny, limit + away_m - kTouching_m};
    };
    for (int i = 0; i < kCorners; ++i) {
      made.sides[static_cast<std::size_t>(i)] =
          side((i + 0.5) * step, radius_m_ * std::cos(step / 2.0));
    }
    for (int i = 0; i < 4; ++i) {
      made.sides[static_cast<std::size_t>(kCorners + i)] =
          side(i * std::numbers::pi / 2.0, radius_m_);
    }
    obstacles_.push_back(made);
  }

  void add_corners(const Obstacle& obstacle) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double x = quarter == 0 || quarter == 3 ? obstacle.x1 : obstacle.x0;
      const double y = quarter < 2 ? obstacle.y1 : obstacle.y0;
      for (int i = 0; i <= kCorners / 4; ++i) {
        const double angle = (quarter * kCorners / 4 + i) * 2.0 * std::numbers::pi / kCorners;
        const Point2 corner{x + radius_m_ * std::cos(angle), y + radius_m_ * std::sin(angle)};
        const bool covered =
            std::any_of(obstacles_.begin(), obstacles_.end(),
                        [&](const Obstacle& other) { return inside(corner, other); });
        if (!covered) corners_.push_back(corner);
      }
    }
  }

  [[nodiscard]] static bool inside(Point2 p, const Obstacle& obstacle) {
    return std::all_of(obstacle.sides.begin(), obstacle.sides.end(), [&](const Side& side) {
      return side.nx * p.x_m + side.ny * p.y_m < side.limit;
    });
  }

  [[nodiscard]] bool crosses(Point2 a, Point2 b, const Obstacle& obstacle) const {
    double first = 0.0;
    double last = 1.0;
    for (const Side& side : obstacle.sides) {
      const double at_a = side.nx * a.x_m + side.ny * a.y_m - side.limit;
      const double at_b = side.nx * b.x_m + side.ny * b.y_m - side.limit;
      if (at_a >= 0.0 && at_b >= 0.0) return false;
      if (at_a > 0.0) first = std::max(first, at_a / (at_a - at_b));
      if (at_b > 0.0) last = std::min(last, at_a / (at_a - at_b));
      if (last - first <= 1e-12) return false;
    }
    return true;
  }

  [[nodiscard]] bool sees(Point2 a, Point2 b) const {
    return std::none_of(obstacles_.begin(), obstacles_.end(),
                        [&](const Obstacle& obstacle) { return crosses(a, b, obstacle); });
  }

  GridFrame frame_;
  double radius_m_;
  std::vector<Obstacle> obstacles_;
  std::vector<Point2> corners_;
  std::vector<std::vector<std::size_t>> seen_;  ///< by corner: those that it sees
};

}  // namespace linewright
