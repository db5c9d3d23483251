#include "ways.hpp"

#include <algorithm>
#include <cmath>

#include "event_net.hpp"

namespace linewright::bounds {
namespace {

Tick straight(const LineModel& line, std::size_t kind, std::size_t from, std::size_t to) {
  const auto& a = line.stations[from].poses[kind];
  const auto& b = line.stations[to].poses[kind];
  if (!a || !b) return kNever;
  const double metres = std::hypot(a->x_m - b->x_m, a->y_m - b->y_m);
  return static_cast<Tick>(std::floor(metres / line.worker_kinds[kind].speed_mps / line.tick_s));
}

}  // namespace

Ways::Ways(const LineModel& line, const RunSetup& setup)
    : line_(line), setup_(setup), stations_(line.stations.size()) {
  for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
    std::vector<Tick>& ticks = ticks_.emplace_back(stations_ * stations_, kNever);
    const bool planned =
        line.ways != nullptr && (!line.zones.empty() || !line.worker_kinds[k].rest.empty());
    for (std::size_t i = 0; i < stations_; ++i) {
      for (std::size_t j = 0; j < stations_; ++j) {
        const Tick leg = planned ? straight(line, k, i, j)
                                 : line.travel[k].leg(StationId(i), StationId(j)).ticks;
        ticks[i * stations_ + j] = i == j ? 0 : leg < 0 ? kNever : leg;
      }
    }
    for (std::size_t via = 0; via < stations_; ++via) {
      for (std::size_t i = 0; i < stations_; ++i) {
        for (std::size_t j = 0; j < stations_; ++j) {
          const Tick first = ticks[i * stations_ + via];
          const Tick second = ticks[via * stations_ + j];
          if (first >= kNever || second >= kNever) continue;
          Tick& best = ticks[i * stations_ + j];
          best = std::min(best, first + second);
        }
      }
    }
  }
}

Tick Ways::first(WorkerKindId kind) const {
  return line_.worker_kinds[kind.index()].rest.empty() ? 1 : 0;
}

Tick Ways::reach(WorkerKindId kind, StationId to) const {
  Tick best = kNever;
  for (const StationId start : setup_.worker_start[kind.index()])
    best = std::min(best, between(kind, start, to));
  return best >= kNever ? kNever : first(kind) + best;
}

Tick Ways::reach_carrier(WorkerKindId kind, CarrierKindId carrier) const {
  Tick best = kNever;
  for (const StationId stands : setup_.carrier_start[carrier.index()])
    best = std::min(best, reach(kind, stands));
  return best;
}

Tick Ways::bring_carrier(WorkerKindId kind, CarrierKindId carrier, StationId to) const {
  Tick best = kNever;
  for (const StationId stands : setup_.carrier_start[carrier.index()]) {
    const Tick fetched = reach(kind, stands);
    const Tick way = between(kind, stands, to);
    if (fetched < kNever && way < kNever) best = std::min(best, fetched + way);
  }
  return best;
}

}  // namespace linewright::bounds
