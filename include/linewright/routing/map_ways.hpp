#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "linewright/line/way_finder.hpp"
#include "linewright/line/workers.hpp"
#include "linewright/map/occupancy_grid.hpp"
#include "linewright/routing/route_table.hpp"

namespace linewright {

/// The routes of one kind of worker as the line uses them.
struct KindRoutes {
  RouteRequest request;
  std::vector<StationId> stations;  ///< by stop of the request
  Motion motion;
  RouteTable routes;
};

/// Ticks, metres and line of a path; rounded up to whole ticks. A path that was not found gives
/// ticks -1. More than `kMaxTicks` ticks: none either.
[[nodiscard]] Way way_of(const Path& path, const Motion& motion, double tick_s);

/// The travel table over `stations` stations that the routes of a kind make.
[[nodiscard]] TravelTable travel_table(const KindRoutes& kind, std::size_t stations, double tick_s);

/// What ways are planned from. Indices of the vectors: worker kinds.
struct MapWaysData {
  OccupancyGrid grid;
  /// None: the kind does not use the map; its ways are straight lines, closures are nothing to it.
  std::vector<std::optional<KindRoutes>> kinds;
  std::vector<Motion> motions;
  std::vector<TravelTable> base;  ///< all zones open
  std::vector<Station> stations;
  std::vector<Zone> zones;
  double tick_s = 1.0;
};

/// Finds ways on a map while zones are closed and from between stations. Zones that are closed
/// become obstacles; only routes that lead through one of them are planned anew. Who stands within
/// a closed zone may leave it: for that way it counts as open.
class MapWays final : public WayFinder {
 public:
  explicit MapWays(MapWaysData data);
  ~MapWays() override;

  [[nodiscard]] const TravelTable& table(WorkerKindId kind, ZoneSet closed) const override;
  [[nodiscard]] const Way& way(WorkerKindId kind, Pose2 from, StationId to,
                               ZoneSet closed) const override;
  [[nodiscard]] bool crosses(WorkerKindId kind, const std::vector<WayPoint>& path,
                             double from_share, std::size_t zone) const override;
  [[nodiscard]] bool inside(WorkerKindId kind, Pose2 pose, std::size_t zone) const override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace linewright
