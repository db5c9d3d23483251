#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "linewright/line/line_model.hpp"

// A hall of 1 m cells for tests of zones: workers walk from centre to centre, one metre a tick,
// never diagonally, so that every way can be counted by hand.
namespace linewright::test {

/// Cells lie around whole metres, from (0, 0) to (columns - 1, rows - 1); stations at such points.
/// A zone is the rectangle around its polygon, edge included.
class FakeWays final : public WayFinder {
 public:
  FakeWays(int columns, int rows, std::vector<Station> stations, std::vector<Zone> zones)
      : columns_(columns), rows_(rows), stations_(std::move(stations)), zones_(std::move(zones)) {}

  const TravelTable& table(WorkerKindId kind, ZoneSet closed) const override {
    const std::scoped_lock lock(mutex_);
    const auto [entry, is_new] = tables_.try_emplace({kind.value, closed}, stations_.size());
    for (std::size_t from = 0; is_new && from < stations_.size(); ++from) {
      for (std::size_t to = 0; to < stations_.size(); ++to) {
        if (from == to) continue;
        const Way way =
            find(*stations_[from].poses[kind.index()], *stations_[to].poses[kind.index()], closed);
        entry->second.set(StationId(from), StationId(to), way.leg);
        if (way.leg.ticks >= 0) entry->second.set_path(StationId(from), StationId(to), way.path);
      }
    }
    return entry->second;
  }

  const Way& way(WorkerKindId kind, Pose2 from, StationId to, ZoneSet closed) const override {
    const std::scoped_lock lock(mutex_);
    const auto key =
        std::pair(std::array<double, 3>{from.x_m, from.y_m, from.heading_rad},
                  std::array<std::uint32_t, 3>{static_cast<std::uint32_t>(kind.value),
                                               static_cast<std::uint32_t>(to.value), closed});
    const auto [entry, is_new] = ways_.try_emplace(key);
    if (is_new) {
      entry->second = find(from, *stations_[to.index()].poses[kind.index()], closed);
    }
    return entry->second;
  }

  bool crosses(WorkerKindId kind, const std::vector<WayPoint>& path, double from_share,
               std::size_t zone) const override {
    return std::any_of(path.begin(), path.end(), [&](const WayPoint& point) {
      return point.share > from_share && inside(kind, point.pose, zone);
    });
  }

  bool inside(WorkerKindId /*kind*/, Pose2 pose, std::size_t zone) const override {
    const auto& polygon = zones_[zone].polygon;
    const auto [left, right] = std::minmax_element(
        polygon.begin(), polygon.end(), [](Point2 a, Point2 b) { return a.x_m < b.x_m; });
    const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(),
                                                 [](Point2 a, Point2 b) { return a.y_m < b.y_m; });
    return pose.x_m >= left->x_m && pose.x_m <= right->x_m && pose.y_m >= low->y_m &&
           pose.y_m <= high->y_m;
  }

 private:
  using Cell = std::pair<int, int>;

  static Cell cell_of(Pose2 pose) {
    return {static_cast<int>(std::lround(pose.x_m)), static_cast<int>(std::lround(pose.y_m))};
  }
  static Pose2 pose_of(Cell cell) {
    return {static_cast<double>(cell.first), static_cast<double>(cell.second), 0.0};
  }

  [[nodiscard]] bool blocked(Cell cell, ZoneSet closed) const {
    if (cell.first < 0 || cell.second < 0 || cell.first >= columns_ || cell.second >= rows_) {
      return true;
    }
    for (std::size_t zone = 0; zone < zones_.size(); ++zone) {
      if (((closed >> zone) & 1U) != 0 && inside({}, pose_of(cell), zone)) return true;
    }
    return false;
  }

  /// Breadth first, to the right before up before left before down.
  [[nodiscard]] Way find(Pose2 from, Pose2 to, ZoneSet closed) const {
    const Cell start = cell_of(from);
    const Cell goal = cell_of(to);
    std::map<Cell, Cell> before{{start, start}};
    std::deque<Cell> open{start};
    while (!open.empty() && !before.contains(goal)) {
      const Cell at = open.front();
      open.pop_front();
      for (const Cell& step : {Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}}) {
        const Cell next{at.first + step.first, at.second + step.second};
        // Who is inside a closed zone may leave it.
        if (blocked(next, closed) && !blocked(at, closed)) continue;
        if (blocked(next, 0) || !before.try_emplace(next, at).second) continue;
        open.push_back(next);
      }
    }
    Way way;
    if (!before.contains(goal)) return way;
    std::vector<Cell> cells{goal};
    while (cells.back() != start) cells.push_back(before.at(cells.back()));
    std::reverse(cells.begin(), cells.end());
    const double steps = static_cast<double>(cells.size() - 1);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      way.path.push_back({pose_of(cells[i]), steps > 0 ? static_cast<double>(i) / steps : 1.0});
    }
    way.leg = {static_cast<Tick>(steps), steps};
    return way;
  }

  int columns_;
  int rows_;
  std::vector<Station> stations_;
  std::vector<Zone> zones_;
  mutable std::mutex mutex_;
  mutable std::map<std::pair<std::int32_t, ZoneSet>, TravelTable> tables_;
  mutable std::map<std::pair<std::array<double, 3>, std::array<std::uint32_t, 3>>, Way> ways_;
};

/// Gives the line ways of its own on a hall of that size.
inline void walk_on_cells(LineModel& line, int columns, int rows) {
  const auto ways = std::make_shared<FakeWays>(columns, rows, line.stations, line.zones);
  line.travel.clear();
  for (std::size_t kind = 0; kind < line.worker_kinds.size(); ++kind) {
    line.travel.push_back(ways->table(WorkerKindId(kind), 0));
  }
  line.ways = ways;
}

inline Zone rectangle_zone(std::string name, double x0, double x1, double y0, double y1) {
  return {std::move(name), {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

}  // namespace linewright::test
