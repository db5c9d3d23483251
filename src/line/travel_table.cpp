#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "linewright/line/line_model.hpp"

namespace linewright {

const std::vector<WayPoint>& TravelTable::path(StationId from, StationId to) const {
  static const std::vector<WayPoint> kStraight;
  return paths_.empty() ? kStraight : paths_[from.index() * stations_ + to.index()];
}

void TravelTable::set_path(StationId from, StationId to, std::vector<WayPoint> path) {
  if (paths_.empty()) paths_.resize(stations_ * stations_);
  paths_[from.index() * stations_ + to.index()] = std::move(path);
}

Pose2 pose_on(const std::vector<WayPoint>& path, double share) {
  const auto next =
      std::upper_bound(path.begin(), path.end(), share,
                       [](double s, const WayPoint& point) { return s < point.share; });
  if (next == path.begin()) return path.front().pose;
  if (next == path.end()) return path.back().pose;
  const WayPoint& a = *std::prev(next);
  const WayPoint& b = *next;
  const double part = (share - a.share) / (b.share - a.share);
  const double turn = std::remainder(b.pose.heading_rad - a.pose.heading_rad, 2 * std::numbers::pi);
  return {a.pose.x_m + part * (b.pose.x_m - a.pose.x_m),
          a.pose.y_m + part * (b.pose.y_m - a.pose.y_m), a.pose.heading_rad + part * turn};
}

Tick Horizon::ticks(std::int32_t order) const {
  for (const auto& [largest, ticks] : by_order) {
    if (order <= largest) return ticks;
  }
  return by_order.empty() ? 0 : by_order.back().second;
}

}  // namespace linewright
