#include <utility>

#include "linewright/line/line_model.hpp"

namespace linewright {

const std::vector<Point2>& TravelTable::path(StationId from, StationId to) const {
  static const std::vector<Point2> kStraight;
  return paths_.empty() ? kStraight : paths_[from.index() * stations_ + to.index()];
}

void TravelTable::set_path(StationId from, StationId to, std::vector<Point2> path) {
  if (paths_.empty()) paths_.resize(stations_ * stations_);
  paths_[from.index() * stations_ + to.index()] = std::move(path);
}

Tick Horizon::ticks(std::int32_t order) const {
  for (const auto& [largest, ticks] : by_order) {
    if (order <= largest) return ticks;
  }
  return by_order.empty() ? 0 : by_order.back().second;
}

}  // namespace linewright
