#include "linewright/routing/map_ways.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>
#include <utility>

#include "linewright/routing/hybrid_a_star.hpp"

namespace linewright {
namespace {

/// Rounded up to whole ticks; a way of exactly three must not become four because of the last bit
/// of a division. -1: too many.
Tick ticks_of(double seconds, double tick_s) {
  constexpr double kSlack = 1e-9;
  const double ticks = std::max(0.0, std::ceil(seconds / tick_s - kSlack));
  return ticks <= static_cast<double>(kMaxTicks) ? static_cast<Tick>(ticks) : -1;
}

/// A grid on which nothing but one zone is occupied.
OccupancyGrid only(const Zone& zone, const GridFrame& frame) {
  OccupancyGrid grid(frame);
  grid.add_obstacle(zone.polygon);
  return grid;
}

bool is_closed(ZoneSet set, std::size_t zone) { return ((set >> zone) & 1U) != 0; }

/// Exact bits of a pose, for keys.
using PoseBits = std::array<std::uint64_t, 3>;
PoseBits bits_of(const Pose2& pose) {
  return {std::bit_cast<std::uint64_t>(pose.x_m), std::bit_cast<std::uint64_t>(pose.y_m),
          std::bit_cast<std::uint64_t>(pose.heading_rad)};
}

}  // namespace

Way way_of(const Path& path, const Motion& motion, double tick_s) {
  Way way;
  if (!path.found()) return way;
  const Tick ticks = ticks_of(travel_seconds(path, motion), tick_s);
  if (ticks < 0) return way;
  way.leg = {ticks, path.metres()};
  way.path = way_points(path, motion);
  return way;
}

TravelTable travel_table(const KindRoutes& kind, std::size_t stations, double tick_s) {
  TravelTable table(stations);
  for (std::size_t from = 0; from < kind.stations.size(); ++from) {
    for (std::size_t to = 0; to < kind.stations.size(); ++to) {
      if (from == to) continue;
      Way way = way_of(kind.routes.path(from, to), kind.motion, tick_s);
      if (way.leg.ticks < 0) continue;
      table.set(kind.stations[from], kind.stations[to], way.leg);
      table.set_path(kind.stations[from], kind.stations[to], std::move(way.path));
    }
  }
  return table;
}

class MapWays::Impl {
 public:
  explicit Impl(MapWaysData data) : data_(std::move(data)) {
    for (const Zone& zone : data_.zones) {
      const auto map = std::make_shared<const ClearanceMap>(only(zone, data_.grid.frame()));
      std::vector<std::optional<CollisionChecker>>& checkers = zone_checkers_.emplace_back();
      for (const auto& kind : data_.kinds) {
        checkers.emplace_back();
        if (kind) checkers.back().emplace(map, kind->request.mover.footprint);
      }
    }
  }

  const TravelTable& table(std::size_t kind, ZoneSet closed) {
    if (closed == 0 || !data_.kinds[kind]) return data_.base[kind];
    const std::scoped_lock lock(mutex_);
    const auto known = tables_.find({kind, closed});
    if (known != tables_.end()) return known->second;
    return tables_.emplace(std::pair(kind, closed), planned_anew(kind, closed)).first->second;
  }

  const Way& way(std::size_t kind, const Pose2& from, StationId to, ZoneSet closed) {
    if (!data_.kinds[kind]) closed = 0;
    closed = closed_around(kind, from, closed);
    const std::scoped_lock lock(mutex_);
    const std::tuple key{kind, bits_of(from), to.value, closed};
    const auto known = ways_.find(key);
    if (known != ways_.end()) return known->second;
    Way way =
        data_.kinds[kind] ? planned_way(kind, from, to, closed) : straight_way(kind, from, to);
    return ways_.emplace(key, std::move(way)).first->second;
  }

  [[nodiscard]] bool inside(std::size_t kind, const Pose2& pose, std::size_t zone) const {
    const auto& checker = zone_checkers_[zone][kind];
    return checker && !checker->free(data_.grid.frame().to_grid(pose));
  }

  [[nodiscard]] bool crosses(std::size_t kind, const std::vector<WayPoint>& path, double from_share,
                             std::size_t zone) const {
    if (path.empty() || !zone_checkers_[zone][kind]) return false;
    Pose2 before = pose_on(path, from_share);
    if (inside(kind, before, zone)) return true;
    for (const WayPoint& point : path) {
      if (point.share <= from_share) continue;
      if (crosses_piece(kind, before, point.pose, zone)) return true;
      before = point.pose;
    }
    return false;
  }

 private:
  /// The closed zones without those that a worker at this pose stands in: it may leave them.
  [[nodiscard]] ZoneSet closed_around(std::size_t kind, const Pose2& pose, ZoneSet closed) const {
    for (std::size_t zone = 0; zone < data_.zones.size(); ++zone) {
      if (is_closed(closed, zone) && inside(kind, pose, zone)) closed &= ~(ZoneSet{1} << zone);
    }
    return closed;
  }

  [[nodiscard]] bool crosses_any(std::size_t kind, const std::vector<WayPoint>& path,
                                 ZoneSet closed) const {
    for (std::size_t zone = 0; zone < data_.zones.size(); ++zone) {
      if (is_closed(closed, zone) && crosses(kind, path, 0.0, zone)) return true;
    }
    return false;
  }

  /// Looks every 5 cm and 0.1 rad.
  [[nodiscard]] bool crosses_piece(std::size_t kind, const Pose2& from, const Pose2& to,
                                   std::size_t zone) const {
    const std::vector<WayPoint> piece{{from, 0.0}, {to, 1.0}};
    const double turn = std::remainder(to.heading_rad - from.heading_rad, 2 * std::numbers::pi);
    const double looks =
        std::max(distance_m(from.point(), to.point()) / 0.05, std::abs(turn) / 0.1);
    const int count = std::max(1, static_cast<int>(std::ceil(looks)));
    for (int i = 1; i <= count; ++i) {
      if (inside(kind, pose_on(piece, static_cast<double>(i) / count), zone)) return true;
    }
    return false;
  }

  const std::shared_ptr<const ClearanceMap>& map_of(ZoneSet closed) {
    std::shared_ptr<const ClearanceMap>& map = maps_[closed];
    if (!map) {
      OccupancyGrid grid = data_.grid;
      for (std::size_t zone = 0; zone < data_.zones.size(); ++zone) {
        if (is_closed(closed, zone)) grid.add_obstacle(data_.zones[zone].polygon);
      }
      map = std::make_shared<const ClearanceMap>(grid);
    }
    return map;
  }

  PathPlanner& planner_of(std::size_t kind, ZoneSet closed, bool tight) {
    std::unique_ptr<PathPlanner>& planner = planners_[{kind, closed, tight}];
    if (!planner) {
      const RouteRequest& request = data_.kinds[kind]->request;
      PathPlannerOptions options = request.options;
      // A pose between two points of an arc may be a few millimetres off the arc, and then closer
      // to an obstacle than the planner would go by itself.
      if (tight) options.clearance_m = -0.01;
      planner = make_path_planner(request.planner, map_of(closed), request.mover, options);
    }
    return *planner;
  }

  TravelTable planned_anew(std::size_t kind, ZoneSet closed) {
    const KindRoutes& routes = *data_.kinds[kind];
    TravelTable table = data_.base[kind];
    // Goal by goal, so that all starts of one share its heuristic.
    for (std::size_t to = 0; to < routes.stations.size(); ++to) {
      for (std::size_t from = 0; from < routes.stations.size(); ++from) {
        const StationId a = routes.stations[from];
        const StationId b = routes.stations[to];
        const Pose2& start = routes.request.stops[from].pose;
        const ZoneSet around = closed_around(kind, start, closed);
        if (from == to || table.leg(a, b).ticks < 0) continue;
        if (!crosses_any(kind, table.path(a, b), around)) continue;
        const Path path =
            planner_of(kind, around, false).plan(start, routes.request.stops[to].pose);
        Way way = way_of(path, routes.motion, data_.tick_s);
        table.set(a, b, way.leg);
        table.set_path(a, b, std::move(way.path));
      }
    }
    return table;
  }

  Way planned_way(std::size_t kind, const Pose2& from, StationId to, ZoneSet closed) {
    const auto& pose = data_.stations[to.index()].poses[kind];
    if (!pose) return {};
    Path path = planner_of(kind, closed, false).plan(from, *pose);
    if (path.status == PathStatus::kStartOccupied) {
      path = planner_of(kind, closed, true).plan(from, *pose);
    }
    return way_of(path, data_.motions[kind], data_.tick_s);
  }

  Way straight_way(std::size_t kind, const Pose2& from, StationId to) const {
    const auto& pose = data_.stations[to.index()].poses[kind];
    if (!pose) return {};
    Way way;
    const double metres = distance_m(from.point(), pose->point());
    way.leg = {ticks_of(metres / data_.motions[kind].speed_mps, data_.tick_s), metres};
    way.path = {{from, 0.0}, {*pose, 1.0}};
    return way;
  }

  MapWaysData data_;
  std::vector<std::vector<std::optional<CollisionChecker>>> zone_checkers_;  ///< [zone][kind]
  std::mutex mutex_;  ///< guards everything below
  std::map<ZoneSet, std::shared_ptr<const ClearanceMap>> maps_;
  std::map<std::tuple<std::size_t, ZoneSet, bool>, std::unique_ptr<PathPlanner>> planners_;
  std::map<std::pair<std::size_t, ZoneSet>, TravelTable> tables_;
  std::map<std::tuple<std::size_t, PoseBits, std::int32_t, ZoneSet>, Way> ways_;
};

MapWays::MapWays(MapWaysData data) : impl_(std::make_unique<Impl>(std::move(data))) {}
MapWays::~MapWays() = default;

const TravelTable& MapWays::table(WorkerKindId kind, ZoneSet closed) const {
  return impl_->table(kind.index(), closed);
}

const Way& MapWays::way(WorkerKindId kind, Pose2 from, StationId to, ZoneSet closed) const {
  return impl_->way(kind.index(), from, to, closed);
}

bool MapWays::crosses(WorkerKindId kind, const std::vector<WayPoint>& path, double from_share,
                      std::size_t zone) const {
  return impl_->crosses(kind.index(), path, from_share, zone);
}

bool MapWays::inside(WorkerKindId kind, Pose2 pose, std::size_t zone) const {
  return impl_->inside(kind.index(), pose, zone);
}

}  // namespace linewright
